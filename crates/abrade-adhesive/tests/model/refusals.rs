//! What is refused, and what is said of it.

use abrade_adhesive::{AdhesiveError, Assembly, Numerics, Simulation, Solid};

use crate::lattice::{D, block, elastic};

/// Fails for numbers that reach the passes unchecked, or a message without what was allowed.
#[test]
fn parameters_out_of_range_are_named() {
    let refused = |solid: Solid, numerics: Numerics| {
        let error = Simulation::new(&solid, &block(4, 4), numerics).unwrap_err();
        let AdhesiveError::Parameter(error) = error else { panic!("{error}") };
        (error.field, error.allowed)
    };
    let usual = Numerics::default();
    let of = |change: fn(&mut Solid)| {
        let mut solid = Solid::default();
        change(&mut solid);
        refused(solid, usual).0
    };
    assert_eq!(of(|s| s.adhesion = -1.0), "adhesion");
    assert_eq!(of(|s| s.young = f64::NAN), "young");
    assert_eq!(of(|s| s.poisson = 0.5), "poisson");
    assert_eq!(of(|s| s.strength_ratio = 0.9), "strength_ratio");
    let (field, allowed) = refused(Solid { hardening: 2e9, ..Solid::default() }, usual);
    assert_eq!(field, "hardening");
    assert!(allowed.contains("3 G"), "{allowed}");
    let numerics = Numerics { courant: 2.0, ..usual };
    assert_eq!(refused(Solid::default(), numerics).0, "courant");
}

/// Fails for a limit of the step that does not know the solid, the dashpots or how dense links are.
#[test]
fn steps_that_are_not_stable_are_refused() {
    let refused = |poisson: f64, viscosity: f64, reach: f64| {
        let mut assembly = block(8, 8);
        assembly.links.clear();
        assembly.link_within(reach, |_, _| true);
        let numerics = Numerics { courant: 0.5, viscosity };
        let solid = Solid { poisson, ..elastic() };
        Simulation::new(&solid, &assembly, numerics).err().map(|error| error.to_string())
    };
    assert_eq!(refused(0.3, 0.1, 1.01), None);
    // W = 16 pi / sqrt(3) (1 - 2 nu) / (2 - 2 nu) = 12.898, C = sqrt(v^2 + 4 / W) - v.
    let soft = refused(0.1, 0.1, 1.01).unwrap();
    assert!(soft.contains("`courant` is 0.5; must be below 0.4658 with"), "{soft}");
    assert!(soft.contains("`viscosity` 0.1, `poisson` 0.1"), "{soft}");
    assert!(refused(0.3, 0.5, 1.01).unwrap().contains("below 0.3558"));
    assert!(refused(0.3, 0.1, 1.8).unwrap().contains("times as dense"));
}

/// Fails for ends of links that are taken as indices unseen.
#[test]
fn impossible_assemblies_are_refused() {
    let mut assembly = block(4, 4);
    assembly.links[3].ends = [1, 16];
    let error = Simulation::new(&elastic(), &assembly, Numerics::default()).unwrap_err();
    assert_eq!(error, AdhesiveError::Link { link: 3, ends: [1, 16], elements: 16 });
    let mut assembly = block(4, 4);
    assembly.elements[5].velocity[1] = f64::INFINITY;
    let error = Simulation::new(&elastic(), &assembly, Numerics::default()).unwrap_err();
    assert_eq!(error, AdhesiveError::Element { element: 5 });
}

/// Fails for places that are compared without the period, or for links alone, and for a drag below zero that
/// is taken as none.
#[test]
fn elements_at_one_place_and_drags_below_zero_are_refused() {
    let refused = |change: fn(&mut Assembly)| {
        let mut assembly = block(4, 4);
        change(&mut assembly);
        Simulation::new(&elastic(), &assembly, Numerics::default()).unwrap_err()
    };
    let unlinked = refused(|a| {
        a.links.clear();
        a.elements[9].position = a.elements[2].position;
    });
    assert_eq!(unlinked, AdhesiveError::OnePlace { ends: [2, 9] });
    let over_the_period = refused(|a| {
        a.period = Some(8.0 * D);
        let [x, y] = a.elements[4].position;
        a.elements[7].position = [x + 8.0 * D, y];
    });
    assert_eq!(over_the_period, AdhesiveError::OnePlace { ends: [4, 7] });
    let pushed = refused(|a| a.elements[3].drag = -1.0);
    assert_eq!(pushed, AdhesiveError::Element { element: 3 });
}

/// Fails for motions that no step resolves and that go on as numbers without meaning.
#[test]
fn speeds_beyond_the_step_end_a_run() {
    let mut assembly = block(4, 4);
    assembly.elements[7].velocity = [1e4, 0.0];
    let mut simulation = Simulation::new(&elastic(), &assembly, Numerics::default()).unwrap();
    let ended = (0..100).try_for_each(|_| simulation.step());
    assert!(matches!(ended, Err(AdhesiveError::TooFast { element: 7, .. })), "{ended:?}");
}

/// Fails for a period or a reach that is no number and ends in a panic before it is refused.
#[test]
fn links_within_a_reach_that_is_none_do_not_panic() {
    for (period, diameter) in [(Some(f64::NAN), D), (Some(0.0), D), (None, 0.0), (None, f64::NAN)] {
        let mut assembly = block(4, 4);
        (assembly.period, assembly.diameter) = (period, diameter);
        assembly.link_within(1.01, |_, _| true);
        assert!(Simulation::new(&elastic(), &assembly, Numerics::default()).is_err());
        for element in &mut assembly.elements {
            element.position = [0.0; 2];
        }
        assembly.link_within(1.01, |_, _| true);
    }
}

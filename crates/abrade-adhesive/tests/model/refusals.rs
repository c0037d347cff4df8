//! What is refused, and what is said of it.

use abrade_adhesive::{AdhesiveError, Numerics, Simulation, Solid};

use crate::lattice::{block, elastic};

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

/// Fails for motions that no step resolves and that go on as numbers without meaning.
#[test]
fn speeds_beyond_the_step_end_a_run() {
    let mut assembly = block(4, 4);
    assembly.elements[7].velocity = [1e4, 0.0];
    let mut simulation = Simulation::new(&elastic(), &assembly, Numerics::default()).unwrap();
    let ended = (0..100).try_for_each(|_| simulation.step());
    assert!(matches!(ended, Err(AdhesiveError::TooFast { element: 7, .. })), "{ended:?}");
}

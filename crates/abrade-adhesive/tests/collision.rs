//! Asperities that collide: what they are made of, and what becomes of them without a threshold made for
//! the case.

use abrade_adhesive::{
    AdhesiveError, Asperities, Collision, Mode, Numerics, Packing, Pair, Part, Place, Profile,
    Solid,
};

fn collide(solid: Solid, asperities: &Asperities) -> Collision {
    let mut collision = Collision::new(&solid, asperities).unwrap();
    while collision.share() < 1.0 {
        collision.step().unwrap();
    }
    collision
}

fn solid(ratio: f64, adhesion: f64) -> Solid {
    let reference = Solid::default();
    Solid { strength_ratio: ratio, adhesion: adhesion * reference.shear_strength, ..reference }
}

/// Fails for rows or sides that are one off: 23 rows on a facet of 20 elements, 12 rows of the base.
#[test]
fn the_reference_bodies_have_their_elements() {
    let collision = Collision::new(&solid(1.0, 0.0), &Asperities::default()).unwrap();
    let of = |place: Place| collision.parts().iter().filter(|part| part.place == place).count();
    assert_eq!([of(Place::Rigid), of(Place::Base), of(Place::Asperity)], [180, 1980, 1426]);
    // Three links per element, less those of the free surfaces.
    let links = collision.simulation().pairs().filter(|pair| pair.is_original).count();
    assert!((10_300..10_600).contains(&links), "{links}");
}

/// Fails for an upper body that is mirrored or moved where it should be turned.
#[test]
fn the_upper_body_is_the_lower_turned_by_half_a_turn() {
    for packing in [Packing::Regular, Packing::Rotated { angle: 15f64.to_radians() }] {
        let asperities = Asperities { packing, overlap: -0.9, ..Asperities::default() };
        let collision = Collision::new(&solid(1.0, 0.0), &asperities).unwrap();
        let half = collision.parts().len() / 2;
        let place = |at: usize| collision.simulation().position(at);
        // Half a turn about the point in the middle takes x to 2 x_0 - x.
        let sum = |at: usize| [0, 1].map(|axis| place(at)[axis] + place(at + half)[axis]);
        for at in 0..half {
            assert_eq!([at, at + half].map(|at| collision.parts()[at].is_upper), [false, true]);
            assert_eq!(collision.parts()[at].place, collision.parts()[at + half].place);
            let off = [0, 1].map(|axis| (sum(at)[axis] - sum(0)[axis]).abs());
            assert!(off[0].max(off[1]) < 1e-9 * 25e-6, "{packing:?} {at}: {off:?}");
        }
        // From the middle of the lower facet: the corners pass 1.2 d apart.
        let [x, _] = sum(0);
        assert!((x - (2.25e-3 + 0.5e-3 + 1.2 * 25e-6)).abs() < 1e-12, "{packing:?}: {x}");
    }
}

/// Fails for an overlap that counts from a row of the outline that holds no element: under a peak, or where the
/// lattice is turned or disturbed.
#[test]
fn overlap_counts_from_the_outermost_elements_that_there_are() {
    let points = vec![[0.0, 0.0], [1e-3, 0.4e-3], [2.25e-3, 0.0]];
    // A peak whose corners counted from its summit would lie inside each other.
    let usual = Asperities::default;
    for asperities in [
        usual(),
        Asperities { profile: Profile::Line { points }, ..usual() },
        Asperities { packing: Packing::Rotated { angle: 15f64.to_radians() }, ..usual() },
        Asperities { packing: Packing::Disordered { amplitude: 0.15, seed: 3 }, ..usual() },
    ] {
        let collision = Collision::new(&solid(1.0, 0.0), &asperities).unwrap();
        let heights = |upper: bool| {
            let own =
                (0..collision.parts().len()).filter(|at| collision.parts()[*at].is_upper == upper);
            own.map(|at| collision.simulation().position(at)[1]).collect::<Vec<f64>>()
        };
        let highest = heights(false).into_iter().fold(f64::NEG_INFINITY, f64::max);
        let lowest = heights(true).into_iter().fold(f64::INFINITY, f64::min);
        let apart = (lowest - highest) / 25e-6;
        assert!((apart - 0.7).abs() < 1e-9, "{asperities:?}: {apart}");
    }
}

/// Fails for a gap that counts from the middle of a summit, or from where the period cuts it in two.
#[test]
fn the_gap_of_a_line_lies_between_the_ends_of_its_summits() {
    let [d, period, row] = [25e-6, 2.25e-3, 0.5 * 3f64.sqrt() * 25e-6];
    let middle = vec![[0.0, 0.0], [1.1e-3, 0.4e-3], [1.2e-3, 0.4e-3], [period, 0.0]];
    let cut = vec![[0.0, 0.4e-3], [0.1e-3, 0.4e-3], [1.1e-3, 0.0], [2.2e-3, 0.4e-3]];
    for points in [middle, cut] {
        let asperities = Asperities { profile: Profile::Line { points }, ..Asperities::default() };
        let collision = Collision::new(&solid(1.0, 0.0), &asperities).unwrap();
        let (simulation, parts) = (collision.simulation(), collision.parts());
        let of = |upper: bool| {
            let own = (0..parts.len()).filter(|at| parts[*at].is_upper == upper);
            let places: Vec<[f64; 2]> = own.map(|at| simulation.position(at)).collect();
            let sign = if upper { -1.0 } else { 1.0 };
            let top = places.iter().map(|p| sign * p[1]).fold(f64::NEG_INFINITY, f64::max);
            let is_high = |p: &[f64; 2]| sign * p[1] > top - 0.5 * row;
            places.into_iter().filter(is_high).map(|p| p[0]).collect::<Vec<f64>>()
        };
        let (lower, upper) = (of(false), of(true));
        let ways = lower.iter().flat_map(|x| upper.iter().map(move |y| (y - x).rem_euclid(period)));
        let apart = ways.fold(f64::INFINITY, f64::min) / d;
        assert!((apart - 2.2).abs() < 1e-9, "{asperities:?}: {apart}");
    }
}

/// Fails for forces that do not balance while nothing touches, for links that count as parted because they are
/// long, and for bodies that slip past each other without having met.
#[test]
fn bodies_that_do_not_touch_feel_nothing() {
    let far = Asperities { overlap: -0.9, travel: Some(50e-6), ..Asperities::default() };
    for packing in [
        Packing::Regular,
        Packing::Rotated { angle: 15f64.to_radians() },
        Packing::Disordered { amplitude: 0.15, seed: 3 },
    ] {
        let asperities = Asperities { packing, ..far.clone() };
        let collision = collide(solid(1.0, 0.0), &asperities);
        let figures = collision.figures();
        assert_eq!(figures.failed, 0.0, "{packing:?}");
        assert!(collision.mean_load().iter().all(|force| force.abs() < 1e-6), "{packing:?}");
        assert_eq!(figures.parted, 0.0, "{packing:?}");
        assert_eq!(figures.mode(), Mode::NoContact, "{packing:?}");
        let elements = collision.parts().len() as f64;
        assert!((elements / 3586.0 - 1.0).abs() < 0.03, "{packing:?}: {elements}");
    }
}

/// Fails for steps that let spins run away, which ground bodies that never met: a limit without
/// Poisson's ratio or the dashpots.
#[test]
fn idle_bodies_stay_whole_at_any_step_that_is_let_through() {
    for poisson in [0.0, 0.1, 0.2, 0.3, 0.45] {
        for viscosity in [0.0, 0.1, 0.4] {
            let limit = Numerics::limit(viscosity, poisson);
            let solid = Solid { poisson, ..solid(1.0, 0.4) };
            let of = |courant: f64| Asperities {
                overlap: -0.9,
                travel: Some(30e-6),
                courant,
                viscosity,
                ..Asperities::default()
            };
            let figures = collide(solid, &of(0.97 * limit.min(1.0))).figures();
            assert_eq!(figures.failed, 0.0, "{poisson} {viscosity}");
            let error = Collision::new(&solid, &of(limit)).unwrap_err();
            let AdhesiveError::Parameter(error) = error else { panic!("{error}") };
            assert_eq!(error.field, "courant", "{poisson} {viscosity}");
        }
    }
}

/// Fails for an outline from points that is not that of the trapezoid through them, by a row or a column.
/// Centres lie on a line, and half a diameter inside the corners of a trapezoid.
#[test]
fn a_line_through_the_outermost_centres_is_the_trapezoid() {
    let of = |profile: Profile, gap: f64| {
        let asperities = Asperities { profile, gap, ..Asperities::default() };
        let collision = Collision::new(&solid(1.0, 0.0), &asperities).unwrap();
        collision.parts().iter().filter(|part| part.place == Place::Asperity).count()
    };
    let (foot, middle, half) = (0.5e-3 / 3f64.sqrt(), 1.125e-3, 9.5 * 25e-6);
    let points = vec![
        [middle - half - foot, 0.0],
        [middle - half, 0.5e-3],
        [middle + half, 0.5e-3],
        [middle + half + foot, 0.0],
    ];
    assert_eq!(of(Profile::Line { points }, 1.2), of(Profile::default(), 1.2));
}

/// Fails for a facet whose elements are counted by rounding while its width cuts them: the wider one would
/// have fewer.
#[test]
fn a_wider_facet_has_no_fewer_elements() {
    let elements = |width: f64| {
        let side = 90f64.to_radians();
        let profile = Profile::Trapezoid { top: width * 25e-6, height: 0.5e-3, side };
        let bodies = Asperities { profile, ..Asperities::default() };
        let collision = Collision::new(&solid(1.0, 0.0), &bodies).unwrap();
        let asperity = |part: &&Part| part.place == Place::Asperity;
        collision.parts().iter().filter(asperity).count() / 2
    };
    // 23 rows: 12 of the facet's whole elements, between them 11 of one less.
    for (width, whole) in [(20.0, 20), (20.4, 20), (20.6, 20), (20.9, 20), (21.0, 21), (21.3, 21)] {
        assert_eq!(elements(width), 12 * whole + 11 * (whole - 1), "{width}");
    }
}

/// Fails for bodies whose elements no machine holds, which would be made all the same.
#[test]
fn bodies_of_too_many_elements_are_refused() {
    let refused = |asperities: Asperities| {
        let fields = asperities.check().into_iter().map(|error| error.field).collect::<Vec<_>>();
        fields.concat()
    };
    let line = |height: f64| Profile::Line { points: vec![[0.0, 0.0], [1e-3, height]] };
    let usual = Asperities::default;
    assert_eq!(refused(Asperities { profile: line(1e-3), ..usual() }), "");
    assert_eq!(refused(Asperities { profile: line(1e4), ..usual() }), "points");
    assert_eq!(refused(Asperities { profile: line(2.2), period: 2.25e-3, ..usual() }), "");
    let long = Asperities { period: 2.4, base: 2e-3, ..usual() };
    assert_eq!(refused(long.clone()), "period");
    let turned = Packing::Rotated { angle: 0.3 };
    assert_eq!(refused(Asperities { period: 0.1, packing: turned, ..usual() }), "period");
    assert_eq!(refused(Asperities { period: 0.1, ..usual() }), "");
}

/// Fails for adhesion further than pairs are followed, which would be lost without a word, and for figures of bodies
/// at their start that call all of them debris.
#[test]
fn adhesion_reaches_no_further_than_pairs_are_followed() {
    let of = |adhesion_range: f64| {
        let solid = Solid { adhesion_range, ..solid(1.0, 0.4) };
        Collision::new(&solid, &Asperities::default())
    };
    assert_eq!(of(1e-6).unwrap().figures().debris, 0.0);
    let AdhesiveError::Parameter(error) = of(5e-6).unwrap_err() else { panic!("another error") };
    assert_eq!(error.field, "adhesion_range");
}

/// Fails for bodies that start inside each other, and run all the same.
#[test]
fn overlap_at_the_start_is_refused() {
    let asperities = Asperities { gap: -5.0, ..Asperities::default() };
    let error = Collision::new(&solid(1.0, 0.0), &asperities).unwrap_err();
    assert_eq!(error, AdhesiveError::Overlap { gap: -5.0 });
}

/// Fails for asperities that weld whatever the adhesion, for links that do not heal, and for a label that
/// does not tell the two cases apart.
#[test]
fn ductile_asperities_slip_and_brittle_ones_break_away() {
    let slipping = collide(solid(1.0, 0.4), &Asperities::default());
    let breakaway = collide(solid(1.7, 0.0), &Asperities::default());
    for (collision, mode) in [(&slipping, Mode::Slipping), (&breakaway, Mode::Breakaway)] {
        let figures = collision.figures();
        println!("{figures:?}");
        assert_eq!(figures.mode(), mode, "{figures:?}");
        let ledger = collision.simulation().ledger();
        let [mass, _] = collision.simulation().inertia();
        let start = 0.5 * mass * collision.parts().len() as f64;
        // What averaged returns do not share is told twice; each outlet that is forgotten takes off more.
        let residual = (ledger.balance() - start) / ledger.drive;
        assert!((0.0..0.04).contains(&residual), "{residual}: {ledger:?}");
    }
    // Fails for a count that forgets pairs which are no longer listed.
    let listed = |pairs: Vec<Pair>| pairs.iter().map(|pair| u64::from(pair.breaks)).sum::<u64>();
    let counted = breakaway.simulation().failures();
    assert!(counted > listed(breakaway.simulation().pairs().collect()), "{counted}");
    assert!(slipping.figures().worn < 0.05 && breakaway.figures().worn > 0.15);
}

/// Fails for numbers that run away without a word: every run goes on with finite numbers, or ends with an
/// error that says where.
#[test]
fn extreme_solids_and_speeds_stay_finite_or_say_why() {
    let mut ended = 0;
    for young in [1e8, 1e9, 1e11] {
        for speed in [0.01, 10.0] {
            for (ratio, share) in [(1.0, 0.0), (1.0, 1.0), (20.0, 0.0), (20.0, 1.0)] {
                let solid = Solid { young, strength_ratio: ratio, ..Solid::default() };
                let solid = Solid { hardening: 0.5 * young, ..solid };
                let solid = Solid { adhesion: share * solid.tensile_strength(), ..solid };
                // The corners all but touch.
                let asperities = Asperities { speed, gap: -0.3, ..Asperities::default() };
                let mut collision = Collision::new(&solid, &asperities).unwrap();
                let outcome = (0..500).try_for_each(|_| collision.step());
                let finite = collision.simulation().ledger().balance().is_finite()
                    && collision.mean_load().iter().all(|force| force.is_finite());
                match outcome {
                    Ok(()) => assert!(finite, "{young:e} {speed} {ratio} {share}"),
                    Err(error) => {
                        assert!(matches!(error, AdhesiveError::TooFast { .. }), "{error}");
                        ended += 1;
                    }
                }
            }
        }
    }
    assert!(ended < 12, "{ended} of 24 runs ended early");
}

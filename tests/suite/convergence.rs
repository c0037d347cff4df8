//! How fast the foundation's oblique impact converges, in time and in pitch.

use abrade::{FlowLaw, Lateral};

use crate::foundation::landings;
use crate::rig::{Impact, Outcome, paper};
use crate::table::{number, read};

fn rms(misses: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = misses.fold((0.0, 0), |(s, n), e| (s + e * e, n + 1));
    (sum / f64::from(count)).sqrt()
}

/// W [mm3] and COR of the four landings at each of the `angles` [deg].
fn runs(angles: &[f64], pitch: f64, accuracy: f64) -> Vec<[f64; 2]> {
    let result = |outcome: Outcome| [outcome.surface.wear_volume() * 1e9, outcome.restitution];
    let run = |impact: Impact| result(Impact { accuracy, ..impact }.run());
    angles.iter().flat_map(|a| landings("oblique", *a, None, pitch)).map(run).collect()
}

/// Fails for an error that falls slower than first order in the step (a slope of 0.5 in the
/// accuracy). Second order would be 1; measured are 0.84 for W and 0.60 for COR. Errors of single
/// landings change sign with the step, so several angles are taken together.
#[test]
fn the_time_error_falls_at_least_to_first_order_in_the_step() {
    let (angles, pitch) = ([20.0, 30.0, 45.0, 60.0, 75.0], 0.1e-3);
    let limit = runs(&angles, pitch, 1e-6);
    let accuracies = [3e-3, 7.5e-4, 1.875e-4, 4.6875e-5];
    let ends = accuracies.map(|accuracy| runs(&angles, pitch, accuracy));
    for (which, name) in ["W", "COR"].into_iter().enumerate() {
        let miss = |(end, limit): (&[f64; 2], &[f64; 2])| end[which] / limit[which] - 1.0;
        let errors = ends.each_ref().map(|ends| rms(ends.iter().zip(&limit).map(miss)));
        let slope = (errors[0] / errors[3]).log2() / 6.0;
        println!("{name}: {errors:?} slope {slope:.2} in the accuracy");
        assert!(slope >= 0.5, "{name}: {errors:?} slope {slope}");
    }
}

/// Fails for an Eq. 5 that takes the body's height at the end of a step, and for a gate that closes
/// within a step and is taken to hold the node back in all of it: each leaves an error of first
/// order (a slope of 0.5 in the accuracy). Measured is 1.1.
#[test]
fn the_papers_impact_under_eq5_converges_with_the_square_of_the_step() {
    let places = [[0.0, 0.0], [0.17, 0.05], [0.35, 0.1], [0.52, 0.15], [0.69, 0.2], [0.87, 0.25]];
    let runs = |accuracy| {
        places.map(|at| {
            let mut impact = Impact { accuracy, ..paper("oblique", 45.0, at.map(|x| x * 1e-3)) };
            impact.laws.flow = FlowLaw::CapozzaHanley { lateral: Lateral::Eq5 };
            impact.run().surface.wear_volume() * 1e9
        })
    };
    let limit = runs(1e-6);
    let mean = limit.iter().sum::<f64>() / 6.0;
    let error = |accuracy| rms(runs(accuracy).iter().zip(&limit).map(|(w, l)| (w - l) / mean));
    let errors = [1e-3, 1e-4, 1e-5].map(error);
    let slope = (errors[0] / errors[2]).log10() / 2.0;
    println!("W: {errors:?} slope {slope:.2} in the accuracy");
    assert!(errors[0] < 5e-3 && slope > 0.9, "{errors:?} slope {slope}");
}

/// Fails for a law that depends on the mesh.
#[test]
fn the_error_of_wear_is_second_order_in_the_pitch() {
    let row = read("foundation_limit")
        .into_iter()
        .find(|row| {
            row["case"] == "oblique" && row["law"] == "WinklerHertzCal" && row["theta"] == "45"
        })
        .expect("the row");
    let limit = number(&row, "W_limit_mm3");
    let error = |pitch| rms(runs(&[45.0], pitch, 2e-4).iter().map(|end| end[0] / limit - 1.0));
    let errors = [0.2e-3, 0.1e-3, 0.05e-3].map(error);
    let slope = (errors[0] / errors[2]).log2() / 2.0;
    println!("W: {errors:?} slope {slope:.2} in the pitch");
    assert!(slope >= 1.8, "{errors:?} slope {slope}");
}

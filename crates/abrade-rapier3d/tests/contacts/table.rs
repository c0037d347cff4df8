//! The table: Auto beside Lockstep, fine.

use crate::plugin::Resolve;
use nalgebra::Vector3;

use super::rig::Case;
use super::rows::{self, Outcome};

type Row = (&'static str, fn(Case) -> Outcome);

const ROWS: [Row; 9] = [
    ("resting ball", rows::resting_ball),
    ("loaded ball", rows::loaded_ball),
    ("light block on ball", rows::light_block_on_ball),
    ("heavy block on ball", rows::heavy_block_on_ball),
    ("fixed-joint dumbbell", rows::fixed_joint_dumbbell),
    ("pendulum", rows::pendulum),
    ("motor-driven scratch", rows::motor_driven_scratch),
    ("struck stack", rows::struck_stack),
    ("rolling clump", rows::rolling_clump),
];

#[test]
fn table() {
    let only = std::env::var("ROW").unwrap_or_default();
    for (name, row) in ROWS.iter().filter(|(name, _)| name.contains(&only)) {
        let case = |resolve, dt, accuracy| Case { dt, origin: Vector3::zeros(), resolve, accuracy };
        let began = std::time::Instant::now();
        if ["resting ball", "loaded ball"].contains(name) && only.is_empty() {
            continue;
        }
        let reference = row(case(Resolve::Lockstep, 1e-4, 1e-4));
        println!("{name}: {reference:?} {:.2} s", began.elapsed().as_secs_f64());
        for (resolve, dt) in [
            (Resolve::Lockstep, 1.0 / 60.0),
            (Resolve::Auto, 1e-3),
            (Resolve::Auto, 1.0 / 240.0),
            (Resolve::Auto, 1.0 / 60.0),
        ] {
            let began = std::time::Instant::now();
            let seen = row(case(resolve, dt, 1e-3));
            println!(
                "  {resolve:?} {dt:.4}: W {:+.2} % speed {:+.2} % sleeps {} m {} q {} l {} r {} steps {} {:.3} s",
                100.0 * (seen.volume / reference.volume - 1.0),
                100.0 * (seen.speed / reference.speed - 1.0),
                seen.sleeps,
                seen.counters.micro,
                seen.counters.quasi_static,
                seen.counters.lockstep,
                seen.counters.refused,
                seen.counters.steps,
                began.elapsed().as_secs_f64()
            );
        }
    }
}

#[test]
#[ignore]
fn trace() {
    let dt = std::env::var("DT").map_or(1e-3, |dt| dt.parse().expect("a number"));
    let resolve = match std::env::var("RES").as_deref() {
        Ok("L") => Resolve::Lockstep,
        Ok("Q") => Resolve::QuasiStatic,
        _ => Resolve::Auto,
    };
    let case = Case { dt, origin: Vector3::zeros(), resolve, accuracy: 1e-3 };
    let only = std::env::var("ROW").unwrap_or_default();
    for (_, row) in ROWS.iter().filter(|(name, _)| name.contains(&only)) {
        for dt in [1.0 / 60.0, 1.0 / 240.0, 1e-3, 2e-4, 1e-4] {
            for accuracy in [1e-3, 1e-4, 1e-5] {
                let seen = row(Case { dt, accuracy, ..case });
                println!("{dt:.1e} {accuracy:.0e} W {:.5e} v {:.5}", seen.volume, seen.speed);
            }
        }
    }
}

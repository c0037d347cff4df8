//! The table: Auto beside Lockstep, fine.

use crate::plugin::Resolve;
use nalgebra::Vector3;

use super::rig::Case;
use super::rows::{self, Outcome};

/// A row, what the reference makes of it, and the steps at which it is known to miss.
pub struct Row {
    pub name: &'static str,
    pub run: fn(Case) -> Outcome,
    reference: fn(Case) -> Outcome,
}

pub const ROWS: [Row; 10] = [
    Row {
        name: "loaded ball on soft ground",
        run: rows::loaded_ball,
        reference: rows::loaded_ball,
    },
    Row {
        name: "light block on a resting ball",
        run: rows::light_block_on_ball,
        reference: rows::light_block_on_ball,
    },
    Row {
        name: "heavy block on a resting ball",
        run: rows::heavy_block_on_ball,
        reference: rows::heavy_block_on_ball,
    },
    Row {
        name: "fixed-joint dumbbell",
        run: rows::fixed_joint_dumbbell,
        reference: rows::fixed_joint_dumbbell,
    },
    Row { name: "pendulum", run: rows::pendulum, reference: rows::pendulum },
    Row {
        name: "motor-driven scratch",
        run: rows::motor_driven_scratch,
        reference: rows::motor_driven_scratch,
    },
    Row { name: "struck stack", run: rows::struck_stack, reference: rows::struck_stack },
    Row { name: "rolling clump", run: rows::rolling_clump, reference: rows::rolling_clump },
    Row {
        name: "dumbbell as an articulation",
        run: rows::dumbbell_as_articulation,
        reference: rows::fixed_joint_dumbbell,
    },
    Row {
        name: "pendulum as an articulation",
        run: rows::pendulum_as_articulation,
        reference: rows::pendulum,
    },
];

/// Steps [s] with the errors allowed in W and in the speed [-].
const STEPS: [(f64, f64, f64); 3] =
    [(1e-3, 0.1, 0.05), (1.0 / 240.0, 0.1, 0.05), (1.0 / 60.0, 0.25, 0.25)];
const LOCKSTEP: f64 = 0.01;
/// Speed below which a body is at rest [m/s].
const REST: f64 = 0.01;

/// Known misses: row, run, and why. They are printed; everything else must hold.
const MISSES: [(&str, &str, &str); 3] = [
    (
        "struck stack",
        "lockstep at 1/240 s",
        "+1.2 % in f32: in what order the blow goes through six bodies in one step is up to the \
         solver; the reference itself moves by 1.2 % between f32 and f64",
    ),
    (
        "pendulum as an articulation",
        "lockstep at 1/240 s",
        "speed +1.3 %: Rapier alone swings an articulation back with +1.25 % at this step, a joint \
         with -0.02 %",
    ),
    (
        "dumbbell as an articulation",
        "lockstep at 1/240 s",
        "speed +1.2 %: Rapier alone does not keep the momentum of an articulation that spins",
    ),
];

fn is_known(row: &str, what: &str) -> bool {
    MISSES.iter().any(|(name, run, _)| *name == row && what.starts_with(run))
}

fn origins() -> [Vector3<f64>; 2] {
    [Vector3::zeros(), Vector3::new(10.0, -10.0, 10.0)]
}

/// Fails for a resolver that loses or makes up momentum, that wears by Rapier's penetration, or
/// whose wear depends on the embedder's step, its precision or the place.
fn check(row: &Row) {
    let origin = Vector3::zeros();
    let case = |resolve, dt, accuracy, origin| Case { dt, origin, resolve, accuracy };
    let reference = (row.reference)(case(Resolve::Lockstep, 1e-4, 1e-4, origin));
    println!("{}: W {:.4e} mm3, {:.4} m/s", row.name, reference.volume, reference.speed);
    let mut missed = Vec::new();
    let mut compare = |what: String, seen: Outcome, limits: [f64; 2]| {
        // A body at rest may ring on its springs: two such speeds are the same.
        let both_rest = seen.speed.max(reference.speed) < REST;
        let speed = if both_rest { 0.0 } else { seen.speed / reference.speed - 1.0 };
        let errors = [seen.volume / reference.volume - 1.0, speed];
        let counters = seen.counters;
        let text = format!(
            "  {what}: W {:+.2} %, speed {:+.2} % (micro {}, quasi-static {}, lockstep {}, {} steps)",
            100.0 * errors[0],
            100.0 * errors[1],
            counters.micro,
            counters.quasi_static,
            counters.lockstep,
            counters.steps,
        );
        println!("{text}");
        // An error that is no number is a miss.
        let holds = errors.iter().zip(limits).all(|(error, limit)| error.abs() <= limit);
        if !holds && !is_known(row.name, &what) {
            missed.push(text);
        }
    };
    let fine = (row.run)(case(Resolve::Lockstep, 1.0 / 240.0, 1e-3, origin));
    compare("lockstep at 1/240 s".into(), fine, [LOCKSTEP; 2]);
    for origin in origins() {
        for (dt, volume, speed) in STEPS {
            let seen = (row.run)(case(Resolve::Auto, dt, 1e-3, origin));
            compare(format!("auto at {dt:.4} s, {} m away", origin.x), seen, [volume, speed]);
        }
    }
    assert!(missed.is_empty(), "{}\n{}", row.name, missed.join("\n"));
}

macro_rules! rows {
    ($($test:ident: $row:literal),* $(,)?) => {
        $(#[test]
        fn $test() {
            check(&ROWS[$row]);
        })*
    };
}

rows! {
    a_loaded_ball_on_soft_ground: 0,
    a_light_block_on_a_resting_ball: 1,
    a_heavy_block_on_a_resting_ball: 2,
    a_fixed_joint_dumbbell: 3,
    a_pendulum: 4,
    a_motor_driven_scratch: 5,
    a_struck_stack: 6,
    a_rolling_clump: 7,
    a_dumbbell_as_an_articulation: 8,
    a_pendulum_as_an_articulation: 9,
}

/// Fails for a body that wears nothing because it slept when it was struck.
#[test]
fn a_sleeping_ball_is_struck_like_one_that_is_awake() {
    for (dt, volume, speed) in STEPS {
        let origin = Vector3::zeros();
        let case = Case { dt, origin, resolve: Resolve::Auto, accuracy: 1e-3 };
        let awake = rows::heavy_block_on_ball(case);
        let asleep = rows::heavy_block_on_sleeping_ball(case);
        let errors = [asleep.volume / awake.volume - 1.0, asleep.speed / awake.speed - 1.0];
        println!("{dt:.4} s: {errors:?}, {:?}", asleep.counters);
        assert!(errors[0].abs() <= volume && errors[1].abs() <= speed, "{errors:?} at {dt} s");
    }
}

/// Fails for a resting ball that wears, creeps or stays awake.
#[test]
fn a_resting_ball_wears_nothing_and_sleeps() {
    for origin in origins() {
        for (dt, _, _) in STEPS {
            let case = Case { dt, origin, resolve: Resolve::Auto, accuracy: 1e-3 };
            let seen = rows::resting_ball(case);
            assert!(seen.volume == 0.0 && seen.sleeps, "{seen:?} at {dt} s");
        }
    }
}

/// Fails for a box that rocks on its face until it digs itself in, or that is handed to and fro and
/// falls anew each time. It bears 0.8 of what the ground does: its edges wear, its face does not.
#[test]
fn a_pressed_box_stays_on_its_face() {
    for (dt, _, _) in STEPS {
        let case = Case { dt, origin: Vector3::zeros(), resolve: Resolve::Auto, accuracy: 3e-3 };
        let (seen, tilt) = rows::pressed_box(case);
        println!("{dt:.4} s: {seen:?}, tilt {tilt:e}");
        assert!(seen.volume < 0.5 && tilt < 1e-3, "{seen:?}, tilted by {tilt} at {dt} s");
    }
}

//! Many impacts in one step: the same bits whatever the threads, watched or not.

use super::rig::{GAP, RADIUS, Rig, towards_plate};
use crate::plugin::abrade::State;
use crate::plugin::rapier::prelude::*;
use crate::plugin::{MicroStep, Resolve, WearEvent, WearObserver, scalar};
use nalgebra::Vector3;

/// What a hail leaves behind.
#[derive(Debug, PartialEq)]
struct Outcome {
    depths: Vec<f64>,
    worn: String,
    events: Vec<WearEvent>,
    reports: Vec<String>,
    states: Vec<State>,
    counts: [u64; 4],
}

struct Watcher {
    bodies: Vec<RigidBodyHandle>,
}

impl WearObserver for Watcher {
    fn micro_step(&mut self, step: &MicroStep<'_, '_>) {
        if self.bodies.last() != Some(&step.body) {
            self.bodies.push(step.body);
        }
    }
}

/// A number in [0, 1) from a seed that goes on.
fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    (*seed >> 11) as f64 / (1u64 << 53) as f64
}

/// 300 balls that fall one after the other, many to a step, on spots and ways that cross.
fn hail(watcher: Option<&mut Watcher>) -> Outcome {
    let mut rig = Rig::wide(1.0 / 240.0);
    let mut seed = 7;
    let mut balls = Vec::new();
    for number in 0..300 {
        let [x, y, turn] = [(); 3].map(|()| random(&mut seed));
        let spot = Vector3::new(0.13 * (x - 0.5), 0.13 * (y - 0.5), RADIUS + GAP);
        let v = towards_plate(25.0 + 10.0 * turn, 70.0 + 20.0 * y);
        balls.push(rig.ball(spot - v * (3e-4 * f64::from(number)), v));
    }
    let (mut events, mut reports) = (Vec::new(), Vec::new());
    let mut unwatched = ();
    let observer: &mut dyn WearObserver = match watcher {
        Some(watcher) => watcher,
        None => &mut unwatched,
    };
    for _ in 0..24 {
        // A ball that Rapier has pushed through the plate is an error, and the same one for all.
        let report = rig.wear.step_observed(&mut rig.world, &(), &(), observer);
        reports.push(format!("{report:?}"));
        events.extend(rig.wear.events().to_vec());
    }
    let counters = rig.wear.counters();
    let surface = &rig.wear[rig.plate];
    Outcome {
        depths: surface.nodes().depth.clone(),
        worn: format!("{:?} {:?}", surface.worn(), rig.wear.ledger()),
        events,
        reports,
        states: balls.iter().map(|ball| rig.state(*ball)).collect(),
        counts: [counters.micro, counters.refused, counters.steps, counters.node_evaluations],
    }
}

/// Fails for sums or searches whose order depends on threads, for a body that is taken as run
/// ahead although another one has changed its nodes, and for a watched step that goes another way.
#[test]
fn a_hail_gives_the_same_bits_on_any_number_of_threads() {
    let in_pool = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| hail(None))
    };
    let mut watcher = Watcher { bodies: Vec::new() };
    let watched = hail(Some(&mut watcher));
    assert!(watched.counts[0] > 200 && watched.counts[1] > 0, "{:?}", watched.counts);
    assert!(watcher.bodies.len() as u64 >= watched.counts[0]);
    for threads in [1, 2, 4] {
        assert!(in_pool(threads) == watched, "{threads} threads");
    }
}

/// Two balls that strike the same spot in one step, `later` [s] after each other: bodies resolved
/// and refused, and the depths.
fn strike_twice(later: f64, observer: &mut dyn WearObserver) -> (u64, u64, Vec<f64>) {
    let mut rig = Rig::resolved_by(Resolve::Micro, Vector3::zeros(), 1.0 / 240.0);
    let v = towards_plate(10.0, 45.0);
    rig.ball(Vector3::z() * (RADIUS + GAP), v);
    rig.ball(Vector3::z() * (RADIUS + GAP) - v * later, v);
    rig.wear.step_observed(&mut rig.world, &(), &(), observer).expect("a step");
    let counters = rig.wear.counters();
    (counters.micro, counters.refused, rig.wear[rig.plate].nodes().depth.clone())
}

/// Fails for a gate to which a path is a place without a time, for one that lets bodies through
/// each other, and for a second strike that is taken as it was without the first.
#[test]
fn two_bodies_may_strike_one_spot_one_after_the_other() {
    let watched = strike_twice(3e-3, &mut Watcher { bodies: Vec::new() });
    assert_eq!((watched.0, watched.1), (2, 0));
    assert!(strike_twice(3e-3, &mut ()) == watched);
    let (_, refused, _) = strike_twice(3e-4, &mut ());
    assert!(refused > 0);
}

/// Fails for a path that is free at its ends alone: a body crosses it half way through the step.
#[test]
fn a_path_that_is_crossed_in_the_same_instant_is_refused() {
    for (late, expected) in [(0.0, 1), (2.0 / 240.0, 0)] {
        let dt = 1.0 / 60.0;
        let mut rig = Rig::resolved_by(Resolve::Micro, Vector3::zeros(), dt);
        let fall = 6.0;
        rig.ball(Vector3::z() * (RADIUS + 0.9 * fall * dt), towards_plate(fall, 90.0));
        // Across the path of the first, above the plate, where the first is at half time.
        let speed = 10.0;
        let at = Vector3::new(-speed * (0.5 * dt + late), 0.0, RADIUS + 0.4 * fall * dt);
        let crossing = rig.ball(at, Vector3::x() * speed);
        rig.step();
        let refused = rig.wear.counters().refused;
        assert_eq!(refused, expected, "{late} s late");
        assert!(scalar::vector(rig.world.bodies[crossing].linvel()).x > 0.0);
    }
}

//! Micro results depend neither on the embedder's step nor on the origin.

use super::rig::{GAP, RADIUS, Rig, body, by_core, towards_plate};
use crate::plugin::abrade::{State, Until};
use crate::plugin::rapier::dynamics::RigidBodyHandle;
use crate::plugin::{WearSettings, WearWorld, scalar};
use nalgebra::Vector3;

/// Tolerances of the project: dv/v and dW/W.
const VELOCITY: f64 = 5e-4;
const WEAR: f64 = 2e-3;

/// Compares the ball, which was at `start` in the plate's frame, with what the core makes of it.
fn compare(what: &str, rig: &Rig, ball: RigidBodyHandle, start: State) {
    let (velocity, spin, wear) = by_core(start);
    let state = rig.state(ball);
    let dv = (state.velocity - velocity).norm() / velocity.norm();
    let dw = (rig.wear[rig.plate].wear_volume() / wear - 1.0).abs();
    let dspin = (state.spin - spin).norm() / spin.norm().max(1.0);
    println!("{what}: dv/v {dv:.1e}, dW/W {dw:.1e}, d spin {dspin:.1e}");
    assert!(wear > 0.0);
    assert!(dv < VELOCITY && dw < WEAR && dspin < VELOCITY, "{what}: {dv:e} {dw:e} {dspin:e}");
}

/// Fails for a contact that is cut by the embedder's steps, for a spin that Rapier caps, and for
/// a state kept in Rapier's numbers, which at 10 m resolve a micrometre in f32.
#[test]
fn an_oblique_impact_is_the_cores_at_any_step_and_origin() {
    let v = towards_plate(35.0, 45.0);
    for origin in [Vector3::zeros(), Vector3::repeat(10.0)] {
        for dt in [1.0 / 60.0, 1e-3, 1e-4, 1e-6] {
            let mut rig = Rig::new(origin, dt);
            let at = origin + Vector3::z() * RADIUS;
            let ball = rig.ball(at, v);
            let (bodies, colliders) = (&mut rig.world.bodies, &rig.world.colliders);
            rig.wear.place_on(rig.plate, ball, body(v), bodies, colliders).expect("the ball");
            let start = rig.state(ball);
            let steps = (2e-5 / dt).ceil() as usize;
            (0..steps).for_each(|_| rig.step());
            compare(&format!("placed, dt {dt:.1e}, at {} m", origin.x), &rig, ball, start);
        }
    }
}

/// The same without registration, from the pose that Rapier holds.
#[test]
fn a_body_that_nobody_registered_wears_the_same() {
    let v = towards_plate(35.0, 60.0);
    for origin in [Vector3::zeros(), Vector3::repeat(10.0)] {
        for dt in [1.0 / 60.0, 1e-3, 1e-4] {
            let mut rig = Rig::new(origin, dt);
            let ball = rig.ball(origin + Vector3::z() * (RADIUS + 4.0 * GAP), v);
            let start = rig.state(ball);
            let steps = (2e-5 / dt).ceil() as usize;
            (0..steps).for_each(|_| rig.step());
            compare(&format!("unregistered, dt {dt:.1e}, at {} m", origin.x), &rig, ball, start);
        }
    }
}

/// Fails for a body that tunnels: at 1/60 s it crosses the plate, which is 2 cm thick, 80 times.
#[test]
fn a_ball_at_100_m_per_s_is_caught_at_game_steps() {
    let v = towards_plate(100.0, 90.0);
    let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
    let ball = rig.ball(Vector3::z() * 0.7, v);
    let began = std::time::Instant::now();
    rig.step();
    println!("a 100 m/s impact at 1/60 s: {:?}, {:?}", began.elapsed(), rig.wear.counters());
    let state = rig.wear.state(ball, &rig.world.bodies).expect("the ball");
    assert!(state.velocity.z > 0.0 && state.position.z > RADIUS, "{state:?}");
    assert!(rig.wear[rig.plate].wear_volume() > 0.0);
}

/// Fails for a step whose end is not the first exit.
#[test]
fn a_first_exit_ends_the_step() {
    let v = towards_plate(35.0, 45.0);
    let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
    let settings = WearSettings { until: Until::FirstExit, ..Default::default() };
    rig.wear = WearWorld::new(settings);
    let (world, surface) = (&mut rig.world, super::rig::surface());
    rig.plate = rig.wear.insert_on_top(surface, rig.proxy, &mut world.colliders).expect("a proxy");
    let ball = rig.ball(Vector3::z() * RADIUS, v);
    let (bodies, colliders) = (&mut rig.world.bodies, &rig.world.colliders);
    rig.wear.place_on(rig.plate, ball, body(v), bodies, colliders).expect("the ball");
    let start = rig.state(ball);
    let report = rig.wear.step(&mut rig.world, &(), &()).expect("a step");
    assert_eq!(report.exited, Some(ball));
    assert!(report.dt > 0.0 && report.dt < 1e-4, "{report:?}");
    assert!(rig.world.integration_parameters.dt > scalar::narrow(0.01));
    let state = rig.wear.state(ball, &rig.world.bodies).expect("the ball");
    assert!(state.position.z - RADIUS < 1e-4, "{state:?}");
    compare("first exit", &rig, ball, start);
}

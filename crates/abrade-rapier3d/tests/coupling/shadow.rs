//! The exact state behind Rapier's rounded one.

use super::rig::{GAP, RADIUS, Rig, body, surface, towards_plate};
use crate::plugin::abrade::{Encounter, EncounterSettings, Loads, Placed, Until};
use crate::plugin::scalar;
use nalgebra::{Isometry3, Vector3};

/// Fails for a body that moves by Rapier's numbers: at 10 m a step of 1e-8 s is below their
/// resolution in f32, and the body would stand still.
#[test]
fn steps_below_the_resolution_of_a_pose_still_add_up() {
    let origin = Vector3::repeat(10.0);
    let mut rig = Rig::new(origin, 1e-8);
    let v = towards_plate(35.0, 90.0);
    let ball = rig.ball(origin + Vector3::z() * RADIUS, v);
    let (bodies, colliders) = (&mut rig.world.bodies, &rig.world.colliders);
    rig.wear.place_on(rig.plate, ball, body(v), bodies, colliders).expect("the ball");
    (0..2).for_each(|_| rig.step());
    let frame = rig.wear.frame(rig.plate, &rig.world.colliders).expect("the plate");
    let state = rig.wear.state_from(&frame, ball, &rig.world.bodies).expect("the ball");
    let expected = RADIUS + GAP - 2e-8 * 35.0;
    // The step itself is held in Rapier's numbers.
    let rounding = 1e-6 * 2e-8 * 35.0;
    assert!((state.position.z - expected).abs() < rounding, "{} m", state.position.z - expected);
}

/// Fails for a shadow that outlives what the embedder does to the body, or dies of it.
#[test]
fn the_embedders_changes_count() {
    let mut rig = Rig::new(Vector3::zeros(), 1e-5);
    let v = towards_plate(0.1, 90.0);
    let ball = rig.ball(Vector3::z() * RADIUS, v);
    let (bodies, colliders) = (&mut rig.world.bodies, &rig.world.colliders);
    let mut exact = body(v);
    exact.state.position.z += 1e-5 + 1e-12;
    rig.wear.place_on(rig.plate, ball, exact.clone(), bodies, colliders).expect("the ball");
    let read = |rig: &Rig| rig.wear.state(ball, &rig.world.bodies).expect("the ball");
    assert_eq!(read(&rig).position, exact.state.position);
    let push = scalar::to_vector(&Vector3::new(0.5, 0.0, 0.0));
    rig.world.bodies[ball].set_linvel(push, true);
    let state = read(&rig);
    assert_eq!(state.position, exact.state.position, "a push moves nothing");
    assert!((state.velocity - scalar::vector(push)).norm() < 1e-7);
    let at = scalar::to_vector(&Vector3::new(1.0, 2.0, 3.0));
    rig.world.bodies[ball].set_translation(at, true);
    let moved: Vector3<f64> = read(&rig).position.coords;
    assert_eq!(moved, scalar::vector(at), "a body that was moved is where it was moved to");
    assert_eq!(
        read(&rig),
        rig.wear.state_from(&Isometry3::identity(), ball, &rig.world.bodies).expect("the ball")
    );
}

/// Fails for gravity, forces or damping that are taken for a push of others, which would leave
/// Rapier's own flight, and for a spin beyond Rapier's cap of 47 rad/s that is cut.
#[test]
fn loads_are_the_cores_affair() {
    let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
    rig.world.gravity = scalar::to_vector(&Vector3::new(0.0, 0.0, -9.81));
    let v = Vector3::new(0.05, 0.0, 0.3);
    let mut start = body(v);
    start.state.spin = Vector3::new(0.0, 300.0, 40.0);
    let ball = rig.ball(Vector3::z() * RADIUS, v);
    let rb = &mut rig.world.bodies[ball];
    rb.set_linear_damping(scalar::narrow(0.5));
    rb.set_angular_damping(scalar::narrow(0.25));
    rb.add_force(scalar::to_vector(&Vector3::new(1e-4, 0.0, 0.0)), true);
    rb.add_torque(scalar::to_vector(&Vector3::new(0.0, 1e-8, 0.0)), true);
    let (force, torque) = (scalar::vector(rb.user_force()), scalar::vector(rb.user_torque()));
    let (bodies, colliders) = (&mut rig.world.bodies, &rig.world.colliders);
    rig.wear.place_on(rig.plate, ball, start.clone(), bodies, colliders).expect("the ball");
    rig.step();

    let loads = Loads {
        gravity: scalar::vector(rig.world.gravity),
        force,
        torque,
        linear_damping: 0.5,
        angular_damping: 0.25,
    };
    let mut surface = surface();
    let settings = EncounterSettings::default();
    let mut encounter = Encounter::new(&start, [&surface], settings).expect("an encounter");
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    let dt = scalar::wide(rig.world.integration_parameters.dt);
    encounter
        .advance(&mut start, &mut placed, &loads, dt, Until::Duration, &mut ())
        .expect("a flight");
    let state = rig.state(ball);
    assert_eq!(rig.wear.counters().micro, 1);
    assert_eq!(state, start.state);
    let spin = scalar::vector(rig.world.bodies[ball].angvel());
    assert!((spin - state.spin).norm() < 1e-6 * spin.norm() && spin.norm() > 250.0);
}

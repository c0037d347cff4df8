//! The exact state behind Rapier's rounded one.

use super::rig::{GAP, RADIUS, Rig, body, towards_plate};
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

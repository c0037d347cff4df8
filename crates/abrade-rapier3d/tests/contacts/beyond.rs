//! A body whose crater gets deeper than it is, which is outside the model: it is said of that body,
//! and the island around it goes on.

use crate::plugin::rapier::prelude::*;
use crate::plugin::{Resolve, WearEvent, scalar};
use nalgebra::Vector3;

use super::rig::{Case, GRAVITY, Plate, Rig, vector};

/// Radius of the light ball, and distance of the heavy one's middle from its own [m].
const RADIUS: f64 = 10e-3;
const ARM: f64 = 50e-3;
/// Speed at which they come down [m/s].
const SPEED: f64 = 10.0;
/// Share of its radius by which Rapier's contact with the ground gives way under the heavy ball [-].
const GIVES: f64 = 0.1;

/// A heavy ball above a light one, which it drives into soft ground.
fn ram() -> (Rig, [RigidBodyHandle; 2], GenericJoint) {
    let plate = Plate { length: 0.4, width: 0.4, pitch: 5e-3, hardness: 1e6, young: 50e6 };
    let (origin, resolve) = (Vector3::zeros(), Resolve::Auto);
    let case = Case { dt: 1.0 / 60.0, origin, resolve, accuracy: 1e-2 };
    let mut rig = Rig::new(case, &plate, Vector3::z() * -GRAVITY, 0.1);
    let balls = [(ARM, 20e-3), (0.0, RADIUS)].map(|(above, radius)| {
        let body = rig.body(Vector3::z() * (0.05 + above)).linvel(vector(0.0, 0.0, -SPEED));
        rig.ball(body, radius, 5000.0)
    });
    let joint = FixedJointBuilder::new().local_anchor1(vector(0.0, 0.0, -ARM));
    (rig, balls, joint.build().data)
}

/// Steps until a crater is said to be too deep: under the light ball, and no other, which must have
/// stopped there with the heavy one. For another half a second nothing drives it further in.
fn drive_in(mut rig: Rig, [heavy, light]: [RigidBodyHandle; 2]) {
    let start = rig.energy();
    let fails = |rig: &mut Rig| rig.wear.step(&mut rig.world, &(), &()).is_err();
    assert!((0..3).any(|_| fails(&mut rig)), "no crater was too deep");
    let failed = |event: &WearEvent| match event {
        WearEvent::Failed { body, .. } => Some(*body),
        _ => None,
    };
    let failed: Vec<_> = rig.wear.events().iter().filter_map(failed).collect();
    assert_eq!(failed, [light]);
    let [above, below] = [heavy, light].map(|body| rig.world.bodies[body].center_of_mass());
    let arm = scalar::wide((above - below).length());
    let speed = rig.speed(heavy).max(rig.speed(light));
    println!("arm {arm} m, speed {speed:e} m/s");
    assert!((arm / ARM - 1.0).abs() < 1e-3 && speed < 1e-3 * SPEED);
    for _ in 0..30 {
        fails(&mut rig);
        let height = scalar::vector(rig.world.bodies[light].center_of_mass()).z;
        assert!(height > -GIVES * RADIUS && rig.energy() < start, "{height} m");
    }
}

/// Fails for an island that is given up for one of its bodies, every one of them left where a coarse
/// step of Rapier's put it, and for another body blamed.
#[test]
fn a_ball_that_is_driven_in_too_deep_stops_there() {
    let (mut rig, balls, joint) = ram();
    rig.joint(balls, joint);
    drive_in(rig, balls);
}

/// The same for bodies whose states follow from the coordinates of an articulation.
#[test]
fn a_link_that_is_driven_in_too_deep_stops_there() {
    let (mut rig, balls, joint) = ram();
    rig.link(balls, joint);
    drive_in(rig, balls);
}

//! The gate: who is resolved, who is left to Rapier, and what either sees of the other.

use super::rig::{GAP, RADIUS, Rig, body, by_core, towards_plate};
use crate::plugin::rapier::math::{Pose, Vector};
use crate::plugin::rapier::prelude::*;
use crate::plugin::{Refusal, Resolve, WearEvent, scalar};
use nalgebra::Vector3;

fn refusals(rig: &Rig) -> Vec<Refusal> {
    let reason = |event: &WearEvent| match event {
        WearEvent::NotResolved { reason, .. } => Some(*reason),
        _ => None,
    };
    rig.wear.events().iter().filter_map(reason).collect()
}

/// Fails for a pair that both resolve.
#[test]
fn rapier_gives_no_impulse_to_a_pair_that_wear_resolves() {
    for dt in [1.0 / 60.0, 1e-6] {
        let mut rig = Rig::new(Vector3::zeros(), dt);
        let ball = rig.ball(Vector3::z() * (RADIUS + GAP), towards_plate(35.0, 90.0));
        let collider = rig.collider(ball);
        for _ in 0..4 {
            rig.step();
            let pair = rig.world.narrow_phase.contact_pair(collider, rig.proxy);
            assert!(pair.is_none_or(|pair| !pair.has_any_active_contact()), "dt {dt}");
        }
        assert!(rig.wear.counters().micro > 0 && rig.wear.counters().refused == 0);
        assert!(rig.wear[rig.plate].wear_volume() > 0.0);
    }
}

/// Fails for a gate that overlooks joints, or that takes Rapier's contact away from the refused.
#[test]
fn a_jointed_body_keeps_rapiers_contact_and_says_so() {
    let mut rig = Rig::resolved_by(Resolve::Micro, Vector3::zeros(), 1.0 / 60.0);
    rig.world.integration_parameters.length_unit = scalar::narrow(0.01);
    let v = towards_plate(0.05, 90.0);
    let one = rig.ball(Vector3::new(0.0, 0.0, 0.0035), v);
    let other = rig.ball(Vector3::new(0.0, 0.0, 0.0135), v);
    let arm = scalar::narrow(0.01);
    let joint = FixedJointBuilder::new().local_anchor1(Vector::new(arm * 0.0, arm * 0.0, arm));
    rig.world.impulse_joints.insert(one, other, joint, true);
    let mut seen = 0;
    for _ in 0..30 {
        rig.step();
        seen += refusals(&rig).iter().filter(|&&reason| reason == Refusal::Jointed).count();
    }
    let z = scalar::vector(rig.world.bodies[one].translation()).z;
    assert!(z > 0.9 * RADIUS, "the ball fell to {z} m");
    assert!(seen > 0 && rig.wear.counters().micro == 0);
    assert_eq!(rig.wear[rig.plate].wear_volume(), 0.0);
}

/// Fails for a gate that looks at the present alone, or at Rapier's narrow phase.
#[test]
fn a_body_with_something_in_its_way_is_refused() {
    let mut rig = Rig::resolved_by(Resolve::Micro, Vector3::zeros(), 1.0 / 60.0);
    let ball = rig.ball(Vector3::z() * (RADIUS + GAP), towards_plate(0.3, 10.0));
    let h = scalar::narrow(1e-3);
    let wall = ColliderBuilder::cuboid(h, h, h * 10.0);
    let wall = wall.translation(scalar::to_vector(&Vector3::x().scale(7e-3)));
    let wall = rig.world.colliders.insert(wall);
    rig.step();
    assert_eq!(refusals(&rig), [Refusal::Obstructed { collider: wall }]);
    let groups = InteractionGroups::new(Group::GROUP_2, Group::NONE, InteractionTestMode::And);
    rig.world.colliders[wall].set_collision_groups(groups);
    let (at, v) = (Vector3::z() * (RADIUS + GAP), towards_plate(0.3, 10.0));
    rig.world.bodies[ball].set_translation(scalar::to_vector(&at), true);
    rig.world.bodies[ball].set_linvel(scalar::to_vector(&v), true);
    rig.step();
    assert_eq!(refusals(&rig), [], "a wall that the ball does not feel is in nobody's way");
}

/// Fails for a gate that takes the ground under a plate for something in the way of whatever
/// falls on the plate.
#[test]
fn ground_under_the_plate_is_in_nobodys_way() {
    let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
    let z = scalar::to_vector(&Vector3::z());
    let ground = ColliderBuilder::new(SharedShape::halfspace(z));
    let ground = ground.translation(scalar::to_vector(&(Vector3::z() * -0.02)));
    rig.world.colliders.insert(ground);
    rig.ball(Vector3::z() * (RADIUS + GAP), towards_plate(35.0, 90.0));
    rig.step();
    assert_eq!((refusals(&rig), rig.wear.counters().micro), (vec![], 1));
}

/// Fails for a rebound that is carried through whatever is above the plate.
#[test]
fn a_rebound_stops_short_of_a_ceiling() {
    let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
    let (wide, thin) = (scalar::narrow(1.0), scalar::narrow(0.05));
    let ceiling = ColliderBuilder::cuboid(wide, wide, thin);
    let at = Vector3::z() * 0.15;
    rig.world.colliders.insert(ceiling.translation(scalar::to_vector(&at)));
    let ball = rig.ball(Vector3::z() * 0.05, towards_plate(35.0, 90.0));
    for _ in 0..20 {
        rig.step();
        let z = scalar::vector(rig.world.bodies[ball].translation()).z;
        assert!(z > 0.0 && z < 0.1, "the ball is at {z} m");
    }
    assert!(rig.wear[rig.plate].wear_volume() > 0.0);
}

/// Fails for a gate that resolves what the model lacks, or that fails instead of refusing.
#[test]
fn shapes_and_locks_without_a_model_are_refused() {
    let mut rig = Rig::resolved_by(Resolve::Micro, Vector3::zeros(), 1.0 / 60.0);
    let r = scalar::narrow(RADIUS);
    let above = scalar::to_vector(&(Vector3::z() * 2.0 * RADIUS));
    let body = || RigidBodyBuilder::dynamic().translation(above);
    let (capsule, _) = rig.world.insert(body(), ColliderBuilder::capsule_x(r, r));
    let collider = rig.collider(capsule);
    rig.world.bodies[capsule].set_linvel(scalar::to_vector(&towards_plate(1.0, 90.0)), true);
    rig.step();
    assert_eq!(refusals(&rig), [Refusal::Shape { collider }]);
    rig.world.remove_body(capsule);
    let locked = body().locked_axes(LockedAxes::TRANSLATION_LOCKED_X);
    let (locked, _) = rig.world.insert(locked, ColliderBuilder::ball(r));
    rig.world.bodies[locked].set_linvel(scalar::to_vector(&towards_plate(1.0, 90.0)), true);
    rig.step();
    assert_eq!(refusals(&rig), [Refusal::LockedAxes]);
}

/// Fails for contacts that are announced twice, or never.
#[test]
fn a_contact_that_spans_steps_starts_and_ends_once() {
    let mut rig = Rig::new(Vector3::zeros(), 1e-6);
    let v = towards_plate(35.0, 90.0);
    let ball = rig.ball(Vector3::z() * (RADIUS + GAP), v);
    let mut events = Vec::new();
    for _ in 0..30 {
        rig.step();
        events.extend(rig.wear.events().to_vec());
    }
    let [WearEvent::Started { .. }, WearEvent::Ended { impulse, volume, contact_time, .. }] =
        events.as_slice()
    else {
        panic!("{events:?}")
    };
    let after = rig.wear.state(ball, &rig.world.bodies).expect("the ball").velocity;
    let mass = scalar::wide(rig.world.bodies[ball].mass());
    assert!((impulse - (after - v) * mass).norm() < 1e-5 * impulse.norm());
    let wear = rig.wear[rig.plate].wear_volume();
    assert!((volume / wear - 1.0).abs() < 1e-9, "{volume:e} of {wear:e}");
    assert!(*contact_time > 1e-6 && *contact_time < 30e-6);
}

/// Fails for a body that is still held where it was, or a proxy whose move is overlooked.
#[test]
fn a_plate_that_was_moved_away_is_out_of_reach() {
    let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
    let ball = rig.ball(Vector3::z() * (RADIUS + GAP), towards_plate(1.0, 90.0));
    let far = Vector3::new(0.0, 0.0, -5.0);
    let pose = Pose::from_translation(scalar::to_vector(&far));
    rig.world.colliders[rig.proxy].set_position(pose);
    rig.step();
    assert_eq!(rig.wear.counters().micro, 0);
    assert!(scalar::vector(rig.world.bodies[ball].translation()).z < -0.01);
}

/// Fails for a gate that takes a fast body for being everywhere it could fly to: bodies that
/// strike side by side in one step of a game are each resolved, and each as on its own.
#[test]
fn bodies_that_strike_side_by_side_are_all_resolved() {
    let v = towards_plate(35.0, 45.0);
    let strike = |spots: &[f64]| {
        let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
        for x in spots {
            rig.ball(Vector3::new(*x, 0.0, RADIUS + GAP), v);
        }
        rig.step();
        assert_eq!((refusals(&rig), rig.wear.counters().micro), (vec![], spots.len() as u64));
        rig.wear[rig.plate].wear_volume()
    };
    let (one, other) = (strike(&[-6e-3]), strike(&[6e-3]));
    let both = strike(&[-6e-3, 6e-3]);
    assert!((both / (one + other) - 1.0).abs() < 1e-12, "{both:e} of {one:e} + {other:e}");
}

/// Fails for a look along the path alone: over the edge of the plate Rapier's contact is askew, and
/// brakes a ball that comes no nearer than its next steps.
#[test]
fn rapier_does_not_brake_a_body_that_comes_in_over_the_edge() {
    let dt = 1.0 / 60.0;
    let mut rig = Rig::new(Vector3::zeros(), dt);
    let velocity = Vector3::new(0.156, 0.0, -0.0766) * (RADIUS / dt);
    let ball = rig.ball(Vector3::new(-15e-3 - 0.115 * RADIUS, 0.0, 1.1017 * RADIUS), velocity);
    rig.step();
    let rb = &rig.world.bodies[ball];
    let change = scalar::vector(rb.linvel()) - velocity;
    assert!(scalar::vector(rb.translation()).z > RADIUS);
    assert!(change.norm() < 1e-5 * velocity.norm() && rb.angvel().length() < 1e-3, "{change}");
}

/// Fails for a path of Rapier's mass, which is none here: a force then takes the body to infinity, and
/// no surface is near it.
#[test]
fn a_force_moves_a_body_by_the_mass_that_it_was_registered_with() {
    let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
    let v = towards_plate(35.0, 60.0);
    let (_, _, wear) = by_core(body(v).state);
    let ball = rig.ball(Vector3::z() * (RADIUS + GAP), v);
    let collider = rig.collider(ball);
    rig.world.colliders[collider].set_density(scalar::narrow(0.0));
    let Rig { world, wear: by_wear, .. } = &mut rig;
    by_wear.place(ball, body(v), &mut world.bodies, &world.colliders).expect("a ball");
    // Its weight.
    let force = Vector3::z() * (-9.81 * body(v).inertia.mass);
    rig.world.bodies[ball].add_force(scalar::to_vector(&force), true);
    rig.step();
    assert_eq!((refusals(&rig), rig.wear.counters().micro), (vec![], 1));
    let miss = rig.wear[rig.plate].wear_volume() / wear - 1.0;
    // Over the gap its weight changes its energy by 3e-8.
    assert!(miss.abs() < 1e-4, "{miss:e}");
}

/// Fails for a proxy that is a sensor, with which Rapier makes no contact, and which turns a ball round all the same.
#[test]
fn a_proxy_that_is_a_sensor_is_met_by_nobody() {
    let mut rig = Rig::new(Vector3::zeros(), 1e-3);
    rig.world.colliders[rig.proxy].set_sensor(true);
    let velocity = towards_plate(5.0, 90.0);
    let ball = rig.ball(Vector3::z() * (RADIUS + GAP), velocity);
    (0..3).for_each(|_| rig.step());
    let change = scalar::vector(rig.world.bodies[ball].linvel()) - velocity;
    assert!(change.norm() < 1e-6, "{change}");
    assert_eq!((rig.wear[rig.plate].wear_volume(), rig.wear.counters().micro), (0.0, 0));
}

//! Driven bodies: who may be one, and for how long.

use super::rig::{RADIUS, Rig, body, surface};
use crate::plugin::abrade::{Drive, DriveSolution, PhysicsError};
use crate::plugin::rapier::prelude::*;
use crate::plugin::{Led, WearError, WearEvent, scalar};
use nalgebra::Vector3;

/// A kinematic body on the plate.
fn insert(rig: &mut Rig, by: RigidBodyType) -> RigidBodyHandle {
    let at = scalar::to_vector(&(Vector3::z() * RADIUS));
    let builder = RigidBodyBuilder::new(by).translation(at);
    rig.world.insert(builder, ColliderBuilder::ball(scalar::narrow(RADIUS))).0
}

/// Drives it along x under a load.
fn drive(rig: &mut Rig, handle: RigidBodyHandle) -> Result<(), WearError> {
    drive_under(rig, handle, 1000.0)
}

/// The same under that `load` [N].
fn drive_under(rig: &mut Rig, handle: RigidBodyHandle, load: f64) -> Result<(), WearError> {
    let (solution, speed) = (DriveSolution::Dynamic, 0.2);
    let drive = Drive { indent_to: load, load, speed, distance: 4e-3, mass: 0.05, solution };
    rig.wear.drive(rig.plate, handle, body(Vector3::zeros()), drive, &rig.world.bodies)
}

/// Fails for a second drive beside the first, which wears the surface twice, and for a body that
/// Rapier would move by its own velocity.
#[test]
fn a_body_has_one_drive_and_follows_it() {
    let mut rig = Rig::new(Vector3::zeros(), 1e-3);
    let by_velocity = insert(&mut rig, RigidBodyType::KinematicVelocityBased);
    let refused = drive(&mut rig, by_velocity);
    assert_eq!(refused, Err(WearError::NotByPosition { body: by_velocity }));
    let body = insert(&mut rig, RigidBodyType::KinematicPositionBased);
    assert_eq!(drive(&mut rig, body), Ok(()));
    let again = drive(&mut rig, body);
    assert_eq!(again, Err(WearError::LedAlready { body, led: Led::Driven }));
}

/// Fails for a drive that wears on without a body, and for one whose energies go with it.
#[test]
fn a_drive_ends_with_its_body() {
    let mut rig = Rig::new(Vector3::zeros(), 1e-3);
    let body = insert(&mut rig, RigidBodyType::KinematicPositionBased);
    drive(&mut rig, body).expect("a drive");
    rig.step();
    rig.step();
    let (worn, work) = (rig.wear[rig.plate].wear_volume(), rig.wear.ledger().wear);
    assert!(worn > 0.0 && work > 0.0, "{worn:e} m3, {work:e} J");
    rig.world.remove_body(body);
    rig.step();
    assert_eq!((rig.wear[rig.plate].wear_volume(), rig.wear.ledger().wear), (worn, work));
    assert!(rig.wear.driven(body).is_none());
    assert_eq!(rig.wear.ledger().elastic, 0.0);
}

/// Fails for a drive that goes on in the world's frame, wearing, when its surface can no longer be met: the body
/// would jump by how far the plate is from the origin.
#[test]
fn a_drive_stands_still_while_its_surface_cannot_be_met() {
    let at = Vector3::new(10.0, 0.0, 0.0);
    for gone in [
        |rig: &mut Rig| drop(rig.world.remove_collider(rig.proxy)),
        |rig: &mut Rig| rig.world.colliders[rig.proxy].set_enabled(false),
        |rig: &mut Rig| rig.world.colliders[rig.proxy].set_sensor(true),
    ] {
        let mut rig = Rig::new(at, 1e-3);
        let tip = insert(&mut rig, RigidBodyType::KinematicPositionBased);
        drive(&mut rig, tip).expect("a drive");
        (0..2).for_each(|_| rig.step());
        let read =
            |rig: &Rig| (rig.wear[rig.plate].wear_volume(), rig.world.bodies[tip].translation());
        let before = read(&rig);
        assert!(before.0 > 0.0 && before.1.x > 9.0, "{before:?}");
        gone(&mut rig);
        (0..2).for_each(|_| rig.step());
        assert_eq!(read(&rig), before);
    }
}

/// Fails for a failing drive that only the first error of a step tells, for one that digs on from step to step, and
/// for a step whose length is lost with its error.
#[test]
fn every_drive_that_fails_is_told() {
    let mut rig = Rig::new(Vector3::zeros(), 1e-3);
    let tips: Vec<_> =
        (0..2).map(|_| insert(&mut rig, RigidBodyType::KinematicPositionBased)).collect();
    for tip in &tips {
        drive_under(&mut rig, *tip, 1e9).expect("a drive");
    }
    let mut depth = 0.0;
    for _ in 0..3 {
        let error = rig.wear.step(&mut rig.world, &(), &()).unwrap_err();
        assert!(matches!(error, WearError::Physics { body, .. } if body == tips[0]), "{error}");
        let failed: Vec<_> = rig
            .wear
            .events()
            .iter()
            .filter_map(|event| match event {
                WearEvent::Failed { body, error: PhysicsError::LoadNotReached { .. }, .. } => {
                    Some(*body)
                }
                _ => None,
            })
            .collect();
        assert_eq!(failed, tips);
        assert!((rig.wear.last_step().dt - 1e-3).abs() < 1e-9);
        let deepest = rig.wear[rig.plate].deepest();
        assert!(depth == 0.0 || deepest == depth, "{deepest:e}");
        depth = deepest;
    }
}

/// Fails for a panic where a surface is that of another world.
#[test]
fn a_surface_of_another_world_is_refused() {
    let (mut rig, mut other) = (Rig::new(Vector3::zeros(), 1e-3), Rig::new(Vector3::zeros(), 1e-3));
    let box_ = ColliderBuilder::cuboid(0.1, 0.1, 0.1);
    let proxy = other.world.colliders.insert(box_);
    let more = other.wear.insert_on_top(surface(), proxy, &mut other.world.colliders);
    rig.plate = more.expect("a proxy");
    let missing = WearError::NoSuchSurface { surface: rig.plate };
    let tip = insert(&mut rig, RigidBodyType::KinematicPositionBased);
    assert_eq!(drive(&mut rig, tip), Err(missing.clone()));
    let colliders = &mut rig.world.colliders;
    assert_eq!(rig.wear.frame(rig.plate, colliders), Err(missing.clone()));
    assert_eq!(rig.wear.sync_colliders(rig.plate, colliders), Err(missing));
    assert!(rig.wear.query_colliders(rig.plate).is_empty());
}

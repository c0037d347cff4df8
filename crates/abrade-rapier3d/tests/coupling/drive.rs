//! Driven bodies: who may be one, and for how long.

use super::rig::{RADIUS, Rig, body};
use crate::plugin::abrade::{Drive, DriveSolution};
use crate::plugin::rapier::prelude::*;
use crate::plugin::{Led, WearError, scalar};
use nalgebra::Vector3;

/// A kinematic body on the plate.
fn insert(rig: &mut Rig, by: RigidBodyType) -> RigidBodyHandle {
    let at = scalar::to_vector(&(Vector3::z() * RADIUS));
    let builder = RigidBodyBuilder::new(by).translation(at);
    rig.world.insert(builder, ColliderBuilder::ball(scalar::narrow(RADIUS))).0
}

/// Drives it along x under a load.
fn drive(rig: &mut Rig, handle: RigidBodyHandle) -> Result<(), WearError> {
    let solution = DriveSolution::Dynamic;
    let (load, speed) = (1000.0, 0.2);
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

//! Contacts that are broken off where they are: the embedder moves the body, or another resolver takes
//! it over.

use super::rig::{DENSITY, GAP, RADIUS, Rig, STRIP, plate_of, towards_plate};
use crate::plugin::abrade::Inertia;
use crate::plugin::rapier::prelude::*;
use crate::plugin::{Resolve, Resolver, WearEvent, scalar};
use nalgebra::Vector3;

/// Takes a body away from the plate.
fn take_away(rig: &mut Rig, body: RigidBodyHandle) {
    let far = scalar::to_vector(&Vector3::z());
    rig.world.bodies[body].set_translation(far, true);
    rig.step();
}

/// Fails for springs that go on storing energy in the ledger when nothing touches them any more: those
/// of Micro, and those that Lockstep keeps between its steps.
#[test]
fn springs_of_a_body_that_is_taken_away_store_nothing() {
    let velocity = towards_plate(35.0, 60.0);
    let energy = 0.5 * Inertia::of_ball(RADIUS, DENSITY).mass * velocity.norm_squared();
    for resolve in [Resolve::Micro, Resolve::Lockstep] {
        let mut rig = Rig::resolved_by(resolve, Vector3::zeros(), 1e-6);
        let ball = rig.ball(Vector3::z() * (RADIUS + GAP), velocity);
        (0..4).for_each(|_| rig.step());
        let before = rig.wear.ledger();
        assert!(before.elastic > 1e-3 * energy, "{resolve:?}: {before:?}");
        take_away(&mut rig, ball);
        let after = rig.wear.ledger();
        assert!(after.elastic.abs() < 1e-12 * energy, "{resolve:?}: {after:?}");
        let lost = after.history - before.history;
        assert!((lost - before.elastic).abs() < 1e-12 * energy, "{resolve:?}: {lost:e} J");
    }
}

/// Fails for springs of Micro that go on storing energy once QuasiStatic has the ball.
#[test]
fn springs_of_a_ball_that_comes_to_rest_store_nothing() {
    let damped = plate_of(STRIP, 0.3);
    let mut rig = Rig::of(damped, [15e-3, 6e-3], Resolve::Auto, Vector3::zeros(), 1e-4);
    rig.world.gravity = scalar::to_vector(&(Vector3::z() * -9.81));
    let speed = 0.02;
    let ball = rig.ball(Vector3::z() * (RADIUS + GAP), Vector3::z() * -speed);
    let rests =
        |event: &WearEvent| matches!(event, WearEvent::Resolved { by: Resolver::QuasiStatic, .. });
    let mut stored = 0.0;
    for step in 0.. {
        stored = rig.wear.ledger().elastic;
        rig.step();
        if rig.wear.events().iter().any(rests) {
            break;
        }
        assert!(step < 1000, "it does not come to rest");
    }
    take_away(&mut rig, ball);
    assert!(stored > 0.0);
    assert!(rig.wear.ledger().elastic.abs() < 1e-9 * stored);
}

/// Fails for overhangs that stand on where a blade was taken away from under them, and for an event
/// that does not tell of them.
#[test]
fn overhangs_over_a_blade_that_is_taken_away_break_off() {
    let mut rig = Rig::new(Vector3::zeros(), 1e-6);
    let [long, thin] = [1.5e-3, 0.05e-3];
    // It flies along its own plane, edge first.
    let angle: f64 = 30.0;
    let (sin, cos) = angle.to_radians().sin_cos();
    let body = RigidBodyBuilder::dynamic()
        .translation(scalar::to_vector(&(Vector3::z() * (long * sin + thin * cos + GAP))))
        .rotation(scalar::to_vector(&(Vector3::y() * angle.to_radians())))
        .linvel(scalar::to_vector(&towards_plate(60.0, angle)));
    let [long, thin] = [long, thin].map(scalar::narrow);
    let blade = ColliderBuilder::cuboid(long, long, thin).density(scalar::narrow(1e4 * DENSITY));
    let (blade, _) = rig.world.insert(body, blade);
    while rig.wear[rig.plate].worn().displaced() < 1e-10 || !rig.wear.in_contact(blade) {
        rig.step();
    }
    let chip = |rig: &Rig| rig.wear[rig.plate].worn().chip;
    assert_eq!(chip(&rig), 0.0);
    take_away(&mut rig, blade);
    assert!(chip(&rig) > 0.0);
    let [WearEvent::Ended { volume, .. }] = rig.wear.events() else {
        panic!("{:?}", rig.wear.events())
    };
    let displaced = rig.wear[rig.plate].worn().displaced();
    assert!((volume / displaced - 1.0).abs() < 1e-9, "{volume:e} of {displaced:e}");
}

/// Fails for springs of a body that is no more, for an end that nobody is told of, and for the books of its
/// contact that go with its place.
#[test]
fn the_contact_of_a_body_that_is_removed_ends() {
    let mut rig = Rig::new(Vector3::zeros(), 1e-6);
    let velocity = towards_plate(35.0, 60.0);
    let ball = rig.ball(Vector3::z() * (RADIUS + GAP), velocity);
    while rig.wear[rig.plate].wear_volume() == 0.0 {
        rig.step();
    }
    let before = rig.wear.ledger();
    assert!(before.elastic > 0.0);
    rig.world.remove_body(ball);
    // It takes the place of the first.
    let other = rig.ball(Vector3::z() * (RADIUS + GAP), velocity);
    assert_eq!(other.into_raw_parts().0, ball.into_raw_parts().0);
    let first = rig.wear[rig.plate].wear_volume();
    while rig.wear[rig.plate].wear_volume() == first {
        rig.step();
        let after = rig.wear.ledger();
        assert!(after.wear >= before.wear && after.history >= before.elastic, "{after:?}");
    }
}

/// Fails for a body that is given a place among those of the last step, and is forgotten there with the
/// shape and the state that it was given.
#[test]
fn a_body_that_takes_the_place_of_another_is_carried_as_it_was_placed() {
    let velocity = towards_plate(35.0, 60.0);
    let worn = |follows: bool| {
        let mut rig = Rig::new(Vector3::zeros(), 1e-6);
        if follows {
            let ball = rig.ball(Vector3::z() * (RADIUS + GAP), -velocity);
            rig.step();
            rig.world.remove_body(ball);
        }
        rig.ball(Vector3::z() * (RADIUS + GAP), velocity);
        (0..400).for_each(|_| rig.step());
        rig.wear[rig.plate].wear_volume()
    };
    assert!(worn(false) > 0.0);
    assert_eq!(worn(true), worn(false));
}

/// Fails for an event that does not tell what a contact has worn in the step in which it failed.
#[test]
fn the_end_of_a_contact_that_fails_tells_what_it_wore() {
    let mut rig = Rig::limited(12, 1e-4);
    rig.ball(Vector3::z() * (RADIUS + GAP), towards_plate(35.0, 60.0));
    assert!(rig.wear.step(&mut rig.world, &(), &()).is_err(), "twelve steps are too few");
    rig.assert_that_failure_tells_wear();
}

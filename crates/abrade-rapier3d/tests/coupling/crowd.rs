//! Worlds of many bodies: who is looked at, who is seen although it was far, and what a removed
//! body leaves behind.

use super::rig::{GAP, RADIUS, Rig, body, towards_plate};
use crate::plugin::abrade::Until;
use crate::plugin::rapier::prelude::*;
use crate::plugin::{WearSettings, scalar};
use nalgebra::Vector3;

/// Fails for a plug-in that compares the colliders of bodies that cannot come near a surface.
#[test]
fn bodies_that_stay_away_are_looked_at_once() {
    for height in [0.1, 50.0] {
        let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
        for number in 0..100 {
            let at = |digit: i32| 0.02 * f64::from(number / digit % 10);
            rig.ball(Vector3::new(at(1), at(10), height), Vector3::x() * 0.01);
        }
        rig.step();
        assert_eq!(rig.wear.counters().looked, 100);
        for _ in 0..20 {
            rig.step();
        }
        assert_eq!(rig.wear.counters().looked, 100, "at {height} m");
    }
}

/// Fails for a cap of the speed at which bodies are looked for.
#[test]
fn a_fast_body_is_seen_from_afar() {
    let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
    rig.ball(Vector3::new(0.0, 0.0, 4.0), towards_plate(100.0, 90.0));
    for _ in 0..3 {
        rig.step();
    }
    assert!(rig.wear.counters().micro > 0 && rig.wear.counters().refused == 0);
    assert!(rig.wear[rig.plate].wear_volume() > 0.0);
}

/// Fails for an outline that is kept while the embedder gives the body another collider, whether
/// or not somebody else has taken Rapier's flags down since.
#[test]
fn a_body_that_grew_is_seen_in_the_same_step() {
    for flags_taken in [false, true] {
        let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
        let ball = rig.ball(Vector3::z(), towards_plate(1.0, 90.0) * 1e-3);
        for _ in 0..3 {
            rig.step();
        }
        let z = scalar::vector(rig.world.bodies[ball].translation()).z;
        let collider = rig.collider(ball);
        let grown = SharedShape::ball(scalar::narrow(z - 1e-6));
        rig.world.colliders[collider].set_shape(grown);
        if flags_taken {
            rig.world.detect_collisions(&(), &());
        }
        rig.step();
        let counters = rig.wear.counters();
        assert_eq!(counters.micro + counters.refused, 1, "flags taken down: {flags_taken}");
    }
}

/// Fails for a force that is given after the body was looked at, and forgotten.
#[test]
fn a_body_that_is_pushed_is_seen_in_the_same_step() {
    let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
    let ball = rig.ball(Vector3::z() * 0.1, Vector3::zeros());
    for _ in 0..3 {
        rig.step();
    }
    let mass = scalar::wide(rig.world.bodies[ball].mass());
    let push = scalar::to_vector(&(Vector3::z() * -2000.0 * mass));
    rig.world.bodies[ball].add_force(push, true);
    rig.step();
    assert_eq!((rig.wear.counters().micro, rig.wear.counters().refused), (1, 0));
}

/// Fails for an encounter that lives on because its body is too far away to be looked at.
#[test]
fn a_body_that_is_taken_away_ends_its_encounter() {
    let mut rig = Rig::new(Vector3::zeros(), 1e-6);
    let ball = rig.ball(Vector3::z() * (RADIUS + GAP), towards_plate(35.0, 90.0));
    for _ in 0..3 {
        rig.step();
    }
    assert!(rig.wear.in_contact(ball));
    let away = scalar::to_vector(&(Vector3::z() * 1e3));
    rig.world.bodies[ball].set_translation(away, true);
    rig.step();
    assert!(!rig.wear.in_encounter(ball));
    let looked = rig.wear.counters().looked;
    rig.step();
    rig.step();
    assert!(rig.wear.counters().looked <= looked + 1);
}

/// Fails for a count of registered bodies that holds removed ones.
#[test]
fn the_only_registered_body_left_ends_the_step_at_its_exit() {
    let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
    rig.wear = crate::plugin::WearWorld::new(WearSettings {
        until: Until::FirstExit,
        ..WearSettings::default()
    });
    let surface = super::rig::surface();
    rig.plate = rig.wear.insert_on_top(surface, rig.proxy, &mut rig.world.colliders).expect("one");
    let v = towards_plate(35.0, 90.0);
    let [gone, left] = [0.1, 0.2].map(|z| rig.ball(Vector3::z() * z, v));
    for ball in [gone, left] {
        let (bodies, colliders) = (&mut rig.world.bodies, &rig.world.colliders);
        rig.wear.place_on(rig.plate, ball, body(v), bodies, colliders).expect("a body");
    }
    rig.world.remove_body(gone);
    let report = rig.wear.step(&mut rig.world, &(), &()).expect("an impact");
    assert_eq!(report.exited, Some(left));
}

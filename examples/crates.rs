//! A stack of crates on soft ground, and a heavy ball that falls on it, at 1/60 s.
//!
//! What to see: the stack stands and wears nothing, resolved by QuasiStatic. The blow goes through
//! all crates into the ground: the island is resolved in Lockstep. Rapier's contacts do not
//! rebound, so that m / (m + M) of the ball's energy is left to the ground, which takes it as H W.
//!
//! `cargo run --release --example crates`

use abrade::{HexStrip, Material, Surface, SurfaceLaws};
use abrade_rapier3d::rapier::prelude::*;
use abrade_rapier3d::{WearEvent, WearSettings, WearWorld};

const HARDNESS: f64 = 2e6;
const CRATES: usize = 3;
const SPEED: f32 = 6.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = PhysicsWorld { gravity: Vector::Z * -9.81, ..PhysicsWorld::default() };
    world.integration_parameters.length_unit = 0.1;
    world.integration_parameters.normalized_max_linear_velocity = f32::MAX;
    let proxy = ColliderBuilder::cuboid(0.3, 0.3, 0.1).translation(Vector::Z * -0.1);
    let proxy = world.colliders.insert(proxy.friction(0.5));
    let mut wear = WearWorld::new(WearSettings::default());
    let ground = wear.insert_on_top(soft_ground()?, proxy, &mut world.colliders)?;
    for i in 0..CRATES {
        let body = RigidBodyBuilder::dynamic().translation(Vector::Z * (0.1 + 0.2 * i as f32));
        world.insert(body, ColliderBuilder::cuboid(0.1, 0.1, 0.1).density(300.0).friction(0.5));
    }
    for _ in 0..30 {
        wear.step(&mut world, &(), &())?;
    }
    println!("standing: {:.3} mm3 worn", 1e9 * wear[ground].wear_volume());
    assert_eq!(wear[ground].wear_volume(), 0.0, "a stack at rest wears nothing");

    let top = 0.2 * CRATES as f32;
    let ball = RigidBodyBuilder::dynamic()
        .translation(Vector::new(0.02, 0.0, top + 0.25))
        .linvel(Vector::Z * -SPEED);
    let (ball, _) = world.insert(ball, ColliderBuilder::ball(0.08).density(7800.0).friction(0.5));
    let mass = world.bodies[ball].mass();
    for step in 0..30 {
        wear.step(&mut world, &(), &())?;
        for event in wear.events() {
            if let WearEvent::Resolved { body, by, .. } = event {
                println!("step {step:2}: body {} by {by:?}", body.into_raw_parts().0);
            }
        }
    }
    let worn = wear[ground].wear_volume();
    let energy = f64::from(mass * (0.5 * SPEED * SPEED + 9.81 * 0.17));
    let paid = HARDNESS * worn / energy;
    println!("struck by {mass:.1} kg at {SPEED} m/s: {:.0} mm3 worn", 1e9 * worn);
    let left = f64::from(mass / (mass + 2.4 * CRATES as f32));
    println!("H W is {paid:.3} of the ball's energy; m / (m + M) is {left:.3}");
    assert!(wear.counters().lockstep > 0, "the blow goes to Lockstep");
    assert!((paid / left - 1.0).abs() < 0.1, "the ground takes what the blow leaves");
    Ok(())
}

fn soft_ground() -> Result<Surface, abrade::SurfaceError> {
    let (hardness, young) = (HARDNESS, Some(500e6));
    let material = Material { hardness, shear_ratio: 0.25, young, poisson: 0.3, friction: 0.5 };
    let strip = HexStrip { length: 0.6, width: 0.6, pitch: 10e-3, rest_area: None };
    Surface::hex_strip(strip, SurfaceLaws::of(material))
}

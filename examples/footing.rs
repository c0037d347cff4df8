//! Rays and characters on worn ground: query colliders beside the proxy show what has worn.
//!
//! What to see: before the blow a ray and a foot, a ball that is cast down, find the ground at
//! height 0; after it they find the bottom of the crater. A character controller casts its shape
//! in the same way.
//!
//! `cargo run --release --example footing`

use abrade::{HexStrip, Material, Surface, SurfaceLaws};
use abrade_rapier3d::rapier::parry::query::ShapeCastOptions;
use abrade_rapier3d::rapier::parry::shape::Ball;
use abrade_rapier3d::rapier::prelude::*;
use abrade_rapier3d::{WearSettings, WearWorld};

const FOOT: f32 = 0.02;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = PhysicsWorld { gravity: Vector::Z * -9.81, ..PhysicsWorld::default() };
    let proxy = ColliderBuilder::cuboid(0.2, 0.2, 0.1).translation(Vector::Z * -0.1);
    let proxy = world.colliders.insert(proxy);
    let mut wear = WearWorld::new(WearSettings::default());
    let ground = wear.insert_on_top(soft_ground()?, proxy, &mut world.colliders)?;

    // Before the step that should take the change in; the first time, every tile is made.
    let tiles = wear.sync_colliders(ground, &mut world.colliders)?;
    wear.step(&mut world, &(), &())?;
    let before = heights(&world, proxy);
    println!("before: ray {:.2} mm, ball {:.2} mm", before[0], before[1]);

    let stone = RigidBodyBuilder::dynamic().translation(Vector::Z * 0.2).linvel(Vector::Z * -8.0);
    let (stone, _) = world.insert(stone, ColliderBuilder::ball(0.05).density(2500.0));
    (0..10).try_for_each(|_| wear.step(&mut world, &(), &()).map(|_| ()))?;
    world.remove_body(stone);
    let made = wear.sync_colliders(ground, &mut world.colliders)?;
    println!("{made} of {tiles} tiles made anew");
    wear.step(&mut world, &(), &())?;
    let after = heights(&world, proxy);
    println!("after:  ray {:.2} mm, ball {:.2} mm", after[0], after[1]);
    let deepest = 1e3 * wear[ground].worn().max_depth as f32;
    println!("deepest node: {deepest:.2} mm");
    assert!(before.iter().all(|height| height.abs() < 0.05), "fresh ground lies at 0");
    let at_bottom = |height: &f32| (height + deepest).abs() < 0.02 * deepest;
    assert!(after.iter().all(at_bottom), "both find the bottom of the crater");
    Ok(())
}

/// Height of the ground in the middle as a ray and a ball find it [mm].
fn heights(world: &PhysicsWorld, proxy: ColliderHandle) -> [f32; 2] {
    // The proxy keeps its undeformed top.
    let filter = QueryFilter::default().exclude_collider(proxy);
    let (high, foot) = (Vector::new(1e-4, 2e-4, 0.05), Ball::new(FOOT));
    let ray = world.cast_ray(&Ray::new(high, -Vector::Z), 1.0, true, filter);
    let options = ShapeCastOptions::with_max_time_of_impact(1.0);
    let ball = world.cast_shape(&Pose::from_translation(high), -Vector::Z, &foot, options, filter);
    let none = f32::NAN;
    let ray = ray.map_or(none, |(_, way)| high.z - way);
    let ball = ball.map_or(none, |(_, hit)| high.z - hit.time_of_impact - FOOT);
    [ray, ball].map(|height| 1e3 * height)
}

fn soft_ground() -> Result<Surface, abrade::SurfaceError> {
    let (hardness, young) = (2e6, Some(500e6));
    let material = Material { hardness, shear_ratio: 0.25, young, poisson: 0.3, friction: 0.5 };
    let strip = HexStrip { length: 0.4, width: 0.4, pitch: 1e-3, rest_area: None };
    Surface::hex_strip(strip, SurfaceLaws::of(material))
}

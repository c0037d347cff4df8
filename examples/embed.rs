//! The least that an embedder writes: a plate that wears in a Rapier world, and a ball that
//! strikes it. README quotes the lines between the braces of `main`.
//!
//! What to see: the volume of one crater.
//!
//! `cargo run --release --example embed`

use abrade::{HexStrip, Material, Surface, SurfaceLaws};
use abrade_rapier3d::rapier::prelude::*;
use abrade_rapier3d::{WearSettings, WearWorld};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
    // What Rapier sees of the plate, its top at z = 0, and the surface that wears on it.
    let proxy = ColliderBuilder::cuboid(0.03, 0.02, 0.01).translation(Vector::new(0.0, 0.0, -0.01));
    let proxy = world.colliders.insert(proxy);
    let mut wear = WearWorld::new(WearSettings::default());
    let plate = wear.insert_on_top(soft_steel()?, proxy, &mut world.colliders)?;
    // Every dynamic body of balls, cuboids or convex hulls wears it.
    let body = RigidBodyBuilder::dynamic()
        .translation(Vector::new(-0.1, 0.0, 0.1))
        .linvel(Vector::new(25.0, 0.0, -25.0));
    world.insert(body, ColliderBuilder::ball(0.003).density(2500.0));
    for _ in 0..60 {
        wear.step(&mut world, &(), &())?; // in the place of world.step()
    }
    println!("worn: {:.4} mm3", 1e9 * wear[plate].wear_volume());
    Ok(())
}

fn soft_steel() -> Result<Surface, abrade::SurfaceError> {
    let laws = SurfaceLaws::of(Material {
        hardness: 1.7e9,
        shear_ratio: 0.25,
        young: Some(200e9),
        poisson: 0.3,
        friction: 0.3,
    });
    Surface::hex_strip(HexStrip { length: 0.06, width: 0.04, pitch: 0.1e-3, rest_area: None }, laws)
}

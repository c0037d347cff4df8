//! Saving a world in the middle of an impact and going on from the bytes: the feature
//! `serde-serialize` of the plug-in, which turns Rapier's own on. Any binary format of serde will
//! do; this is postcard.
//!
//! What to see: both runs end with the same bits.
//!
//! `cargo run --release --example snapshot`

use abrade::{HexStrip, Material, Surface, SurfaceLaws};
use abrade_rapier3d::rapier::prelude::*;
use abrade_rapier3d::{SurfaceId, WearError, WearSettings, WearWorld};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
    world.integration_parameters.dt = 1e-6;
    let proxy = ColliderBuilder::cuboid(0.01, 0.01, 0.01).translation(Vector::new(0.0, 0.0, -0.01));
    let proxy = world.colliders.insert(proxy);
    let mut wear = WearWorld::new(WearSettings::default());
    let plate = wear.insert_on_top(soft_steel()?, proxy, &mut world.colliders)?;
    let ball = RigidBodyBuilder::dynamic()
        .translation(Vector::new(0.0, 0.0, 0.00301))
        .linvel(Vector::new(20.0, 0.0, -30.0));
    let (ball, _) = world.insert(ball, ColliderBuilder::ball(0.003).density(7800.0));
    go(&mut world, &mut wear, 4)?;
    assert!(wear.in_contact(ball));

    // Between two steps: Rapier's world, the wear beside it, and the embedder's own names.
    let bytes = postcard::to_stdvec(&(&world, &wear, plate))?;
    println!("{} bytes", bytes.len());
    let (mut read_world, mut read_wear, read_plate): (PhysicsWorld, WearWorld, SurfaceId) =
        postcard::from_bytes(&bytes)?;

    go(&mut world, &mut wear, 40)?;
    go(&mut read_world, &mut read_wear, 40)?;
    let [here, there] = [&wear[plate], &read_wear[read_plate]];
    println!("worn: {:.6e} and {:.6e} mm3", 1e9 * here.wear_volume(), 1e9 * there.wear_volume());
    assert!(here.nodes().depth == there.nodes().depth);
    assert_eq!(wear.state(ball, &world.bodies), read_wear.state(ball, &read_world.bodies));
    Ok(())
}

fn go(world: &mut PhysicsWorld, wear: &mut WearWorld, steps: u32) -> Result<(), WearError> {
    (0..steps).try_for_each(|_| wear.step(world, &(), &()).map(drop))
}

fn soft_steel() -> Result<Surface, abrade::SurfaceError> {
    let laws = SurfaceLaws::of(Material {
        hardness: 1.7e9,
        shear_ratio: 0.25,
        young: Some(200e9),
        poisson: 0.3,
        friction: 0.3,
    });
    Surface::hex_strip(HexStrip { length: 0.02, width: 0.02, pitch: 0.1e-3, rest_area: None }, laws)
}

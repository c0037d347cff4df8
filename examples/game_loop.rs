//! A game's loop: it goes on after an error, tells what happened, and shows worn ground to a ray.
//!
//! What to see: a ball strikes and rebounds, a box that lies on the plate is pushed along it, and
//! the ray finds the bottom of the crater.
//!
//! `cargo run --release --example game_loop`

use abrade::{HexStrip, Material, Surface, SurfaceLaws};
use abrade_rapier3d::rapier::prelude::*;
use abrade_rapier3d::{WearEvent, WearSettings, WearWorld};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = PhysicsWorld { gravity: Vector::Z * -9.81, ..PhysicsWorld::default() };
    world.integration_parameters.length_unit = 0.01;
    let proxy = ColliderBuilder::cuboid(0.03, 0.02, 0.01).translation(Vector::new(0.0, 0.0, -0.01));
    let proxy = world.colliders.insert(proxy);
    // Quick rather than exact, and no contact may take for ever.
    let settings = WearSettings { accuracy: 1e-2, step_limit: 100_000, ..WearSettings::default() };
    let mut wear = WearWorld::new(settings);
    let plate = wear.insert_on_top(soft_ground()?, proxy, &mut world.colliders)?;
    let ball = RigidBodyBuilder::dynamic()
        .translation(Vector::Z * 0.05)
        .linvel(Vector::new(1.0, 0.0, -3.0));
    world.insert(ball, ColliderBuilder::ball(0.005).density(7800.0));
    let lying = RigidBodyBuilder::dynamic().translation(Vector::new(-0.02, 0.0, 0.005));
    let (lying, _) =
        world.insert(lying, ColliderBuilder::cuboid(0.005, 0.005, 0.005).density(7800.0));
    for step in 0..60 {
        world.bodies[lying].reset_forces(true);
        let push = if step < 6 { 0.04 } else { 0.0 };
        world.bodies[lying].add_force(Vector::X * push, true);
        wear.sync_colliders(plate, &mut world.colliders)?;
        if let Err(error) = wear.step(&mut world, &(), &()) {
            // The step was taken, with that body left to Rapier.
            println!("step {step}: {error}");
        }
        for event in wear.events() {
            match event {
                WearEvent::Started { .. } => println!("step {step:2}: a contact begins"),
                WearEvent::Ended { volume, impulse, contact_time, .. } => println!(
                    "step {step:2}: it ends after {:.0} us, {:.4} N s, {:.3} mm3 displaced",
                    1e6 * contact_time,
                    impulse.norm(),
                    1e9 * volume
                ),
                WearEvent::Resolved { by, .. } => println!("step {step:2}: now by {by:?}"),
                WearEvent::NoIsland { reason, .. } => println!("step {step:2}: {reason}"),
                WearEvent::NotResolved { reason, .. } => println!("step {step:2}: {reason}"),
                WearEvent::Failed { error, .. } => println!("step {step:2}: {error}"),
                WearEvent::Renewed { .. } | WearEvent::NotRenewed { .. } => {} // of solids
            }
        }
    }

    let nodes = wear[plate].nodes();
    let deepest = (0..nodes.len()).max_by(|&a, &b| nodes.depth[a].total_cmp(&nodes.depth[b]));
    let deepest = deepest.ok_or("a plate has nodes")?;
    // A surface's frame is nalgebra's, in f64; Rapier's vectors are glam's.
    let at = wear.frame(plate, &world.colliders)? * nodes.position(deepest);
    // Beside the node: a ray through a corner of triangles may pass between them.
    let ray = Ray::new(Vector::new(at.x as f32 + 1e-5, at.y as f32, 0.02), -Vector::Z);
    let hit = world.cast_ray(&ray, 1.0, true, WearWorld::WORN_ONLY.into());
    let (_, way) = hit.ok_or("no ground")?;
    println!("deepest node {:.1} um down, the ray {:.1} um", -1e6 * at.z, 1e6 * (way - 0.02));
    println!("the box was pushed to x = {:.4} m", world.bodies[lying].translation().x);
    assert!((way - 0.02 + at.z as f32).abs() < 2e-6, "the ray meets the deepest node");
    Ok(())
}

fn soft_ground() -> Result<Surface, abrade::SurfaceError> {
    let material = Material {
        hardness: 50e6,
        shear_ratio: 0.25,
        young: Some(2.5e9),
        poisson: 0.3,
        friction: 0.3,
    };
    let laws = SurfaceLaws { restitution: 0.4, ..SurfaceLaws::of(material) };
    Surface::hex_strip(HexStrip { length: 0.06, width: 0.04, pitch: 0.2e-3, rest_area: None }, laws)
}

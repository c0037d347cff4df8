//! A wear plate in a Rapier world at game steps, in f32: a ball is dropped and another fired.
//!
//! What to see: the first bounces and hardly leaves a mark, the second digs a crater whose
//! volume is close to m v^2 / 2 H (Capozza & Hanley 2022, Eq. 16), whatever the step.
//!
//! `cargo run --release --example wear_plate`

use abrade::{HexStrip, Material, Surface, SurfaceLaws};
use abrade_rapier3d::rapier::prelude::*;
use abrade_rapier3d::{WearEvent, WearSettings, WearWorld};

const HARDNESS: f64 = 1.7e9;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world =
        PhysicsWorld { gravity: Vector::new(0.0, 0.0, -9.81), ..PhysicsWorld::default() };
    world.integration_parameters.dt = 1.0 / 60.0;

    // The plate that Rapier sees, 2 cm thick, its top at z = 0, and the surface that wears on it.
    let plate = ColliderBuilder::cuboid(0.03, 0.02, 0.01).translation(Vector::new(0.0, 0.0, -0.01));
    let plate = world.colliders.insert(plate);
    let mut wear = WearWorld::new(WearSettings::default());
    let plate = wear.insert_on_top(soft_steel()?, plate, &mut world.colliders)?;

    let ball = |x: f32, z: f32, speed: f32| {
        let body = RigidBodyBuilder::dynamic()
            .translation(Vector::new(x, 0.0, z))
            .linvel(Vector::new(0.0, 0.0, -speed));
        (body, ColliderBuilder::ball(0.003).density(2500.0))
    };
    for (x, z, speed) in [(-0.015, 0.0031, 0.0), (0.015, 0.5, 35.0)] {
        let (body, collider) = ball(x, z, speed);
        world.insert(body, collider);
    }

    for step in 0..12 {
        wear.step(&mut world, &(), &())?;
        for event in wear.events() {
            if let WearEvent::Ended { body, impulse, volume, .. } = event {
                let mass = world.bodies[*body].mass();
                println!(
                    "step {step:2}: {:.2} g, impulse {:.2e} N s, crater {:.4} mm3",
                    1e3 * mass,
                    impulse.norm(),
                    1e9 * volume
                );
            }
        }
    }
    let mass = 4.0 / 3.0 * std::f64::consts::PI * 3e-3_f64.powi(3) * 2500.0;
    let deepest = wear[plate].nodes().depth.iter().fold(0.0, |a: f64, b| a.max(*b));
    println!("worn: {:.4} mm3", 1e9 * wear[plate].wear_volume());
    println!("m v^2 / 2 H: {:.4} mm3", 1e9 * mass * 35.0 * 35.0 / (2.0 * HARDNESS));
    println!("deepest node: {:.1} um", 1e6 * deepest);
    Ok(())
}

fn soft_steel() -> Result<Surface, abrade::SurfaceError> {
    let material = Material {
        hardness: HARDNESS,
        shear_ratio: Material::default_shear_ratio(),
        young: Some(200e9),
        poisson: Material::default_poisson(),
        friction: 0.3,
    };
    let laws = SurfaceLaws::of(material);
    Surface::hex_strip(HexStrip { length: 0.06, width: 0.04, pitch: 0.1e-3, rest_area: None }, laws)
}

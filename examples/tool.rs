//! A tip that a robot draws through a plate along a wave, at 1/240 s: a kinematic body that was made a
//! tool.
//!
//! What to see: the tip goes where it is led, whatever the plate does to it. The groove is its section
//! along the way; the force is read after every step, against the way and off the plate.
//!
//! `cargo run --release --example tool`

use abrade::{HexStrip, Material, Surface, SurfaceLaws};
use abrade_rapier3d::rapier::prelude::*;
use abrade_rapier3d::{WearSettings, WearWorld};

const RADIUS: f32 = 0.003;
const DEPTH: f32 = 0.3e-3;
const DT: f32 = 1.0 / 240.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = PhysicsWorld::default();
    world.integration_parameters.dt = DT;
    let proxy = ColliderBuilder::cuboid(0.03, 0.01, 0.01).translation(Vector::Z * -0.01);
    let proxy = world.colliders.insert(proxy);
    let mut wear = WearWorld::new(WearSettings::default());
    let plate = wear.insert_on_top(soft_plate()?, proxy, &mut world.colliders)?;

    let tip = RigidBodyBuilder::kinematic_position_based().translation(place(0.0));
    let (tip, _) = world.insert(tip, ColliderBuilder::ball(RADIUS));
    wear.add_tool(tip, &world.bodies)?;
    let (mut way, mut work) = (0.0, 0.0);
    for step in 1..=288 {
        let from = world.bodies[tip].translation();
        world.bodies[tip].set_next_kinematic_translation(place(step as f32 * DT));
        wear.step(&mut world, &(), &())?;
        let load = wear.tool_load(tip).unwrap_or_default();
        // On the tip, in the world: what the robot has to hold.
        let force = load.force();
        let moved = (world.bodies[tip].translation() - from).as_dvec3();
        let along = -(force.x * moved.x + force.y * moved.y + force.z * moved.z);
        work += along;
        if load.contact_time > 0.0 && moved.z.abs() < 1e-6 {
            way += moved.length();
            if step % 24 == 0 {
                let (cutting, lifting) = (along / moved.length(), force.z);
                let x = 1e3 * world.bodies[tip].translation().x;
                println!("x {x:+5.1} mm: {cutting:4.0} N against the way, {lifting:4.0} N off it");
                assert!(cutting > 0.0 && lifting > 0.0, "the plate holds it back and lifts it");
            }
        }
    }
    let half = f64::from((1.0 - DEPTH / RADIUS).acos());
    let section = f64::from(RADIUS).powi(2) * (half - half.sin() * half.cos());
    let worn = wear[plate].wear_volume();
    println!("worn {:.2} mm3 over {:.1} mm, for {work:.2} J", 1e9 * worn, 1e3 * way);
    println!("section times way: {:.2} mm3", 1e9 * section * way);
    assert!((0.95..1.1).contains(&(worn / (section * way))), "the groove is the tip's section");
    Ok(())
}

/// Centre of the tip at a time: down, along a wave for a second, and up.
fn place(time: f32) -> Vector {
    let along = (time - 0.1).clamp(0.0, 1.0);
    let above = (0.1 - time).max(time - 1.1).max(0.0) * 0.02;
    Vector::new(0.04 * along - 0.02, 0.003 * (9.0 * along).sin(), RADIUS - DEPTH + above)
}

fn soft_plate() -> Result<Surface, abrade::SurfaceError> {
    let (hardness, young) = (2e8, Some(1e10));
    let material = Material { hardness, shear_ratio: 0.25, young, poisson: 0.3, friction: 0.3 };
    let strip = HexStrip { length: 0.06, width: 0.02, pitch: 0.2e-3, rest_area: None };
    Surface::hex_strip(strip, SurfaceLaws::of(material))
}

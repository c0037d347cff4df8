//! A cube that is thrown on a floor until it is a pebble. Its surface is renewed between the blows,
//! and its body weighs what is left of it.
//!
//! What to see: the volume falls, the sphericity rises, and the mesh has lost what its nodes were
//! charged with. Into a folder it writes the pebble, its curve and what it weighs, which
//! docs/pebble.py compares with another program.
//!
//! `cargo run --release --example tumble [THROWS [FOLDER]]`

mod pebble;

use abrade::{Material, Surface, SurfaceLaws, TriangleMesh};
use abrade_rapier3d::rapier::prelude::*;
use abrade_rapier3d::{WearEvent, WearSettings, WearWorld};
use nalgebra::Vector3;

const EDGE: f64 = 0.02;
const DENSITY: f32 = 2000.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let throws: u32 = std::env::args().nth(1).map_or(Ok(100), |text| text.parse())?;
    let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
    world.integration_parameters.length_unit = EDGE as f32;
    world.colliders.insert(ColliderBuilder::cuboid(1.0, 1.0, 0.1).translation(Vector::Z * -0.1));
    let half = 0.5 * EDGE as f32;
    let proxy = ColliderBuilder::cuboid(half, half, half).density(DENSITY);
    let (cube, proxy) = world.insert(RigidBodyBuilder::dynamic().translation(Vector::Z), proxy);
    let mesh = TriangleMesh::cuboid(Vector3::repeat(0.5 * EDGE), EDGE / 16.0)?;
    let mut wear = WearWorld::new(WearSettings::default());
    let id = wear.insert(Surface::mesh(&mesh, laws())?, proxy, &mut world.colliders)?;

    let (mut numbers, mut curve) = (pebble::Numbers(7), vec![pebble::Point::of(&wear[id], 0)?]);
    let (mut throw, mut impacts) = (0, 0);
    loop {
        throw += 1;
        pebble::aim(&mut numbers, &wear[id], &mut world.bodies[cube]);
        let mut is_renewed = false;
        for _ in 0..6 {
            wear.step(&mut world, &(), &())?;
            for event in wear.events() {
                impacts += u32::from(matches!(event, WearEvent::Ended { .. }));
                is_renewed |= matches!(event, WearEvent::Renewed { .. });
            }
        }
        if is_renewed {
            curve.push(pebble::Point::of(&wear[id], throw)?);
        }
        // The body weighs what the mesh holds when the surface has just been renewed.
        if is_renewed && throw >= throws {
            break;
        }
    }
    let (first, last) = (&curve[0], &curve[curve.len() - 1]);
    let miss = curve[1..].iter().map(|point| point.miss(first)).fold(0.0, f64::max);
    println!("{throw} throws, {impacts} impacts, {} renewals", wear[id].renewals());
    println!("volume {:.4} of the cube's", last.volume / first.volume);
    println!("sphericity {:.4}, at first {:.4}", last.sphericity, first.sphericity);
    println!("lost and charged volume differ by at most {miss:.1e}");
    assert!(curve.windows(2).all(|pair| pair[1].volume < pair[0].volume), "wear is for good");
    assert!(miss < 1e-3, "what is lost was charged");
    match std::env::args().nth(2) {
        Some(folder) => pebble::write(folder.as_ref(), &wear[id], &world.bodies[cube], &curve),
        None => Ok(()),
    }
}

fn laws() -> SurfaceLaws {
    let (hardness, young) = (1e7, Some(2e8));
    let material = Material { hardness, shear_ratio: 0.25, young, poisson: 0.3, friction: 0.3 };
    SurfaceLaws::of(material)
}

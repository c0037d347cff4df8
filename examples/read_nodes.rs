//! Reading the nodes of a worn plate for rendering: positions in the world, and a depth for the
//! colour of each.
//!
//! What to see: a plan view of the crater of one impact, a digit per cell, 9 the deepest.
//!
//! `cargo run --release --example read_nodes`

use abrade::{HexStrip, Material, Surface, SurfaceLaws};
use abrade_rapier3d::rapier::prelude::*;
use abrade_rapier3d::{WearSettings, WearWorld};

const CELLS: usize = 24;
const VIEW: f64 = 2.4e-3;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
    let proxy = ColliderBuilder::cuboid(0.01, 0.01, 0.01).translation(Vector::new(5.0, 1.0, 0.0));
    let proxy = world.colliders.insert(proxy);
    let mut wear = WearWorld::new(WearSettings::default());
    let plate = wear.insert_on_top(plate()?, proxy, &mut world.colliders)?;

    let ball = RigidBodyBuilder::dynamic()
        .translation(Vector::new(5.0, 1.0, 0.05))
        .linvel(Vector::new(0.0, 0.0, -40.0));
    world.insert(ball, ColliderBuilder::ball(0.003).density(7800.0));
    wear.step(&mut world, &(), &())?;

    // Columns of the nodes: borrowed, nothing is copied. The frame takes them into the world.
    let nodes = wear[plate].nodes();
    let frame = wear.frame(plate, &world.colliders)?;
    let middle = frame.translation.vector;
    let mut cells = [[0.0_f64; CELLS]; CELLS];
    let (mut low, mut lowest) = (f64::INFINITY, 0);
    for i in 0..nodes.len() {
        let position_world = frame * nodes.position(i);
        if position_world.z < low {
            (low, lowest) = (position_world.z, i);
        }
        let [x, y] = [0, 1].map(|a| (position_world[a] - middle[a]) / VIEW + 0.5);
        if (0.0..1.0).contains(&x) && (0.0..1.0).contains(&y) {
            let [column, row] = [x, y].map(|s| (s * CELLS as f64) as usize);
            cells[row][column] = cells[row][column].max(nodes.depth[i]);
        }
    }
    let deepest = nodes.depth[lowest];
    for row in cells {
        let digit = |depth: f64| match (9.99 * depth / deepest) as u32 {
            0 => '.',
            digit => char::from_digit(digit, 10).unwrap_or('?'),
        };
        println!("{}", row.map(digit).iter().collect::<String>());
    }
    println!(
        "{} nodes, the lowest at {:?}, {:.1} um deep",
        nodes.len(),
        frame * nodes.position(lowest),
        1e6 * deepest
    );
    Ok(())
}

fn plate() -> Result<Surface, abrade::SurfaceError> {
    let material = Material {
        hardness: 1.7e9,
        shear_ratio: 0.25,
        young: Some(200e9),
        poisson: 0.3,
        friction: 0.3,
    };
    let laws = SurfaceLaws::of(material);
    Surface::hex_strip(HexStrip { length: 0.02, width: 0.02, pitch: 0.1e-3, rest_area: None }, laws)
}

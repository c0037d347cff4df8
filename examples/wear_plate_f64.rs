//! The same plug-in in f64, with a body registered by its exact state and the energy ledger on.
//!
//! What to see: the energies of an oblique impact (Capozza & Hanley 2022, Figs. 12 and 13) close
//! to within the numerical bucket, and the same wear at 1/60 s and at 1e-4 s.
//!
//! `cargo run --release --example wear_plate_f64`

use abrade::{Body, HexStrip, Inertia, Material, Shape, State, Surface, SurfaceLaws};
use abrade_rapier3d_f64::rapier::prelude::*;
use abrade_rapier3d_f64::{WearSettings, WearWorld};
use nalgebra::{Point3, Vector3};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for dt in [1.0 / 60.0, 1e-4] {
        let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
        world.integration_parameters.dt = dt;
        let plate = ColliderBuilder::cuboid(0.01, 0.01, 0.01);
        let plate = world.colliders.insert(plate);
        let mut wear = WearWorld::new(WearSettings { ledger: true, ..WearSettings::default() });
        let plate = wear.insert_on_top(hard_steel()?, plate, &mut world.colliders)?;

        let (ball, _) = world.insert(RigidBodyBuilder::dynamic(), ColliderBuilder::ball(3e-3));
        let start = State {
            velocity: Vector3::new(35.0, 0.0, -35.0) / 2f64.sqrt(),
            ..State::at(Point3::new(0.0, 0.0, 3e-3 + 1e-6))
        };
        let body = Body {
            shape: Shape::ball(3e-3)?,
            inertia: Inertia::of_ball(3e-3, 2500.0),
            state: start,
            rotation_locked: false,
        };
        let before = body.inertia.kinetic_energy(&start);
        wear.place_on(plate, ball, body, &mut world.bodies, &world.colliders)?;
        (0..(1e-3 / dt).ceil() as u32)
            .try_for_each(|_| wear.step(&mut world, &(), &()).map(|_| ()))?;

        let state = wear.state(ball, &world.bodies).ok_or("the ball is gone")?;
        let energy = wear.ledger();
        println!("dt {dt:.1e} s: {:.6e} m3", wear[plate].wear_volume());
        println!("  rebound {:.4} m/s, spin {:.1} rad/s", state.velocity.norm(), state.spin.norm());
        for (name, joules) in [
            ("kinetic", before + energy.kinetic_change),
            ("wear", energy.wear),
            ("friction", energy.friction),
            ("numerical", energy.numerical()),
        ] {
            println!("  {name:9} {:+.3e} of the energy before", joules / before);
        }
    }
    Ok(())
}

fn hard_steel() -> Result<Surface, abrade::SurfaceError> {
    let material = Material {
        hardness: 6.6e9,
        shear_ratio: 0.25,
        young: Some(200e9),
        poisson: 0.3,
        friction: 0.5,
    };
    let laws = SurfaceLaws::of(material);
    Surface::hex_strip(HexStrip { length: 0.02, width: 0.02, pitch: 0.1e-3, rest_area: None }, laws)
}

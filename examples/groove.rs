//! A skid that a motor drags over soft ground and back, at 1/60 s.
//!
//! What to see: the first pass bears on the front half of the foot, pi a^2 / 2 = F / H, and leaves
//! a groove of about 2/3 L a^3 / R, plus what friction adds. The way back bears on the width of the
//! groove as well, and sinks by less.
//!
//! `cargo run --release --example groove`

use abrade::{HexStrip, Material, Surface, SurfaceLaws};
use abrade_rapier3d::rapier::prelude::*;
use abrade_rapier3d::{WearSettings, WearWorld};
use std::f64::consts::PI;

const HARDNESS: f64 = 2e6;
const RADIUS: f32 = 0.03;
const MASS: f32 = 10.0;
const SPEED: f32 = 0.2;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = PhysicsWorld { gravity: Vector::Z * -9.81, ..PhysicsWorld::default() };
    world.integration_parameters.length_unit = 0.05;
    // With fewer, the motor does not push against all of the friction.
    world.integration_parameters.num_solver_iterations = 16;
    let proxy = ColliderBuilder::cuboid(0.3, 0.05, 0.05).translation(Vector::Z * -0.05);
    let proxy = world.colliders.insert(proxy);
    let mut wear = WearWorld::new(WearSettings::default());
    let ground = wear.insert_on_top(soft_ground()?, proxy, &mut world.colliders)?;

    let at = Vector::new(-0.2, 0.0, RADIUS);
    let base = world.insert_body(RigidBodyBuilder::fixed().translation(at));
    let load = MassProperties::new(Vector::ZERO, MASS, Vector::splat(0.1));
    let skid = RigidBodyBuilder::dynamic().translation(at).additional_mass_properties(load);
    let (skid, _) = world.insert(skid, ColliderBuilder::ball(RADIUS).density(0.0));
    // It keeps its direction and its line, and finds its own height.
    let held = JointAxesMask::ANG_AXES | JointAxesMask::LIN_Y;
    let motor = |speed| GenericJointBuilder::new(held).motor_velocity(JointAxis::LinX, speed, 1e6);
    let joint = world.insert_impulse_joint(base, skid, motor(SPEED));

    let (mut worn, mut ways, mut depths) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    for pass in 0..2 {
        let (from, before) = (world.bodies[skid].translation(), wear[ground].wear_volume());
        for _ in 0..120 {
            wear.step(&mut world, &(), &())?;
        }
        ways[pass] = f64::from((world.bodies[skid].translation() - from).x);
        worn[pass] = wear[ground].wear_volume() - before;
        depths[pass] = 1e3 * wear[ground].worn().max_depth;
        let (way, volume, depth) = (ways[pass], 1e9 * worn[pass], depths[pass]);
        println!("pass {pass}: {way:+.3} m, {volume:.0} mm3, {depth:.2} mm deep");
        if let Some(joint) = world.impulse_joints.get_mut(joint, true) {
            joint.data = motor(-SPEED).build();
        }
    }
    let a = (2.0 * f64::from(MASS) * 9.81 / (PI * HARDNESS)).sqrt();
    let expected = 2.0 / 3.0 * ways[0] * a.powi(3) / f64::from(RADIUS);
    println!("2/3 L a^3 / R: {:.0} mm3", 1e9 * expected);
    assert!((0.9..1.4).contains(&(worn[0] / expected)), "the front half bears the load");
    assert!((ways[0] + ways[1]).abs() < 0.01 * ways[0], "the motor holds its speed");
    assert!(depths[1] - depths[0] < 0.7 * depths[0], "the groove bears too");
    Ok(())
}

fn soft_ground() -> Result<Surface, abrade::SurfaceError> {
    let (hardness, young) = (HARDNESS, Some(500e6));
    let material = Material { hardness, shear_ratio: 0.25, young, poisson: 0.3, friction: 0.3 };
    let strip = HexStrip { length: 0.6, width: 0.1, pitch: 1e-3, rest_area: None };
    Surface::hex_strip(strip, SurfaceLaws::of(material))
}

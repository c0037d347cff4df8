//! An arm of two links with motors in its joints draws a hard tip along a plate, at 1/60 s.
//!
//! What to see: a scratch of about the volume 2/3 L a^3 / R that a ball of radius R leaves which
//! bears on its front half, pi a^2 / 2 = F / H, under the load F that the joints bring.
//!
//! `cargo run --release --example robot_arm`

use abrade::{HexStrip, Material, Surface, SurfaceLaws};
use abrade_rapier3d::rapier::prelude::*;
use abrade_rapier3d::{WearSettings, WearWorld};

const HARDNESS: f64 = 0.3e9;
const TIP: f32 = 0.002;
const LINK: f32 = 0.1;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = PhysicsWorld { gravity: Vector::Z * -9.81, ..PhysicsWorld::default() };
    world.integration_parameters.length_unit = 0.01;
    // With fewer, joints and motors do not hold against the friction of the tip.
    world.integration_parameters.num_solver_iterations = 16;
    let proxy = ColliderBuilder::cuboid(0.03, 0.002, 0.005);
    let proxy = world.colliders.insert(proxy.translation(Vector::new(0.12, 0.0, -0.005)));
    let mut wear = WearWorld::new(WearSettings::default());
    let plate = wear.insert_on_top(aluminium()?, proxy, &mut world.colliders)?;

    // Two links that point along x from their joints, the first 100 mm above the plate.
    let [upper, fore] = angles(0.10, TIP + 1e-4);
    let along = |pitch: f32| Vector::new(pitch.cos(), 0.0, -pitch.sin()) * (0.5 * LINK);
    let mut link = |middle: Vector, pitch: f32| {
        let body = RigidBodyBuilder::dynamic().translation(middle).rotation(Vector::Y * pitch);
        world.insert(body, ColliderBuilder::cuboid(0.04, 0.008, 0.008).density(7800.0)).0
    };
    let shoulder = Vector::Z * 0.1;
    let elbow = shoulder + 2.0 * along(upper);
    let arms = [link(shoulder + along(upper), upper), link(elbow + along(fore), fore)];
    let tip = ColliderBuilder::ball(TIP).translation(Vector::X * (0.5 * LINK)).density(7800.0);
    let tip = world.insert_collider(tip, Some(arms[1]));
    let base = world.insert_body(RigidBodyBuilder::fixed().translation(shoulder));
    let joints = [(base, arms[0], 0.0), (arms[0], arms[1], 0.5 * LINK)].map(|(from, to, at)| {
        let joint = RevoluteJointBuilder::new(Vector::Y).local_anchor1(Vector::X * at);
        let joint = joint.local_anchor2(Vector::X * (-0.5 * LINK)).contacts_enabled(false);
        world.insert_impulse_joint(from, to, joint.motor_model(MotorModel::ForceBased))
    });
    let (mut expected, mut last) = (0.0, 0.1);
    for step in 0..120 {
        // The motors pull towards 5 mm below the surface, and along.
        let way = 0.04 * ((step as f32 - 30.0) / 80.0).clamp(0.0, 1.0);
        let [upper, fore] = angles(0.10 + way, TIP - 5e-3 * (step as f32 / 30.0).min(1.0));
        for (joint, target) in joints.iter().zip([upper, fore - upper]) {
            let joint = world.impulse_joints.get_mut(*joint, true).ok_or("a joint is gone")?;
            joint.data.set_motor_position(JointAxis::AngX, target, 2000.0, 20.0);
        }
        wear.step(&mut world, &(), &())?;
        let at = f64::from(world.colliders[tip].translation().x);
        let bore = world.contact_pair(proxy, tip).map_or(Vector::ZERO, |pair| pair.total_impulse());
        let load = f64::from(bore.z.abs() * 60.0);
        let a = (2.0 * load / (std::f64::consts::PI * HARDNESS)).sqrt();
        expected += 2.0 / 3.0 * (at - last).max(0.0) * a.powi(3) / f64::from(TIP);
        last = at;
    }
    let worn = wear[plate].wear_volume();
    println!("worn {:.4} mm3, 2/3 L a^3 / R: {:.4} mm3", 1e9 * worn, 1e9 * expected);
    assert!((0.8..1.5).contains(&(worn / expected)), "the load of the joints makes the scratch");
    assert!(last > 0.13, "the arm follows its path");
    Ok(())
}

/// Pitch of both links below the horizontal, for a tip at `x` and `z`, the elbow up [rad].
fn angles(x: f32, z: f32) -> [f32; 2] {
    let (fall, bend) = ((0.1 - z).atan2(x), (0.5 * x.hypot(0.1 - z) / LINK).acos());
    [fall - bend, fall + bend]
}

fn aluminium() -> Result<Surface, abrade::SurfaceError> {
    let (hardness, young) = (HARDNESS, Some(70e9));
    let material = Material { hardness, shear_ratio: 0.25, young, poisson: 0.3, friction: 0.3 };
    let strip = HexStrip { length: 0.06, width: 0.004, pitch: 0.06e-3, rest_area: None };
    Surface::hex_strip(strip, SurfaceLaws::of(material))
}

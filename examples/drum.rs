//! A turning drum whose wall wears: a closed mesh on a kinematic body, grit inside, at 1/60 s.
//!
//! What to see: the wall takes the grit along and up, the grit falls back on it and wears it, and
//! none gets through.
//!
//! `cargo run --release --example drum`

use abrade::{Material, Surface, SurfaceLaws, TriangleMesh};
use abrade_rapier3d::rapier::prelude::*;
use abrade_rapier3d::{WearSettings, WearWorld};

const INNER: f64 = 0.15;
const GRAINS: usize = 12;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = PhysicsWorld { gravity: Vector::Y * -9.81, ..PhysicsWorld::default() };
    // A pipe about z, its nodes 6 mm apart; any closed mesh will do.
    let mesh = TriangleMesh::tube(INNER, 0.17, 0.1, 6e-3)?;
    let corner = |p: &nalgebra::Point3<f64>| Vector::new(p.x as f32, p.y as f32, p.z as f32);
    let corners = mesh.vertices().iter().map(corner).collect();
    let turning = RigidBodyBuilder::kinematic_velocity_based().angvel(Vector::Z * 5.0);
    let proxy = ColliderBuilder::trimesh(corners, mesh.triangles().to_vec())?;
    let (_, proxy) = world.insert(turning, proxy);
    let mut wear = WearWorld::new(WearSettings { accuracy: 1e-2, ..WearSettings::default() });
    let wall = wear.insert(Surface::mesh(&mesh, laws())?, proxy, &mut world.colliders)?;

    // Grains meet the wall and not each other: what bears on a solid is carried on its own.
    let grit = InteractionGroups::new(Group::GROUP_2, Group::GROUP_1, InteractionTestMode::And);
    let grains: Vec<_> = (0..GRAINS)
        .map(|i| {
            let angle = i as f32 * 0.5;
            let at = Vector::new(0.08 * angle.cos(), 0.08 * angle.sin(), 0.0);
            let ball = ColliderBuilder::ball(0.008).density(7800.0).collision_groups(grit);
            world.insert(RigidBodyBuilder::dynamic().translation(at), ball).0
        })
        .collect();
    for _ in 0..60 {
        wear.step(&mut world, &(), &())?;
    }
    let out = |grain: &RigidBodyHandle| world.bodies[*grain].translation().truncate().length();
    let farthest = grains.iter().map(out).fold(0.0, f32::max);
    let worn = &wear[wall];
    println!(
        "worn {:.1} mm3, {:.3} mm deep",
        1e9 * worn.wear_volume(),
        1e3 * worn.worn().max_depth
    );
    println!("the grain farthest out is {:.1} mm from the axis", 1e3 * farthest);
    assert!(worn.wear_volume() > 0.0, "what falls on the wall wears it");
    assert!(f64::from(farthest) < INNER, "nothing gets through the wall");
    Ok(())
}

fn laws() -> SurfaceLaws {
    let (hardness, young) = (5e5, Some(2.5e7));
    let material = Material { hardness, shear_ratio: 0.25, young, poisson: 0.3, friction: 0.5 };
    SurfaceLaws { restitution: 0.4, ..SurfaceLaws::of(material) }
}

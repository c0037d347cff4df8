//! The drum: a ring with lifters, as a closed mesh on a kinematic body, between two plates that stand.

use abrade::{MeshError, Surface, TriangleMesh};
use abrade_rapier3d::rapier::prelude::*;
use abrade_rapier3d::{SurfaceId, WearWorld};
use nalgebra::Point3;

/// Radius of the liner between the lifters, of the drum's outside, and length of the drum [m].
pub const RADIUS: f64 = 0.15;
const OUTSIDE: f64 = 0.17;
const LENGTH: f64 = 0.05;
/// Number and height of the lifters [m]; each takes the middle of a tenth of its part of the ring.
const LIFTERS: usize = 8;
const HEIGHT: f64 = 0.012;
const SEGMENTS: usize = 160;
const PITCH: f64 = 4e-3;

/// The ring about z.
pub fn mesh() -> Result<TriangleMesh, MeshError> {
    let part = SEGMENTS / LIFTERS;
    let inner = |i: usize| if i % part < part / 10 + 1 { RADIUS - HEIGHT } else { RADIUS };
    let mut vertices = Vec::new();
    for i in 0..SEGMENTS {
        let angle = std::f64::consts::TAU * i as f64 / SEGMENTS as f64;
        let at = |radius: f64, z: f64| Point3::new(radius * angle.cos(), radius * angle.sin(), z);
        let half = 0.5 * LENGTH;
        vertices.extend([
            at(inner(i), -half),
            at(inner(i), half),
            at(OUTSIDE, half),
            at(OUTSIDE, -half),
        ]);
    }
    let corner = |i: usize, k: usize| (i % SEGMENTS * 4 + k % 4) as u32;
    let quad = |(i, k)| {
        let [a, b, c, d] = [corner(i, k), corner(i, k + 1), corner(i + 1, k + 1), corner(i + 1, k)];
        [[a, b, c], [a, c, d]]
    };
    let sides = (0..SEGMENTS).flat_map(|i| (0..4).map(move |k| (i, k)));
    TriangleMesh::new(vertices, sides.flat_map(quad).collect())?.resampled(PITCH)
}

/// Puts the turning drum with its `liner` and the plates at its ends into the world.
pub fn insert(
    world: &mut PhysicsWorld,
    wear: &mut WearWorld,
    liner: Surface,
) -> Result<SurfaceId, Box<dyn std::error::Error>> {
    let nodes = liner.nodes();
    let corner = |p: &Point3<f64>| Vector::new(p.x as f32, p.y as f32, p.z as f32);
    let corners = nodes.rest_position.iter().map(corner).collect();
    let flags = TriMeshFlags::FIX_INTERNAL_EDGES;
    let proxy =
        ColliderBuilder::trimesh_with_flags(corners, liner.triangles(), flags)?.friction(0.4);
    let speed = std::f32::consts::TAU * crate::SPEED;
    let turning = RigidBodyBuilder::kinematic_velocity_based().angvel(Vector::Z * speed);
    let (_, proxy) = world.insert(turning, proxy);
    let (wide, thick) = (OUTSIDE as f32, 0.01);
    for side in [-1.0, 1.0] {
        let plate = ColliderBuilder::cuboid(wide, wide, thick).friction(0.0);
        let place = side * (0.5 * LENGTH as f32 + thick);
        world.colliders.insert(plate.translation(Vector::Z * place));
    }
    Ok(wear.insert(liner, proxy, &mut world.colliders)?)
}

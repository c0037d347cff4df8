//! How deep a body lies inside the solid of a mesh whose vertices are nodes; whether two such solids
//! overlap.

use abrade::{Hull, Piece, Shape, State, TriangleMesh};
use nalgebra::{Isometry3, Point3};

use crate::place;

/// Part of its size by which a solid may reach into another one that it touches.
const TOUCH: f64 = 1e-9;

/// Depth [m] of a body inside the solid that `mesh` bounds, `state` being in the mesh's frame;
/// none outside. Nodes inside the body count, and points of the body inside the solid; facets of
/// a hull that pass between nodes do not.
pub(crate) fn depth_in_mesh(
    shape: &Shape,
    state: &State,
    mesh: &TriangleMesh,
    node_height: f64,
) -> Option<f64> {
    let reach = shape.bounding_radius() + node_height;
    let [low, high] = mesh.bounds();
    let beyond = |axis: usize| {
        let at = state.position[axis];
        at + reach < low[axis] || at - reach > high[axis]
    };
    if (0..3).any(beyond) {
        return None;
    }
    let pose = state.pose();
    let depth = |piece: &Piece| match piece {
        Piece::Ball(ball) => ball_depth(&(pose * ball.centre), ball.radius + node_height, mesh),
        Piece::Hull(hull) => hull_depth(hull, &pose, mesh, node_height),
    };
    let deepest = shape.pieces().iter().map(depth).fold(0.0, f64::max);
    (deepest > place::round_off(shape, state)).then_some(deepest)
}

/// The first two of the solids that `mesh` bounds in these `frames` of which one has a node inside
/// the other; that they touch is no overlap. Facets that pass between nodes do not count.
pub(crate) fn first_overlap(mesh: &TriangleMesh, frames: &[Isometry3<f64>]) -> Option<[usize; 2]> {
    let [low, high] = mesh.bounds();
    let middle = nalgebra::center(&low, &high);
    let across = (high - low).norm();
    let middles: Vec<_> = frames.iter().map(|frame| frame * middle).collect();
    let shrunk = |corner: &Point3<f64>| middle + (corner - middle) * (1.0 - TOUCH);
    let nodes: Vec<_> = mesh.vertices().iter().map(shrunk).collect();
    let in_box = |p: &Point3<f64>| (0..3).all(|axis| low[axis] <= p[axis] && p[axis] <= high[axis]);
    let inside = |p: Point3<f64>| in_box(&p) && contains(mesh, &p);
    let reaches = |way: Isometry3<f64>| nodes.iter().any(|node| inside(way * node));
    let overlap = |a: usize, b: usize| {
        let way = frames[a].inv_mul(&frames[b]);
        (middles[a] - middles[b]).norm() < across && (reaches(way) || reaches(way.inverse()))
    };
    let mut pairs = (0..frames.len()).flat_map(|a| (a + 1..frames.len()).map(move |b| [a, b]));
    pairs.find(|&[a, b]| overlap(a, b))
}

/// Positive when the ball touches a node, or its centre lies inside.
fn ball_depth(centre: &Point3<f64>, radius: f64, mesh: &TriangleMesh) -> f64 {
    let distance = nearest(centre, mesh);
    match contains(mesh, centre) {
        true => radius + distance,
        false => radius - distance,
    }
}

fn hull_depth(hull: &Hull, pose: &Isometry3<f64>, mesh: &TriangleMesh, node_height: f64) -> f64 {
    let inside = |node: &Point3<f64>| {
        let local = pose.inverse_transform_point(node);
        let below = |plane: &abrade::Plane| plane.offset - plane.normal.dot(&local.coords);
        hull.planes().iter().map(below).fold(f64::INFINITY, f64::min) + node_height
    };
    let by_node = mesh.vertices().iter().map(inside).fold(0.0, f64::max);
    let corners = hull.vertices().iter().map(|corner| pose * corner);
    let sunk = corners.filter(|corner| contains(mesh, corner));
    sunk.map(|corner| nearest(&corner, mesh)).fold(by_node, f64::max)
}

/// Distance to the nearest node [m].
fn nearest(point: &Point3<f64>, mesh: &TriangleMesh) -> f64 {
    let squares = mesh.vertices().iter().map(|node| (node - point).norm_squared());
    squares.fold(f64::INFINITY, f64::min).sqrt()
}

/// True inside the solid: its facets cover the whole sphere of directions from `point` (Van Oosterom
/// & Strackee, IEEE Transactions on Biomedical Engineering 30 (1983) 125, Eq. 8).
fn contains(mesh: &TriangleMesh, point: &Point3<f64>) -> bool {
    let [low, high] = mesh.bounds();
    if (0..3).any(|axis| point[axis] < low[axis] || point[axis] > high[axis]) {
        return false;
    }
    let half_angle = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|i| mesh.vertices()[i as usize] - point);
        let [p, q, r] = [a.norm(), b.norm(), c.norm()];
        let below = p * q * r + a.dot(&b) * r + b.dot(&c) * p + c.dot(&a) * q;
        a.dot(&b.cross(&c)).atan2(below)
    };
    let sum: f64 = mesh.triangles().iter().map(half_angle).sum();
    sum > std::f64::consts::PI
}

#[cfg(test)]
mod tests {
    use super::*;

    fn depth(shape: &Shape, mesh: &TriangleMesh, at: [f64; 3]) -> Option<f64> {
        let depth = depth_in_mesh(shape, &State::at(Point3::from(at)), mesh, 0.0);
        depth.map(|depth| (depth * 1e6).round() / 1e6)
    }

    /// Fails for a check by bounding boxes, and for one that knows only nodes or only insides.
    #[test]
    fn a_ball_in_the_bore_lies_outside_the_tube() {
        let tube = TriangleMesh::tube(0.02, 0.03, 0.1, 0.002).expect("a tube");
        let ball = Shape::ball(0.005).expect("a ball");
        assert_eq!(depth(&ball, &tube, [0.0, 0.0, 0.0]), None);
        assert_eq!(depth(&ball, &tube, [0.0, 0.0, 0.0525]), None);
        let speck = Shape::ball(1e-5).expect("a ball");
        assert!(depth(&speck, &tube, [0.025, 0.0, 0.0]) > Some(0.004));
        assert!(depth(&ball, &tube, [0.016, 0.0, 0.0]) > Some(0.0008));
    }

    /// Fails for a hull of which only corners, or only nodes inside it, are looked at.
    #[test]
    fn a_hull_is_inside_by_a_corner_or_around_a_node() {
        let sphere = TriangleMesh::sphere(0.02, 0.002).expect("a sphere");
        let cube = abrade::cuboid_vertices(&nalgebra::Vector3::repeat(0.05));
        let hull = Hull::solid(&cube, 1.0).expect("a cube").0;
        let cube = Shape::hull(hull);
        assert_eq!(depth(&cube, &sphere, [0.0, 0.0, 0.0701]), None);
        assert_eq!(depth(&cube, &sphere, [0.0, 0.0, 0.069]), Some(0.001));
        let needle = abrade::cuboid_vertices(&nalgebra::Vector3::new(1e-4, 1e-4, 0.05));
        let needle = Shape::hull(Hull::solid(&needle, 1.0).expect("a needle").0);
        assert!(depth(&needle, &sphere, [3e-4, 4e-4, 0.05]) > Some(0.015));
    }
}

//! Solids of revolution about z that are their own mirror image in z = 0: rings of nodes along a
//! profile, joined by triangles.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::Point3;

use super::TriangleMesh;
use super::check::bound_count;
use super::error::MeshError;
use crate::surface::SOLID_NODE_LIMIT;

/// Fewest nodes of a ring that is not a pole.
const LEAST_RING: f64 = 6.0;

/// A piece of the profile in the half plane of r (distance from z) and z [m], from z <= 0.
#[derive(Clone, Copy, Debug)]
pub(super) enum Piece {
    /// From one (r, z) to another.
    Line([f64; 2], [f64; 2]),
    /// A quarter of a circle about (0, z), from the axis below it outward.
    Quarter {
        /// Height of the centre [m].
        z: f64,
        /// Radius [m].
        radius: f64,
    },
}

impl Piece {
    fn length(&self) -> f64 {
        match self {
            Self::Line([r, z], [s, w]) => (s - r).hypot(w - z),
            Self::Quarter { radius, .. } => FRAC_PI_2 * radius,
        }
    }

    /// Mean distance from the axis, weighted by length [m].
    fn mean_radius(&self) -> f64 {
        match self {
            Self::Line([r, _], [s, _]) => (r + s) / 2.0,
            Self::Quarter { radius, .. } => radius / FRAC_PI_2,
        }
    }

    /// Parts between rings: these are as far apart as the rows of a close packing.
    fn parts(&self, pitch: f64) -> f64 {
        (self.length() / (pitch * 0.75f64.sqrt())).round().max(1.0)
    }

    /// Nodes on the piece, to within those of one ring.
    fn nodes(&self, pitch: f64) -> f64 {
        self.parts(pitch) * (TAU * self.mean_radius() / pitch).max(LEAST_RING)
    }

    /// Point number `k` of `parts`; the ends are met exactly.
    fn point(&self, k: usize, parts: usize) -> [f64; 2] {
        let share = k as f64 / parts as f64;
        match *self {
            Self::Line(from, to) => [0, 1].map(|a| match k == parts {
                true => to[a],
                false => from[a] + (to[a] - from[a]) * share,
            }),
            Self::Quarter { z, radius } => match k {
                0 => [0.0, z - radius],
                _ if k == parts => [radius, z],
                _ => [radius * (FRAC_PI_2 * share).sin(), z - radius * (FRAC_PI_2 * share).cos()],
            },
        }
    }
}

/// The solid whose profile is `pieces` and their mirror image. They run counter-clockwise around
/// the material in the plane of (r, z), and begin and end on the axis or on z = 0.
pub(super) fn turn(pieces: &[Piece], pitch: f64) -> Result<TriangleMesh, MeshError> {
    let count = 2.0 * pieces.iter().map(|piece| piece.nodes(pitch)).sum::<f64>();
    bound_count("vertices", count, SOLID_NODE_LIMIT)?;
    let mut vertices = Vec::new();
    let rings: Vec<Ring> = profile(pieces, pitch)
        .into_iter()
        .enumerate()
        .map(|(row, point)| Ring::laid(point, pitch, row, &mut vertices))
        .collect();
    let mut triangles = Vec::new();
    rings.windows(2).for_each(|pair| stitch(&pair[0], &pair[1], &mut triangles));
    mirror(&mut vertices, &mut triangles);
    TriangleMesh::new(vertices, triangles)
}

/// Points (r, z) along the pieces, corners once.
fn profile(pieces: &[Piece], pitch: f64) -> Vec<[f64; 2]> {
    let mut points = vec![pieces[0].point(0, 1)];
    for piece in pieces {
        let parts = piece.parts(pitch) as usize;
        points.extend((1..=parts).map(|k| piece.point(k, parts)));
    }
    points
}

/// Nodes evenly around the axis; one on it.
#[derive(Debug)]
pub(super) struct Ring {
    first: u32,
    nodes: i64,
    /// 1 if the nodes are turned by half their distance.
    shift: i64,
}

impl Ring {
    fn laid([r, z]: [f64; 2], pitch: f64, row: usize, vertices: &mut Vec<Point3<f64>>) -> Self {
        let first = vertices.len() as u32;
        if r == 0.0 {
            vertices.push(Point3::new(0.0, 0.0, z));
            return Self { first, nodes: 1, shift: 0 };
        }
        let node = |angle: f64| Point3::new(r * angle.cos(), r * angle.sin(), z);
        Self::around(TAU * r / pitch, row, vertices, node)
    }

    /// About `nodes` nodes where `place` puts their angles around the axis; every other row is
    /// turned by half their distance.
    pub(super) fn around(
        nodes: f64,
        row: usize,
        vertices: &mut Vec<Point3<f64>>,
        place: impl Fn(f64) -> Point3<f64>,
    ) -> Self {
        let first = vertices.len() as u32;
        let nodes = nodes.round().max(LEAST_RING);
        let shift = row % 2;
        let angle = |k: usize| TAU * (k as f64 + 0.5 * shift as f64) / nodes;
        vertices.extend((0..nodes as usize).map(|k| place(angle(k))));
        Self { first, nodes: nodes as i64, shift: shift as i64 }
    }

    fn node(&self, k: i64) -> u32 {
        self.first + (k % self.nodes) as u32
    }

    /// Angle of node `k` in units of pi / (nodes of this ring * nodes of `other`).
    fn angle(&self, k: i64, other: &Self) -> i64 {
        (2 * k + self.shift) * other.nodes
    }
}

/// Triangles between two rings: from a common start on, the ring advances whose new diagonal is
/// shorter, which is the one that spans less angle.
pub(super) fn stitch(below: &Ring, above: &Ring, triangles: &mut Vec<[u32; 3]>) {
    let (mut i, mut j) = (0, 0);
    let [last_i, last_j] = [below, above].map(|ring| if ring.nodes > 1 { ring.nodes } else { 0 });
    while i < last_i || j < last_j {
        let span = |i: i64, j: i64| (below.angle(i, above) - above.angle(j, below)).abs();
        let step_below = j == last_j || (i < last_i && span(i + 1, j) <= span(i, j + 1));
        if step_below {
            triangles.push([below.node(i), below.node(i + 1), above.node(j)]);
            i += 1;
        } else {
            triangles.push([below.node(i), above.node(j + 1), above.node(j)]);
            j += 1;
        }
    }
}

/// Adds the mirror image in z = 0; nodes in that plane are shared.
fn mirror(vertices: &mut Vec<Point3<f64>>, triangles: &mut Vec<[u32; 3]>) {
    let mut image = Vec::with_capacity(vertices.len());
    for i in 0..vertices.len() {
        let p = vertices[i];
        if p.z == 0.0 {
            image.push(i as u32);
        } else {
            image.push(vertices.len() as u32);
            vertices.push(Point3::new(p.x, p.y, -p.z));
        }
    }
    for k in 0..triangles.len() {
        let [a, b, c] = triangles[k].map(|i| image[i as usize]);
        triangles.push([a, c, b]);
    }
}

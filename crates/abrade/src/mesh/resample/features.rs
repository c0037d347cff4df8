//! What resampling keeps: sharp edges, the chains they form, the corners where chains end, and the
//! patches of the surface between them.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_3;

use nalgebra::{Point3, Vector3};

use super::super::links;
use super::super::nodes::area_vector;
use crate::mesh::TriangleMesh;

/// Cosine of the angle above which an edge is sharp, and a chain of them bends: 30 degrees.
const SHARP: f64 = 0.866_025_403_784_438_6;
/// Angle missing around a vertex [rad] above which it is a tip: 30 degrees.
const TIP: f64 = FRAC_PI_3 / 2.0;
/// Facets around a vertex of a regular net.
const REGULAR: f64 = 6.0;

/// How a vertex may move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Within its patch.
    Smooth,
    /// Along this chain.
    Along(u32),
    /// Not at all.
    Fixed,
}

#[derive(Debug)]
pub(super) struct Features {
    /// Patch of each facet.
    pub(super) patch: Vec<u32>,
    /// Chain of each sharp edge, by its sorted ends.
    pub(super) chain: BTreeMap<[u32; 2], u32>,
    /// Of each vertex.
    pub(super) kind: Vec<Kind>,
    /// Number of facets that a vertex should have.
    pub(super) ideal: Vec<f64>,
}

/// An edge by its ends, the lower index first.
pub(super) fn sorted(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

impl Features {
    pub(super) fn of(mesh: &TriangleMesh) -> Self {
        let (vertices, triangles) = (mesh.vertices(), mesh.triangles());
        let sides = links::sides(triangles);
        let twins = links::twins(&sides);
        let normals: Vec<Vector3<f64>> =
            triangles.iter().map(|t| area_vector(vertices, t).normalize()).collect();
        let sharp = |half: usize| {
            let other = links::across(&twins, half);
            other.is_some_and(|other| normals[half / 3].dot(&normals[other]) < SHARP)
        };
        let (patch, _) = links::regions(&twins, |half| !sharp(half));
        let edges: Vec<[u32; 2]> = links::edges(&sides)
            .filter(|edge| sharp(edge[0].half as usize))
            .map(|edge| edge[0].ends)
            .collect();
        let mut next = vec![Vec::new(); vertices.len()];
        for [a, b] in &edges {
            next[*a as usize].push(*b);
            next[*b as usize].push(*a);
        }
        let angles = angle_sums(vertices, triangles);
        let moves: Vec<bool> = (0..vertices.len())
            .map(|i| match next[i].as_slice() {
                [] => std::f64::consts::TAU - angles[i] < TIP,
                [a, b] => in_line(vertices, *a, i as u32, *b),
                _ => false,
            })
            .collect();
        let chain = chains(&edges, &next, &moves);
        let kind_of = |i: usize| match next[i].first() {
            _ if !moves[i] => Kind::Fixed,
            None => Kind::Smooth,
            Some(j) => Kind::Along(chain[&sorted(i as u32, *j)]),
        };
        let kind: Vec<Kind> = (0..vertices.len()).map(kind_of).collect();
        let ideal = |i: usize| if moves[i] { REGULAR } else { (angles[i] / FRAC_PI_3).max(3.0) };
        let ideal = (0..vertices.len()).map(ideal).collect();
        Self { patch, chain, kind, ideal }
    }
}

/// True unless the way from `a` over `i` to `b` bends sharply.
fn in_line(vertices: &[Point3<f64>], a: u32, i: u32, b: u32) -> bool {
    let [a, i, b] = [a, i, b].map(|k| vertices[k as usize]);
    (i - a).normalize().dot(&(b - i).normalize()) >= SHARP
}

/// Sum of the facets' angles at each vertex [rad].
fn angle_sums(vertices: &[Point3<f64>], triangles: &[[u32; 3]]) -> Vec<f64> {
    let mut sums = vec![0.0; vertices.len()];
    for t in triangles {
        for k in 0..3 {
            let [p, q, r] = [0, 1, 2].map(|l| vertices[t[(k + l) % 3] as usize]);
            sums[t[k] as usize] += (q - p).angle(&(r - p));
        }
    }
    sums
}

/// Numbers the chains: sharp edges belong together across vertices that may move.
fn chains(edges: &[[u32; 2]], next: &[Vec<u32>], moves: &[bool]) -> BTreeMap<[u32; 2], u32> {
    let mut chain = BTreeMap::new();
    let mut count = 0;
    for edge in edges {
        if chain.contains_key(edge) {
            continue;
        }
        let mut stack = vec![*edge];
        while let Some(edge) = stack.pop() {
            if chain.insert(edge, count).is_some() {
                continue;
            }
            for end in edge.into_iter().filter(|i| moves[*i as usize]) {
                let more = next[end as usize].iter().map(|j| sorted(end, *j));
                stack.extend(more.filter(|edge| !chain.contains_key(edge)));
            }
        }
        count += 1;
    }
    chain
}

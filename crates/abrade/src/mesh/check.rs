//! What a triangle mesh must be to bound a solid. Each check presumes those before it.

use nalgebra::{Point3, Vector3};

use super::error::MeshError;
use super::links::{self, Side};
use super::shells::{Shell, shells};
use super::{crossing, nodes};
use crate::surface::SOLID_NODE_LIMIT;

/// Area of a facet over the square of its longest edge, below which it counts as a line.
const SLIVER: f64 = 1e-12;
/// Length of a sum of area vectors over the sum of their lengths, below which they cancel.
const CANCELLED: f64 = 1e-9;

/// Fails unless the mesh is the closed, oriented, manifold boundary of a solid.
pub(super) fn check(vertices: &[Point3<f64>], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    indices(vertices, triangles)?;
    areas(vertices, triangles)?;
    usage(vertices, triangles)?;
    let sides = links::sides(triangles);
    edges(vertices, triangles, &sides)?;
    let twins = links::twins(&sides);
    pinches(vertices, triangles, &twins)?;
    crossing::check(vertices, triangles)?;
    orientation(&shells(vertices, triangles, &twins))?;
    normals(vertices, triangles)
}

/// Counts, coordinates and indices.
pub(super) fn indices(vertices: &[Point3<f64>], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    counts(vertices.len() as f64, triangles.len())?;
    let unreal = |p: &Point3<f64>| p.iter().any(|x| !x.is_finite());
    if let Some(vertex) = vertices.iter().position(unreal) {
        return Err(MeshError::NotFinite { vertex, at: vertices[vertex] });
    }
    for (facet, corners) in triangles.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|i| **i as usize >= vertices.len()) {
            return Err(MeshError::NoSuchVertex { facet, vertex, vertices: vertices.len() });
        }
    }
    Ok(())
}

fn counts(vertices: f64, facets: usize) -> Result<(), MeshError> {
    if facets < 4 {
        return Err(MeshError::TooFewFacets { facets });
    }
    bound_count("vertices", vertices, SOLID_NODE_LIMIT)?;
    bound_count("facets", facets as f64, 2.0 * SOLID_NODE_LIMIT)
}

/// Fails if `count`, which may not be a number, is above `limit`.
pub(super) fn bound_count(what: &'static str, count: f64, limit: f64) -> Result<(), MeshError> {
    match count <= limit {
        true => Ok(()),
        false => Err(MeshError::TooMany { what, count, limit }),
    }
}

pub(super) fn areas(vertices: &[Point3<f64>], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    let mut flat = Tally::default();
    for (facet, corners) in triangles.iter().enumerate() {
        let [a, b, c] = corners.map(|i| vertices[i as usize]);
        let longest =
            [b - a, c - b, a - c].map(|e| e.norm_squared()).into_iter().fold(0.0, f64::max);
        let area = nodes::area_vector(vertices, corners).norm();
        if !(longest.is_finite() && area.is_finite()) {
            return Err(MeshError::TooLarge);
        }
        if area <= SLIVER * longest {
            flat.add(facet);
        }
    }
    flat.report(|facet, others| {
        let at = vertices[triangles[facet][0] as usize];
        MeshError::FlatFacet { facet, at, others }
    })
}

fn usage(vertices: &[Point3<f64>], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    let mut used = vec![false; vertices.len()];
    triangles.iter().flatten().for_each(|&i| used[i as usize] = true);
    let mut unused = Tally::default();
    (0..used.len()).filter(|&i| !used[i]).for_each(|i| unused.add(i));
    unused.report(|vertex, others| MeshError::UnusedVertex { vertex, at: vertices[vertex], others })
}

fn edges(
    vertices: &[Point3<f64>],
    triangles: &[[u32; 3]],
    sides: &[Side],
) -> Result<(), MeshError> {
    let (mut open, mut crowded, mut turned) =
        (Tally::default(), Tally::default(), Tally::default());
    for edge in links::edges(sides) {
        match edge {
            [_] => open.add(edge),
            [a, b] => {
                let [first, second] = [a, b].map(|side| links::ends(triangles, side.half as usize));
                if first == second {
                    turned.add(edge);
                }
            }
            _ => crowded.add(edge),
        }
    }
    let places = |edge: &[Side]| edge[0].ends.map(|i| vertices[i as usize]);
    crowded.report(|edge, others| {
        let [from, to] = places(edge);
        MeshError::Crowded { from, to, facets: edge.len(), others }
    })?;
    open.report(|edge, others| {
        let [from, to] = places(edge);
        MeshError::Open { from, to, others }
    })?;
    turned.report(|edge, others| {
        let [from, to] = places(edge);
        MeshError::Turned { from, to, others }
    })
}

fn pinches(
    vertices: &[Point3<f64>],
    triangles: &[[u32; 3]],
    twins: &[u32],
) -> Result<(), MeshError> {
    let fans = links::fans(triangles, twins, vertices.len());
    let mut pinched = Tally::default();
    (0..fans.len()).filter(|&i| fans[i] > 1).for_each(|i| pinched.add(i));
    pinched.report(|i, others| MeshError::Pinched {
        at: vertices[i],
        fans: fans[i] as usize,
        others,
    })
}

pub(super) fn orientation(shells: &[Shell]) -> Result<(), MeshError> {
    if shells.iter().any(|shell| !shell.volume.is_finite()) {
        return Err(MeshError::TooLarge);
    }
    match shells.iter().find(|shell| shell.is_inside_out()) {
        None => Ok(()),
        Some(Shell { facets, at, inside, .. }) => {
            Err(MeshError::InsideOut { facets: facets.len(), at: *at, inside: *inside })
        }
    }
}

pub(super) fn normals(vertices: &[Point3<f64>], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    let mut lengths = vec![0.0; vertices.len()];
    for corners in triangles {
        let area = nodes::area_vector(vertices, corners).norm();
        corners.iter().for_each(|&i| lengths[i as usize] += area);
    }
    if !lengths.iter().sum::<f64>().is_finite() {
        return Err(MeshError::TooLarge);
    }
    let sums: Vec<Vector3<f64>> = nodes::area_sums(vertices, triangles);
    let cancels = |i: &usize| sums[*i].norm() <= CANCELLED * lengths[*i];
    match (0..sums.len()).find(cancels) {
        None => Ok(()),
        Some(i) => Err(MeshError::NoNormal { at: vertices[i] }),
    }
}

/// The first fault of a kind, and how many there are.
#[derive(Debug)]
struct Tally<T> {
    first: Option<T>,
    count: usize,
}

impl<T> Default for Tally<T> {
    fn default() -> Self {
        Self { first: None, count: 0 }
    }
}

impl<T> Tally<T> {
    fn add(&mut self, fault: T) {
        self.count += 1;
        self.first.get_or_insert(fault);
    }

    fn report(self, error: impl FnOnce(T, usize) -> MeshError) -> Result<(), MeshError> {
        match self.first {
            None => Ok(()),
            Some(fault) => Err(error(fault, self.count - 1)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a bound that is only looked at once the memory is there.
    #[test]
    fn too_many_vertices_are_refused_by_number() {
        let message = counts(3e8, 9).expect_err("too many").to_string();
        assert_eq!(message, "the mesh would have 3.000e8 vertices, at most 5.0e6 are allowed");
        assert!(matches!(counts(9.0, 400_000_001), Err(MeshError::TooMany { what: "facets", .. })));
        assert_eq!(counts(4.0, 3), Err(MeshError::TooFewFacets { facets: 3 }));
    }
}

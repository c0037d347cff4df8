//! Repairs of a mesh that do not change its shape.

use std::collections::HashMap;
use std::fmt::{self, Display, Formatter};

use nalgebra::Point3;

use super::check;
use super::error::MeshError;
use super::links::{self, Side};
use super::shells::shells;

/// Distance over extent below which vertices coincide.
const WELD: f64 = 1e-9;
/// Width of a cell over the distance of welding: most vertices are near no wall of their cell.
const CELL: f64 = 64.0;

/// What was repaired in a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mended {
    /// Vertices that were merged into another one.
    pub welded: usize,
    /// Facets that had collapsed to a line or a point.
    pub dropped_facets: usize,
    /// Vertices that no facet used.
    pub dropped_vertices: usize,
    /// Facets whose orientation was reversed.
    pub turned_facets: usize,
}

impl Display for Mended {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let said = |count: usize, one: &str, many: &str| match count {
            0 => None,
            1 => Some(format!("1 {one}")),
            _ => Some(format!("{count} {many}")),
        };
        let parts: Vec<String> = [
            said(self.welded, "vertex was welded", "vertices were welded"),
            said(
                self.dropped_facets,
                "collapsed facet was dropped",
                "collapsed facets were dropped",
            ),
            said(
                self.dropped_vertices,
                "unused vertex was dropped",
                "unused vertices were dropped",
            ),
            said(self.turned_facets, "facet was turned", "facets were turned"),
        ]
        .into_iter()
        .flatten()
        .collect();
        match parts.as_slice() {
            [] => write!(f, "nothing had to be mended"),
            [only] => write!(f, "{only}"),
            [most @ .., last] => write!(f, "{} and {last}", most.join(", ")),
        }
    }
}

type Parts = (Vec<Point3<f64>>, Vec<[u32; 3]>, Mended);

/// Welds, drops and turns. Fails for counts, coordinates and indices that cannot be repaired.
pub(super) fn mend(
    vertices: Vec<Point3<f64>>,
    triangles: Vec<[u32; 3]>,
) -> Result<Parts, MeshError> {
    check::indices(&vertices, &triangles)?;
    let mut mended = Mended::default();
    let (into, welded) = weld(&vertices);
    mended.welded = welded;
    let facets = triangles.len();
    let mut triangles: Vec<[u32; 3]> =
        triangles.iter().map(|t| t.map(|i| into[i as usize])).collect();
    triangles.retain(|[a, b, c]| a != b && b != c && c != a);
    mended.dropped_facets = facets - triangles.len();
    let vertices = drop_unused(vertices, &mut triangles, &mut mended);
    mended.turned_facets = turn(&vertices, &mut triangles);
    Ok((vertices, triangles, mended))
}

/// For each vertex the first one that it coincides with, and how many have a different one.
fn weld(vertices: &[Point3<f64>]) -> (Vec<u32>, usize) {
    let (low, high) =
        vertices.iter().fold((vertices[0], vertices[0]), |(l, h), p| (l.inf(p), h.sup(p)));
    let near = WELD * (high - low).amax();
    let width = if near > 0.0 { CELL * near } else { 1.0 };
    let cell = |x: f64, a: usize| ((x - low[a]) / width).floor() as i64;
    let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    let mut into: Vec<u32> = Vec::with_capacity(vertices.len());
    let mut welded = 0;
    for (i, p) in vertices.iter().enumerate() {
        let around: [[i64; 2]; 3] =
            std::array::from_fn(|a| [cell(p[a] - near, a), cell(p[a] + near, a)]);
        let close = |j: &u32| {
            let q = &vertices[*j as usize];
            p == q || (p - q).norm() <= near
        };
        let known =
            boxes(around).filter_map(|key| cells.get(&key)?.iter().copied().find(close)).min();
        match known {
            Some(_) => welded += 1,
            None => cells.entry(std::array::from_fn(|a| cell(p[a], a))).or_default().push(i as u32),
        }
        into.push(known.unwrap_or(i as u32));
    }
    (into, welded)
}

/// Cells between the first and the last along each axis, which are the same or neighbours.
fn boxes(around: [[i64; 2]; 3]) -> impl Iterator<Item = [i64; 3]> {
    let [xs, ys, zs] = around.map(|[first, last]| first..=last);
    xs.flat_map(move |x| {
        let zs = zs.clone();
        ys.clone().flat_map(move |y| zs.clone().map(move |z| [x, y, z]))
    })
}

/// Keeps the vertices that a facet names, in their order. Welded ones are not counted as unused.
fn drop_unused(
    vertices: Vec<Point3<f64>>,
    triangles: &mut [[u32; 3]],
    mended: &mut Mended,
) -> Vec<Point3<f64>> {
    let mut used = vec![false; vertices.len()];
    triangles.iter().flatten().for_each(|&i| used[i as usize] = true);
    let mut number = vec![0; vertices.len()];
    let mut kept = Vec::new();
    for (i, p) in vertices.iter().enumerate().filter(|(i, _)| used[*i]) {
        number[i] = kept.len() as u32;
        kept.push(*p);
    }
    triangles.iter_mut().flatten().for_each(|i| *i = number[*i as usize]);
    mended.dropped_vertices = vertices.len() - kept.len() - mended.welded;
    kept
}

/// Turns facets to agree with their neighbours, and shells to face away from the material. Leaves
/// what cannot be oriented as it is. Returns the number of facets turned.
fn turn(vertices: &[Point3<f64>], triangles: &mut [[u32; 3]]) -> usize {
    let sides = links::sides(triangles);
    let twins = links::twins(&sides);
    let Some(mut turned) = agreement(triangles, &twins) else { return 0 };
    let reverse = |triangles: &mut [[u32; 3]], facet: usize| triangles[facet].swap(1, 2);
    (0..turned.len()).filter(|&f| turned[f]).for_each(|f| reverse(triangles, f));
    if links::edges(&sides).all(|edge: &[Side]| edge.len() == 2) {
        // Reversing facets renumbers half-edges.
        let twins = links::twins(&links::sides(triangles));
        for shell in shells(vertices, triangles, &twins) {
            if shell.is_inside_out() {
                for facet in shell.facets {
                    reverse(triangles, facet as usize);
                    turned[facet as usize] ^= true;
                }
            }
        }
    }
    turned.iter().filter(|turned| **turned).count()
}

/// Which facets must be turned to agree with the first of their shell; none if a shell has only
/// one side.
fn agreement(triangles: &[[u32; 3]], twins: &[u32]) -> Option<Vec<bool>> {
    let mut turned: Vec<Option<bool>> = vec![None; triangles.len()];
    let mut stack = Vec::new();
    for start in 0..triangles.len() {
        if turned[start].is_some() {
            continue;
        }
        turned[start] = Some(false);
        stack.push((start, false));
        while let Some((facet, own)) = stack.pop() {
            for half in (3 * facet..3 * facet + 3).filter(|&half| twins[half] != u32::MAX) {
                let twin = twins[half] as usize;
                let same_way = links::ends(triangles, half) == links::ends(triangles, twin);
                let wanted = own ^ same_way;
                match turned[twin / 3] {
                    None => {
                        turned[twin / 3] = Some(wanted);
                        stack.push((twin / 3, wanted));
                    }
                    Some(known) if known != wanted => return None,
                    Some(_) => {}
                }
            }
        }
    }
    Some(turned.into_iter().map(|turned| turned == Some(true)).collect())
}

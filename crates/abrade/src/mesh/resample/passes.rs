//! Passes over all edges: split, collapse, flip.

use nalgebra::Point3;

use super::features::Kind;
use super::guard::{Corners, hardly_turns, may_move, shape};
use super::original::Original;
use super::patchwork::{Edge, Patchwork};
use crate::mesh::check::bound_count;
use crate::mesh::error::MeshError;
use crate::surface::SOLID_NODE_LIMIT;

/// Lengths over pitch above which an edge is split and below which it is collapsed.
const LONG: f64 = 4.0 / 3.0;
const SHORT: f64 = 4.0 / 5.0;
/// The same for sharp edges: equal parts of a straight one are never both too long and too short.
const LONG_SHARP: f64 = 1.5;
const SHORT_SHARP: f64 = 2.0 / 3.0;
/// Halvings of the longest edge after which the pass ends in any case.
const MOST_HALVINGS: usize = 64;

/// Splits every edge that is too long, the longest first: sharp ones into equal parts. Facets much longer
/// than they are wide take more vertices than their area tells: fails at more than a solid may have.
pub(super) fn split_long(net: &mut Patchwork, pitch: f64) -> Result<(), MeshError> {
    for _ in 0..MOST_HALVINGS {
        let long = |net: &Patchwork, [a, b]: [u32; 2]| {
            let limit = if net.chain(a, b).is_some() { LONG_SHARP } else { LONG };
            net.length([a, b]) > limit * pitch
        };
        let mut edges = net.edges();
        edges.retain(|edge| long(net, *edge));
        if edges.is_empty() {
            break;
        }
        sort_by_length(net, &mut edges);
        let gone = net.points.len() - net.vertex_count();
        for [a, b] in edges.into_iter().rev() {
            let Some(edge) = net.edge(a, b) else { continue };
            let parts = (net.length([a, b]) / pitch).round().max(2.0);
            let share = match net.chain(a, b) {
                Some(_) => (parts / 2.0).floor() / parts,
                None => 0.5,
            };
            let [p, q] = [a, b].map(|i| net.points[i as usize]);
            net.split(edge, p + (q - p) * share);
            bound_count("vertices", (net.points.len() - gone) as f64, SOLID_NODE_LIMIT)?;
        }
    }
    Ok(())
}

/// Collapses every edge that is too short, the shortest first.
pub(super) fn collapse_short(net: &mut Patchwork, original: &Original, pitch: f64) {
    let short = |net: &Patchwork, [a, b]: [u32; 2]| {
        let limit = if net.chain(a, b).is_some() { SHORT_SHARP } else { SHORT };
        net.length([a, b]) < limit * pitch
    };
    let mut edges = net.edges();
    edges.retain(|edge| short(net, *edge));
    sort_by_length(net, &mut edges);
    for [a, b] in edges {
        if net.edge(a, b).is_none() || !short(net, [a, b]) {
            continue;
        }
        for (a, b) in [(a, b), (b, a)] {
            let (Some(edge), Some(p)) = (net.edge(a, b), place(net, original, a, b)) else {
                continue;
            };
            if keeps_closed(net, edge) && fits(net, edge, p, pitch) {
                net.collapse(edge, p);
                break;
            }
        }
    }
}

/// Flips edges that are not sharp, where that is sound and `better`.
pub(super) fn flip(net: &mut Patchwork, better: fn(&Patchwork, Edge) -> bool) {
    for [a, b] in net.edges() {
        let Some(edge) = net.edge(a, b).filter(|_| net.chain(a, b).is_none()) else { continue };
        let Edge { c, d, .. } = edge;
        if c == d || net.edge(c, d).is_some() || net.valence(a) < 4 || net.valence(b) < 4 {
            continue;
        }
        let (old, new) = diamonds(net, edge);
        let sound = old.iter().all(|old| new.iter().all(|new| hardly_turns(old, new)));
        if sound && better(net, edge) {
            net.flip(edge);
        }
    }
}

/// True if a flip brings numbers of facets nearer to what they should be, and flattens none much.
pub(super) fn evens_valence(net: &Patchwork, edge: Edge) -> bool {
    let miss =
        |i: u32, change: f64| (net.valence(i) as f64 + change - net.ideal[i as usize]).powi(2);
    let Edge { a, b, c, d, .. } = edge;
    let now: f64 = [a, b, c, d].map(|i| miss(i, 0.0)).iter().sum();
    let then = miss(a, -1.0) + miss(b, -1.0) + miss(c, 1.0) + miss(d, 1.0);
    let (old, new) = diamonds(net, edge);
    then < now - 1e-9 && worst(&new) > 0.5 * worst(&old)
}

/// True if a flip makes the worse of the two facets better.
pub(super) fn widens(net: &Patchwork, edge: Edge) -> bool {
    let (old, new) = diamonds(net, edge);
    worst(&new) > worst(&old) * (1.0 + 1e-9)
}

pub(super) fn worst(pair: &[Corners; 2]) -> f64 {
    shape(&pair[0]).min(shape(&pair[1]))
}

/// Both facets at an edge, before and after a flip.
pub(super) fn diamonds(
    net: &Patchwork,
    Edge { a, b, c, d, .. }: Edge,
) -> ([Corners; 2], [Corners; 2]) {
    let at = |t: [u32; 3]| t.map(|i| net.points[i as usize]);
    ([at([a, b, c]), at([b, a, d])], [at([a, d, c]), at([d, b, c])])
}

/// Where the vertex goes that `a` and `b` become if `a` may be removed.
fn place(net: &Patchwork, original: &Original, a: u32, b: u32) -> Option<Point3<f64>> {
    let [p, q] = [a, b].map(|i| net.points[i as usize]);
    match (net.kind[a as usize], net.kind[b as usize]) {
        (Kind::Smooth, Kind::Smooth) => {
            let patch = net.patch_at(a)?;
            Some(original.on_patch(nalgebra::center(&p, &q), patch))
        }
        (Kind::Smooth, _) => Some(q),
        (Kind::Along(_), Kind::Along(_) | Kind::Fixed) => net.chain(a, b).map(|_| q),
        _ => None,
    }
}

/// The link condition: the ends have no neighbours in common but those opposite to the edge, these
/// keep three facets, and no two sharp edges become one.
fn keeps_closed(net: &Patchwork, edge: Edge) -> bool {
    let Edge { a, b, c, d, .. } = edge;
    let common = net.neighbours(a).filter(|i| net.neighbours(b).any(|j| j == *i)).count();
    let opposite = [c, d].into_iter();
    common == 2 && opposite.clone().all(|i| net.valence(i) > 3 && net.chain(a, i).is_none())
}

/// True if no edge gets too long and no facet turns or collapses.
fn fits(net: &Patchwork, Edge { a, b, .. }: Edge, p: Point3<f64>, pitch: f64) -> bool {
    let long = |i: u32| (net.points[i as usize] - p).norm() > LONG * pitch;
    let new_edges = net.neighbours(a).chain(net.neighbours(b));
    !new_edges.filter(|i| *i != a && *i != b).any(long) && may_move(net, &[a, b], p)
}

/// The shortest first; equal ones by index.
fn sort_by_length(net: &Patchwork, edges: &mut [[u32; 2]]) {
    edges.sort_by(|x, y| net.length(*x).total_cmp(&net.length(*y)).then(x.cmp(y)));
}

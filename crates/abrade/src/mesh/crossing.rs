//! Facets that meet elsewhere than in the vertices and edges they share. The tests of pairs are
//! exact; a tree of boxes finds the pairs.

use nalgebra::Point3;
use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::math::Vector as ParryVector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};

use super::error::MeshError;
use super::predicate::{Corners, on_one_side, segment_meets, side};

/// Share of its extent by which a box is widened in the tree: the tree weighs boxes by volume, and
/// those of facets in a plane of two axes have none.
const THICKNESS: f64 = 1e-3;

/// Fails if two facets cross, touch or overlap. Facets must have an area.
pub(super) fn check(vertices: &[Point3<f64>], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    check_some(vertices, triangles, &vec![true; triangles.len()])
}

/// The same for the pairs with a `chosen` facet alone.
pub(super) fn check_some(
    vertices: &[Point3<f64>],
    triangles: &[[u32; 3]],
    chosen: &[bool],
) -> Result<(), MeshError> {
    let boxes: Vec<Aabb> = triangles.iter().map(|t| box_of(&corners(vertices, t))).collect();
    let tree = tree(&boxes);
    let mut found: Option<(usize, usize)> = None;
    let mut count = 0;
    for (i, near) in boxes.iter().enumerate().filter(|(i, _)| chosen[*i]) {
        let others = tree.intersect_aabb(near).map(|j| j as usize);
        let after = others.filter(|&j| j > i || !chosen[j]);
        for j in after.filter(|&j| near.intersects(&boxes[j])) {
            if meet(vertices, &triangles[i], &triangles[j]) {
                count += 1;
                found = found.map_or(Some((i.min(j), i.max(j))), |first| {
                    Some(first.min((i.min(j), i.max(j))))
                });
            }
        }
    }
    found.map_or(Ok(()), |(first, second)| {
        let common = boxes[first].intersection(&boxes[second]).unwrap_or(boxes[first]);
        let middle = common.center();
        let at = Point3::new(middle.x, middle.y, middle.z);
        Err(MeshError::Crossing { first, second, at, others: count - 1 })
    })
}

/// A tree over the boxes of facets, each a little thicker than it is.
pub(super) fn tree(boxes: &[Aabb]) -> Bvh {
    let thick: Vec<Aabb> =
        boxes.iter().map(|b| b.loosened(THICKNESS * b.extents().max_element())).collect();
    Bvh::from_leaves(BvhBuildStrategy::Binned, &thick)
}

pub(super) fn box_of(corners: &[Point3<f64>]) -> Aabb {
    Aabb::from_points(corners.iter().map(|p| ParryVector::new(p.x, p.y, p.z)))
}

fn corners(vertices: &[Point3<f64>], triangle: &[u32; 3]) -> Corners {
    triangle.map(|i| vertices[i as usize])
}

/// True if two facets meet in more than the vertices and the edge that they share.
fn meet(vertices: &[Point3<f64>], s: &[u32; 3], t: &[u32; 3]) -> bool {
    let at = |i: u32| &vertices[i as usize];
    let shared = |i: &u32| t.contains(i);
    match s.iter().filter(|i| shared(i)).count() {
        0 => edges_meet(vertices, s, t, &[0, 1, 2], &[0, 1, 2]),
        1 => {
            // A common part beyond the common vertex ends on the edge opposite to it.
            let opposite = |a: &[u32; 3], b: &[u32; 3]| {
                a.iter().position(|i| b.contains(i)).map(|k| [(k + 1) % 3])
            };
            let (Some(of_s), Some(of_t)) = (opposite(s, t), opposite(t, s)) else { return false };
            edges_meet(vertices, s, t, &of_s, &of_t)
        }
        2 => {
            let alone = |a: &[u32; 3], b: &[u32; 3]| a.iter().copied().find(|i| !b.contains(i));
            let (Some(p), Some(q)) = (alone(s, t), alone(t, s)) else { return false };
            let mut edge = s.iter().filter(|i| shared(i)).map(|&i| at(i));
            let (Some(a), Some(b)) = (edge.next(), edge.next()) else { return false };
            side(&corners(vertices, s), at(q)) == 0 && on_one_side([a, b], at(p), at(q))
        }
        _ => true,
    }
}

/// True if one of these edges of `s` meets `t`, or one of these edges of `t` meets `s`. Edge `k` is
/// that from corner `k` to the next.
fn edges_meet(
    vertices: &[Point3<f64>],
    s: &[u32; 3],
    t: &[u32; 3],
    of_s: &[usize],
    of_t: &[usize],
) -> bool {
    // Boxes are cheap and tell apart most facets of a fan.
    let near = |plane: &[u32; 3], other: &[u32; 3], edges: &[usize]| {
        let triangle = corners(vertices, plane);
        let ends = |k: usize| [other[k], other[(k + 1) % 3]].map(|i| &vertices[i as usize]);
        edges.iter().any(|&k| boxes_meet(&triangle, ends(k)))
    };
    if !near(t, s, of_s) && !near(s, t, of_t) {
        return false;
    }
    // A shared vertex lies in both planes.
    let sides =
        |plane: &[u32; 3], other: &[u32; 3]| {
            let plane_corners = corners(vertices, plane);
            other.map(|i| {
                if plane.contains(&i) { 0 } else { side(&plane_corners, &vertices[i as usize]) }
            })
        };
    let apart = |sides: &[i8; 3], edges: &[usize]| {
        let at_edges = edges.iter().flat_map(|&k| [sides[k], sides[(k + 1) % 3]]);
        let (low, high) = at_edges.fold((1, -1), |(l, h), x| (l.min(x), h.max(x)));
        low > 0 || high < 0
    };
    let t_sides = sides(s, t);
    if apart(&t_sides, of_t) {
        return false;
    }
    let s_sides = sides(t, s);
    if apart(&s_sides, of_s) {
        return false;
    }
    let any = |triangle: &[u32; 3], other: &[u32; 3], edges: &[usize], sides: &[i8; 3]| {
        let triangle = corners(vertices, triangle);
        edges.iter().any(|&k| {
            let l = (k + 1) % 3;
            let ends = [other[k], other[l]].map(|i| &vertices[i as usize]);
            segment_meets(&triangle, ends, [sides[k], sides[l]])
        })
    };
    any(t, s, of_s, &s_sides) || any(s, t, of_t, &t_sides)
}

/// True if the boxes around a triangle and a segment have a point in common.
fn boxes_meet([a, b, c]: &Corners, [p, q]: [&Point3<f64>; 2]) -> bool {
    (0..3).all(|k| {
        p[k].min(q[k]) <= a[k].max(b[k]).max(c[k]) && a[k].min(b[k]).min(c[k]) <= p[k].max(q[k])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair(s: [[f64; 3]; 3], t: [[f64; 3]; 3]) -> bool {
        let mut vertices: Vec<Point3<f64>> = Vec::new();
        let mut index = |p: [f64; 3]| {
            let p = Point3::from(p);
            vertices.iter().position(|q| *q == p).unwrap_or_else(|| {
                vertices.push(p);
                vertices.len() - 1
            }) as u32
        };
        let facets = [s.map(&mut index), t.map(&mut index)];
        let boxes = facets.map(|t| box_of(&corners(&vertices, &t)));
        let found = check(&vertices, &facets).is_err();
        if boxes[0].intersects(&boxes[1]) {
            assert_eq!(meet(&vertices, &facets[0], &facets[1]), found);
            assert_eq!(meet(&vertices, &facets[1], &facets[0]), found, "not symmetric");
        }
        found
    }

    const O: [f64; 3] = [0.0, 0.0, 0.0];
    const X: [f64; 3] = [1.0, 0.0, 0.0];
    const Y: [f64; 3] = [0.0, 1.0, 0.0];
    const XY: [f64; 3] = [1.0, 1.0, 0.0];

    /// Fails for tests of edges in one direction only, and for open intervals.
    #[test]
    fn foreign_facets_that_meet_are_found() {
        let base = [O, X, Y];
        let at = |x: f64, y: f64, z: f64| [x, y, z];
        let through = [at(0.2, 0.2, -1.0), at(0.2, 0.3, 1.0), at(0.3, 0.2, 1.0)];
        let around = [at(-9.0, 0.1, -9.0), at(9.0, 0.1, -9.0), at(0.0, 0.1, 9.0)];
        let stands_on = [at(0.2, 0.2, 0.0), at(0.2, 0.3, 1.0), at(0.3, 0.2, 1.0)];
        let edge_on_edge = [at(0.5, -0.5, 0.0), at(0.5, 0.5, 0.0), at(0.5, 0.0, 1.0)];
        let lies_in = [at(0.2, 0.2, 0.0), at(0.3, 0.2, 0.0), at(0.2, 0.3, 0.0)];
        let holds = [at(-5.0, -5.0, 0.0), at(9.0, -5.0, 0.0), at(0.0, 9.0, 0.0)];
        let side_by_side = [at(0.25, 0.0, 0.0), at(0.75, 0.0, 0.0), at(0.5, -1.0, 0.0)];
        for other in [through, around, stands_on, edge_on_edge, lies_in, holds, side_by_side] {
            assert!(pair(base, other), "{other:?}");
        }
    }

    /// Fails for tolerances: one unit in the last place apart is apart, and touching is touching.
    #[test]
    fn neighbours_that_do_not_meet_are_left_alone() {
        let above = f64::MIN_POSITIVE.sqrt();
        let lifted = [[0.0, 0.0, above], [1.0, 0.0, above], [0.0, 1.0, above]];
        assert!(!pair([O, X, Y], lifted));
        let [a, b, c] = [[0.1, 0.2, 0.3], [1.1, 0.4, 0.2], [0.3, 0.9, 0.7]];
        let sheet = [a, b, c].map(|[x, y, z]: [f64; 3]| [x, y, z.next_up()]);
        assert!(!pair([a, b, c], sheet));
        let far = |[x, y, z]: [f64; 3]| [x + 1e9, y - 3e9, z + 7e9];
        assert!(!pair([O, X, Y].map(far), [X, XY, Y].map(far)));
        assert!(!pair([O, X, Y], [[0.5, -1.0, 1e-300], [0.5, 2.0, 1e-300], [0.5, 0.0, 1.0]]));
    }

    /// Fails for pairs with a common vertex or edge that are all trusted, or all refused.
    #[test]
    fn facets_with_a_common_vertex_or_edge_may_meet_only_there() {
        for (s, t, meets) in [
            // A common edge: side by side, at an angle, folded, folded onto a smaller one.
            ([O, X, Y], [X, XY, Y], false),
            ([O, X, Y], [O, X, [0.0, 0.5, 1e-9]], false),
            ([O, X, Y], [O, X, [0.7, 0.9, 0.0]], true),
            ([O, X, Y], [O, X, [0.3, 0.1, 0.0]], true),
            // A common vertex, in one plane: apart, edges along each other, overlapping, inside.
            ([O, X, Y], [O, [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]], false),
            ([O, X, Y], [O, [2.0, 0.0, 0.0], [1.0, -1.0, 0.0]], true),
            ([O, X, Y], [O, [2.0, 1.0, 0.0], [1.0, 2.0, 0.0]], true),
            ([O, X, Y], [O, [0.2, 0.1, 0.0], [0.1, 0.2, 0.0]], true),
            // A common vertex, at an angle: apart, passing through, an edge within.
            ([O, X, Y], [O, [0.5, 0.5, 1.0], [-0.5, -0.5, 1.0]], false),
            ([O, X, Y], [O, [0.5, 0.5, 1.0], [0.5, 0.5, -1.0]], true),
            ([O, X, Y], [O, [0.3, 0.3, 0.0], [0.3, 0.3, 1.0]], true),
            ([O, X, Y], [O, [-1.0, -1.0, 1.0], [-1.0, -1.0, -1.0]], false),
            // All vertices in common.
            ([O, X, Y], [O, Y, X], true),
        ] {
            assert_eq!(pair(s, t), meets, "{s:?} {t:?}");
        }
    }

    /// Fails for doubles that are taken for neighbours, since all their vertices coincide.
    #[test]
    fn two_shells_in_one_place_cross() {
        let mesh = super::super::TriangleMesh::cuboid(nalgebra::Vector3::repeat(1.0), 9.0);
        let mesh = mesh.expect("a cube");
        let vertices = [mesh.vertices(), mesh.vertices()].concat();
        let again = mesh.triangles().iter().map(|t| t.map(|i| i + 8));
        let triangles: Vec<_> = mesh.triangles().iter().copied().chain(again).collect();
        assert!(matches!(check(&vertices, &triangles), Err(MeshError::Crossing { .. })));
    }

    /// Fails for a search of all pairs, which is 5e9 here, and for a tree that does not part boxes
    /// without volume.
    #[test]
    fn a_plane_across_an_axis_of_many_facets_is_searched_in_n_log_n() {
        let n = 224;
        let at = |i: u32| Point3::new(7.5, f64::from(i / n), f64::from(i % n));
        let vertices: Vec<_> = (0..n * n).map(at).collect();
        let cell = |i: u32| [[i, i + 1, i + n + 1], [i, i + n + 1, i + n]];
        let cells = (0..n * (n - 1)).filter(|i| i % n != n - 1);
        let triangles: Vec<_> = cells.flat_map(cell).collect();
        assert!(triangles.len() > 99_000);
        assert_eq!(check(&vertices, &triangles), Ok(()));
    }
}

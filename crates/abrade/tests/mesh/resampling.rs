//! Resampled meshes: the same solid, evenly spread vertices, sharp edges in place.

use std::collections::BTreeSet;

use abrade::TriangleMesh;
use nalgebra::{Point3, Vector3};

use crate::cube;

/// How the facets of a mesh are shaped.
#[derive(Debug)]
struct Quality {
    /// Mean length of the edges [m].
    mean: f64,
    /// Standard deviation of the lengths over their mean [-].
    spread: f64,
    /// Smallest angle [degrees].
    least_angle: f64,
}

impl Quality {
    fn assert_even(&self, pitch: f64) {
        assert!((self.mean / pitch - 1.0).abs() < 0.15, "{pitch}: {self:?}");
        assert!(self.spread < 0.25, "{pitch}: {self:?}");
        assert!(self.least_angle > 20.0, "{pitch}: {self:?}");
    }
}

fn quality(mesh: &TriangleMesh) -> Quality {
    let at = |i: u32| mesh.vertices()[i as usize];
    let (mut lengths, mut least_angle) = (Vec::new(), f64::INFINITY);
    for t in mesh.triangles() {
        for k in 0..3 {
            let [p, q, r] = [0, 1, 2].map(|l| at(t[(k + l) % 3]));
            lengths.push((q - p).norm());
            least_angle = (q - p).angle(&(r - p)).to_degrees().min(least_angle);
        }
    }
    let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
    let squares: f64 = lengths.iter().map(|l| (l - mean).powi(2)).sum();
    Quality { mean, spread: (squares / lengths.len() as f64).sqrt() / mean, least_angle }
}

/// Ends of the edges at which facets meet at more than 30 degrees.
fn sharp_edges(mesh: &TriangleMesh) -> BTreeSet<[u32; 2]> {
    let normal = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| mesh.vertices()[i as usize]);
        (b - a).cross(&(c - a)).normalize()
    };
    let mut halves = std::collections::BTreeMap::new();
    for t in mesh.triangles() {
        for k in 0..3 {
            halves.insert([t[k], t[(k + 1) % 3]], normal(t));
        }
    }
    let sharp = |[a, b]: &[u32; 2]| a < b && halves[&[*a, *b]].dot(&halves[&[*b, *a]]) < 0.866;
    halves.keys().filter(|edge| sharp(edge)).copied().collect()
}

/// Fails for corners or edges that are rounded off, for vertices that leave their face, and for
/// edges that stay as long or as short as they were.
#[test]
fn a_cube_of_twelve_facets_stays_a_cube_at_any_pitch() {
    let (vertices, triangles) = cube([0.5; 3], 1.0);
    let coarse = TriangleMesh::new(vertices, triangles).expect("a cube");
    for pitch in [0.5, 0.23, 0.1, 0.05, 0.03] {
        let mesh = coarse.resampled(pitch).expect("a cube");
        assert!((mesh.volume() - 1.0).abs() < 1e-12, "{pitch}: {:e}", mesh.volume() - 1.0);
        assert!((mesh.area() - 6.0).abs() < 1e-12, "{pitch}: {:e}", mesh.area() - 6.0);
        for corner in coarse.vertices() {
            assert!(mesh.vertices().contains(corner), "{pitch}: {corner}");
        }
        let along = sharp_edges(&mesh);
        let length: f64 = along
            .iter()
            .map(|edge| {
                let [a, b] = edge.map(|i| mesh.vertices()[i as usize]);
                let same = (0..3).filter(|&k| a[k] == b[k] && (a[k] == 0.0 || a[k] == 1.0)).count();
                assert_eq!(same, 2, "{pitch}: {a} {b}");
                (b - a).norm()
            })
            .sum();
        assert!((length - 12.0).abs() < 1e-12, "{pitch}: {length}");
        quality(&mesh).assert_even(pitch);
    }
}

/// Fails for vertices that leave the surface, a spacing that is not that asked for, and a volume
/// that shrinks with every round.
#[test]
fn a_sphere_is_resampled_both_ways() {
    let sphere = |pitch: f64| TriangleMesh::sphere(1.0, pitch).expect("a sphere");
    for (from, to) in [(0.2, 0.1), (0.2, 0.05), (0.05, 0.1), (0.05, 0.2), (0.1, 0.1)] {
        let given = sphere(from);
        let mesh = given.resampled(to).expect("a sphere");
        let lost = 1.0 - mesh.volume() / given.volume();
        let sagitta = from * from / 4.0;
        for p in mesh.vertices() {
            assert!(p.coords.norm() <= 1.0 + 1e-12 && p.coords.norm() > 1.0 - sagitta, "{p}");
        }
        // What chords of the new pitch cut off, about pitch^2 / 4 of the volume for a hexagonal net.
        assert!(lost.abs() < 0.4 * to * to, "{from} {to}: {lost:e}");
        quality(&mesh).assert_even(to);
    }
}

/// Fails for concave edges that are not kept, and for flips across one.
#[test]
fn a_prism_with_a_notch_keeps_it() {
    let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let at = |z: f64| outline.map(|[x, y]| Point3::new(x, y, z));
    let vertices = [at(0.0), at(0.7)].concat();
    let cap = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]];
    let mut triangles: Vec<[u32; 3]> = cap.iter().map(|t| t.map(|i| i + 6)).collect();
    triangles.extend(cap.map(|[a, b, c]| [a, c, b]));
    for a in 0..6 {
        let b = (a + 1) % 6;
        triangles.extend([[a, b, b + 6], [a, b + 6, a + 6]]);
    }
    let given = TriangleMesh::new(vertices, triangles).expect("a prism");
    for pitch in [0.35, 0.1, 0.06] {
        let mesh = given.resampled(pitch).expect("a prism");
        assert!((mesh.volume() / 2.1 - 1.0).abs() < 1e-12, "{pitch}");
        let length: f64 = sharp_edges(&mesh)
            .iter()
            .map(|edge| {
                let [a, b] = edge.map(|i| mesh.vertices()[i as usize]);
                (b - a).norm()
            })
            .sum();
        assert!((length - 2.0 * 8.0 - 6.0 * 0.7).abs() < 1e-12, "{pitch}: {length}");
        quality(&mesh).assert_even(pitch);
    }
}

/// Fails for a rim that is cut short or moved off its circle, and for a wall that is drawn into
/// the end face.
#[test]
fn a_cylinder_keeps_its_rims() {
    let given = TriangleMesh::cylinder(1.0, 1.0, 0.1).expect("a cylinder");
    for pitch in [0.2, 0.07] {
        let mesh = given.resampled(pitch).expect("a cylinder");
        for [a, b] in sharp_edges(&mesh) {
            for p in [a, b].map(|i| mesh.vertices()[i as usize]) {
                assert_eq!(p.z.abs(), 0.5, "{p}");
                assert!(p.x.hypot(p.y) > 1.0 - 0.1f64.powi(2) / 8.0 - 1e-4, "{p}");
            }
        }
        assert!((mesh.volume() / given.volume() - 1.0).abs() < 0.4 * pitch * pitch);
        quality(&mesh).assert_even(pitch);
    }
}

/// Fails for short edges that are collapsed though they join two sharp edges.
#[test]
fn a_plate_thinner_than_the_pitch_stays_flat() {
    let half = Vector3::new(1.0, 1.0, 0.002);
    let given = TriangleMesh::cuboid(half, 3.0).expect("a plate");
    let mesh = given.resampled(0.05).expect("a plate");
    assert!(mesh.vertices().iter().all(|p| p.z.abs() == 0.002));
    assert!((mesh.volume() / 0.016 - 1.0).abs() < 1e-12);
    assert!((quality(&mesh).mean / 0.05 - 1.0).abs() < 0.15);
}

/// Fails for vertices drawn to the nearest part of the surface: the middle of a chord of the outer
/// side is nearer to the bore.
#[test]
fn a_pipe_thinner_than_its_chords_keeps_both_sides() {
    let given = TriangleMesh::tube(0.994, 1.0, 0.5, 0.05).expect("a pipe");
    let mesh = given.resampled(0.15).expect("a pipe");
    assert!((mesh.volume() / given.volume() - 1.0).abs() < 0.02);
    let wall = mesh.vertices().iter().filter(|p| p.z.abs() < 0.25);
    let (outer, inner): (Vec<&Point3<f64>>, Vec<_>) = wall.partition(|p| p.x.hypot(p.y) > 0.997);
    assert!((outer.len() as f64 / inner.len() as f64 - 1.0).abs() < 0.05);
}

/// Fails for slivers that are kept because each change makes one of them worse: the bottom of a
/// height field is a fan of them.
#[test]
fn a_fan_of_slivers_becomes_an_even_net() {
    let height =
        |i: i32, j: i32| 0.5 + 0.1 * (f64::from(i) * 0.6).sin() * (f64::from(j) * 0.45).cos();
    let heights: Vec<Vec<f64>> = (0..40).map(|j| (0..30).map(|i| height(i, j)).collect()).collect();
    let given = TriangleMesh::height_field(&heights, 0.05, 0.05, 0.0).expect("ground");
    for pitch in [0.1, 0.025] {
        let mesh = given.resampled(pitch).expect("ground");
        quality(&mesh).assert_even(pitch);
        assert!((mesh.volume() / given.volume() - 1.0).abs() < 0.1 * pitch * pitch, "{pitch}");
    }
}

/// Fails for a result that is handed out unchecked.
#[test]
fn what_cannot_be_resampled_is_refused_with_the_pitch() {
    let given = TriangleMesh::cylinder(1.0, 3.0, 0.78).expect("a cylinder");
    let message = given.resampled(2.0).expect_err("too coarse").to_string();
    assert!(
        message.starts_with("the mesh cannot be resampled at a pitch of 2 m: facets "),
        "{message}"
    );
}

/// Fails for a spike whose area tells of few vertices and whose edges take millions: it would take all memory.
#[test]
fn a_needle_is_refused_before_it_takes_all_memory() {
    let points = [[0.0, 0.0, 0.0], [1e-3, 0.0, 0.0], [0.0, 1e-3, 0.0], [0.0, 0.0, 1e3]];
    let facets = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let needle = TriangleMesh::new(points.map(Point3::from).to_vec(), facets).expect("a needle");
    let message = needle.resampled(1e-2).expect_err("too fine").to_string();
    assert_eq!(message, "the mesh would have 5.000e6 vertices, at most 5.0e6 are allowed");
}

/// Fails for an order that depends on addresses or hashes.
#[test]
fn resampling_twice_gives_the_same_bits() {
    let mesh = TriangleMesh::capsule(0.3, 0.4, 0.08).expect("a capsule");
    assert_eq!(mesh.resampled(0.06), mesh.resampled(0.06));
}

/// Fails for a resampling that depends on where the mesh is, and for one that eats small solids.
#[test]
fn a_pitch_beyond_the_solid_leaves_its_corners() {
    let (vertices, triangles) = cube([1e4, -2e4, 3e4], 1.0);
    let given = TriangleMesh::new(vertices, triangles).expect("a cube");
    let mesh = given.resampled(50.0).expect("a cube");
    assert_eq!(mesh.vertices(), given.vertices());
    assert!((mesh.volume() - 1.0).abs() < 1e-9);
    let fine = given.resampled(0.1).expect("a cube");
    assert!((fine.volume() - 1.0).abs() < 1e-9);
    assert!((quality(&fine).mean / 0.1 - 1.0).abs() < 0.15);
    let message = given.resampled(1e-9).expect_err("too fine").to_string();
    assert_eq!(message, "the mesh would have 6.928e18 vertices, at most 5.0e6 are allowed");
    let half = Vector3::new(0.5, 0.5, 0.5);
    assert!(TriangleMesh::cuboid(half, 0.1).expect("a cube").resampled(f64::NAN).is_err());
}

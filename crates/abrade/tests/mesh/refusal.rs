//! Each fault of a mesh is found, and said with its place.

use abrade::{MeshError, TriangleMesh};
use nalgebra::Point3;

use crate::{Parts, cube, joined, reversed};

fn tetrahedron() -> Parts {
    let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    (vertices.map(Point3::from).to_vec(), triangles)
}

fn refused((vertices, triangles): Parts) -> String {
    TriangleMesh::new(vertices, triangles).expect_err("a faulty mesh").to_string()
}

/// Fails for checks that refuse what is sound.
#[test]
fn a_tetrahedron_is_taken_as_it_is() {
    let (vertices, triangles) = tetrahedron();
    let mesh = TriangleMesh::new(vertices.clone(), triangles.clone()).expect("sound");
    assert_eq!((mesh.vertices(), mesh.triangles()), (&vertices[..], &triangles[..]));
    assert!((mesh.volume() - 1.0 / 6.0).abs() < 1e-16);
    assert!((mesh.area() - 1.5 - 0.75f64.sqrt()).abs() < 1e-15);
    assert_eq!(mesh.bounds(), [Point3::origin(), Point3::new(1.0, 1.0, 1.0)]);
}

/// Fails for a check that is left out, comes too late to speak, or names the wrong place.
#[test]
fn every_fault_is_named_with_its_place() {
    let but = |change: fn(&mut Parts)| {
        let mut parts = tetrahedron();
        change(&mut parts);
        refused(parts)
    };
    assert_eq!(but(|(_, t)| t.truncate(3)), "the mesh has 3 facets, a closed one has at least 4");
    assert_eq!(
        but(|(v, _)| v[3].y = f64::NAN),
        "vertex 3 is at (0, NaN, 1) m, which is not finite"
    );
    assert_eq!(but(|(_, t)| t[2][1] = 4), "facet 2 names vertex 4, the mesh has 4 vertices");
    assert_eq!(
        but(|(v, _)| v[3] = Point3::new(0.5, 0.0, 0.0)),
        "facet 1 at (0, 0, 0) m has no area: its corners lie on one line"
    );
    assert_eq!(
        but(|(_, t)| t[3] = [1, 1, 2]),
        "facet 3 at (1, 0, 0) m has no area: its corners lie on one line"
    );
    assert_eq!(
        but(|(v, _)| v.extend([Point3::new(2e-5, 0.0, 0.0); 2])),
        "vertex 4 at (2e-5, 0, 0) m belongs to no facet, and 1 more vertex belongs to none"
    );
    assert_eq!(
        but(|(v, t)| {
            v.push(Point3::new(1.0, 1.0, 1.0));
            t[3] = [1, 2, 4];
        }),
        "the mesh is open: the edge from (1, 0, 0) to (0, 0, 1) m borders on one facet only, \
         and 3 more edges do"
    );
    assert_eq!(
        but(|(v, t)| {
            v.push(Point3::new(1.0, 1.0, 1.0));
            t.push([1, 2, 4]);
        }),
        "the edge from (1, 0, 0) to (0, 1, 0) m borders on 3 facets, where two are allowed"
    );
    assert_eq!(
        but(|(_, t)| t[3].swap(0, 1)),
        "the two facets at the edge from (1, 0, 0) to (0, 1, 0) m are turned against each other, \
         and 2 more pairs are"
    );
    assert_eq!(
        but(|(v, _)| v[1].x = 1e200),
        "the mesh is too large to compute with: its area or volume is not finite"
    );
    assert_eq!(
        refused(reversed(tetrahedron())),
        "the shell of 4 facets at (0, 0, 0) m is inside out"
    );
}

/// Fails for a check by edges alone: each edge of two solids that touch in a point is sound.
#[test]
fn solids_that_share_a_vertex_are_pinched() {
    let (mut vertices, mut triangles) = tetrahedron();
    let (more, facets) = reversed(tetrahedron());
    vertices.extend(more[1..].iter().map(|p| Point3::from(-p.coords)));
    triangles.extend(facets.iter().map(|t| t.map(|i| if i == 0 { 0 } else { i + 3 })));
    assert_eq!(
        refused((vertices, triangles)),
        "the mesh is pinched at (0, 0, 0) m: the facets there form 2 separate fans"
    );
}

/// Fails for an orientation check that does not count how shells lie inside each other.
#[test]
fn a_shell_inside_another_must_be_a_cavity() {
    let solid = || cube([0.0; 3], 1.0);
    let inner = || cube([0.1, 0.0, 0.0], 0.5);
    let (vertices, triangles) = joined(solid(), reversed(inner()));
    let hollow = TriangleMesh::new(vertices, triangles).expect("a hollow cube");
    assert!((hollow.volume() - 0.875).abs() < 1e-15);
    assert_eq!(
        refused(joined(solid(), inner())),
        "the shell of 12 facets at (-0.15, -0.25, -0.25) m lies inside 1 other shell: it must be \
         a cavity, but faces outward"
    );
    let core = || cube([0.2, 0.0, 0.0], 0.1);
    let (vertices, triangles) = joined(joined(solid(), reversed(inner())), core());
    let kernel = TriangleMesh::new(vertices, triangles).expect("a kernel in a hollow");
    assert!((kernel.volume() - 0.876).abs() < 1e-15);
    let message = refused(joined(joined(solid(), reversed(inner())), reversed(core())));
    assert!(message.ends_with("m is inside out: it lies inside 2 other shells"), "{message}");
}

/// Fails for a nesting that stops at boxes: a solid in the notch of another is not inside it.
#[test]
fn a_solid_beside_another_in_its_box_is_a_solid() {
    let (mut vertices, triangles) = tetrahedron();
    vertices.iter_mut().for_each(|p| p.coords *= 10.0);
    let (vertices, triangles) = joined((vertices, triangles), cube([8.0; 3], 1.0));
    assert!(TriangleMesh::new(vertices, triangles).is_ok());
}

/// Fails for a check that sees open edges only: these two cubes are closed, but lie in each other.
#[test]
fn cubes_that_reach_into_each_other_cross() {
    let (vertices, triangles) = joined(cube([0.0; 3], 1.0), cube([0.6, 0.3, 0.1], 1.0));
    let error = TriangleMesh::new(vertices, triangles).expect_err("crossing");
    let MeshError::Crossing { first, second, at, others } = error.clone() else {
        panic!("{error}");
    };
    assert!(first < 12 && second >= 12 && others > 0, "{error}");
    assert!((at - Point3::new(0.3, 0.15, 0.05)).amax() <= 0.5, "{error}");
    let message = error.to_string();
    assert!(message.starts_with(&format!("facets {first} and {second} cross or touch near (")));
    assert!(message.ends_with(&format!("m, and {others} more pairs of facets do")), "{message}");
}

/// Fails for normals that are rounding errors: the areas around the apex of a wedge that winds once
/// around it cancel, since they are those of its outer side, a ribbon that closes in plan.
#[test]
fn a_vertex_whose_areas_cancel_has_no_normal() {
    let at = |k: usize, shift: f64| {
        let (sin, cos) = (k as f64 * std::f64::consts::FRAC_PI_3).sin_cos();
        Point3::new(cos, sin, (k as f64 - 3.0) / 6.0 + shift)
    };
    let mut vertices = vec![Point3::origin()];
    vertices.extend((0..7).flat_map(|k| [at(k, -0.1), at(k, 0.1)]));
    let mut triangles = vec![[0, 1, 2], [0, 14, 13]];
    for low in [1, 3, 5, 7, 9, 11] {
        let [a, b, c, d] = [low, low + 2, low + 1, low + 3];
        triangles.extend([[a, b, d], [a, d, c], [0, b, a], [0, c, d]]);
    }
    assert_eq!(
        refused((vertices, triangles)),
        "the vertex at (0, 0, 0) m has no normal: the areas of its facets cancel"
    );
}

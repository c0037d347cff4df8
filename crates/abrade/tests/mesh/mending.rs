//! What is mended, and what is left to be refused.

use abrade::{Mended, TriangleMesh};
use nalgebra::Point3;

use crate::{Parts, cube, joined, reversed};

/// Three vertices of its own for each facet, as an STL file has them.
fn soup((vertices, triangles): Parts) -> Parts {
    let corners = triangles.iter().flatten().map(|&i| vertices[i as usize]).collect();
    let facets = (0..triangles.len() as u32).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect();
    (corners, facets)
}

/// Fails for a weld that misses, and for a facet that is left turned against its neighbours.
#[test]
fn a_soup_of_a_cube_with_one_face_turned_becomes_a_cube() {
    let (vertices, mut triangles) = cube([3.0, 0.0, 0.0], 2.0);
    let face = |t: &[u32; 3]| t.iter().all(|&i| vertices[i as usize].x == 4.0);
    triangles.iter_mut().filter(|t| face(t)).for_each(|t| t.swap(0, 1));
    let (vertices, triangles) = soup((vertices, triangles));
    let (mesh, mended) = TriangleMesh::mend(vertices, triangles).expect("a cube");
    assert_eq!(mesh.vertices().len(), 8);
    assert!((mesh.volume() - 8.0).abs() < 1e-14);
    let told = Mended { welded: 28, turned_facets: 2, ..Mended::default() };
    assert_eq!(mended, told);
    assert_eq!(mended.to_string(), "28 vertices were welded and 2 facets were turned");
}

/// Fails for a weld by equal bits, by cells without their neighbours, or with a reach of its own.
#[test]
fn vertices_closer_than_a_billionth_of_the_extent_are_welded() {
    for (jitter, welds) in [(0.0, true), (4e-10, true), (3e-9, false)] {
        let (mut vertices, mut triangles) = soup(cube([0.0; 3], 1.0));
        for (i, p) in vertices.iter_mut().enumerate() {
            p[i % 3] += jitter * [1.0, -1.0][i / 3 % 2];
        }
        vertices.push(Point3::new(0.3, 0.3, 0.3));
        triangles.push([0, 0, 1]);
        let mended = TriangleMesh::mend(vertices, triangles);
        assert_eq!(mended.is_ok(), welds, "{jitter:e} {:?}", mended.err());
        if let Ok((_, mended)) = mended {
            let told =
                Mended { welded: 28, dropped_facets: 1, dropped_vertices: 1, turned_facets: 0 };
            assert_eq!(mended, told, "{jitter:e}");
        }
    }
}

/// Fails for a turn by the sign of the whole volume, and for one that makes a cavity solid.
#[test]
fn shells_are_turned_each_by_where_it_lies() {
    let solid = || cube([0.0; 3], 1.0);
    let inner = || cube([0.1, 0.0, 0.0], 0.5);
    let beside = || cube([3.0, 0.0, 0.0], 1.0);
    for (parts, turned) in [
        (joined(joined(solid(), inner()), beside()), 12),
        (joined(joined(reversed(solid()), reversed(inner())), beside()), 12),
        (joined(joined(solid(), reversed(inner())), reversed(beside())), 12),
        (joined(joined(solid(), reversed(inner())), beside()), 0),
    ] {
        let (mesh, mended) = TriangleMesh::mend(parts.0, parts.1).expect("sound");
        assert_eq!(mended.turned_facets, turned);
        assert!((mesh.volume() - 1.875).abs() < 1e-14);
    }
    let (vertices, triangles) = solid();
    let (_, mended) = TriangleMesh::mend(vertices, triangles).expect("sound");
    assert_eq!(mended.to_string(), "nothing had to be mended");
}

/// Fails for a mend that closes holes by inventing facets, or hides what it could not do.
#[test]
fn an_open_soup_stays_open() {
    let (vertices, mut triangles) = cube([0.0; 3], 1.0);
    triangles.pop();
    let (vertices, triangles) = soup((vertices, triangles));
    let message = TriangleMesh::mend(vertices, triangles).expect_err("open").to_string();
    assert!(message.starts_with("the mesh is open: the edge from ("), "{message}");
    assert!(message.ends_with("and 2 more edges do"), "{message}");
}

//! The files taken apart by hand: offsets from the XML, blocks through zlib.

use std::fs;
use std::io::Read;

use nalgebra::{Translation3, UnitQuaternion};

use super::*;

/// Four nodes of a unit square, one of them worn.
fn square() -> Nodes {
    let at = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
    Nodes {
        rest_position: at.map(|(x, y)| Point3::new(x, y, 0.0)).to_vec(),
        normal: vec![Vector3::z(); 4],
        rest_area: vec![0.25; 4],
        depth: vec![0.0, 0.0, 0.125, 0.0],
    }
}

/// The 8-byte words of the array `name` inside `element` of a file.
fn words(file: &[u8], element: &str, name: &str) -> Vec<[u8; 8]> {
    let mark = b"<AppendedData encoding=\"raw\">\n_";
    let start = file.windows(mark.len()).position(|w| w == mark).expect("data") + mark.len();
    let head = std::str::from_utf8(&file[..start]).expect("the head is text");
    let element = &head[head.find(&format!("<{element}")).expect("the element")..];
    let array = &element[element.find(&format!("Name=\"{name}\"")).expect("the array")..];
    let offset = array.split("offset=\"").nth(1).and_then(|t| t.split('"').next());
    let offset: usize = offset.expect("an offset").parse().expect("a number");
    let data = &file[start + offset..];
    let word = |i: usize| data[8 * i..8 * i + 8].try_into().expect("eight bytes");
    let size = |i: usize| u64::from_le_bytes(word(i)) as usize;
    let (blocks, block, last) = (size(0), size(1), size(2));
    let (mut at, mut bytes) = (8 * (3 + blocks), Vec::new());
    for i in 0..blocks {
        let mut plain = Vec::new();
        let packed = &data[at..at + size(3 + i)];
        flate2::read::ZlibDecoder::new(packed).read_to_end(&mut plain).expect("zlib");
        let whole = i + 1 < blocks || last == 0;
        assert_eq!(plain.len(), if whole { block } else { last });
        bytes.extend(plain);
        at += size(3 + i);
    }
    bytes.chunks_exact(8).map(|word| word.try_into().expect("eight bytes")).collect()
}

fn floats(file: &[u8], element: &str, name: &str) -> Vec<f64> {
    words(file, element, name).into_iter().map(f64::from_le_bytes).collect()
}

fn integers(file: &[u8], element: &str, name: &str) -> Vec<i64> {
    words(file, element, name).into_iter().map(i64::from_le_bytes).collect()
}

fn written(nodes: &Nodes, pose: &Isometry3<f64>, triangles: &[[u32; 3]]) -> Vec<u8> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("surface_0000.vtp");
    write_surface(&path, nodes, None, pose, triangles).expect("writable");
    fs::read(&path).expect("there")
}

/// A program that wrote rest positions, forgot the pose, turned the points but not the normals or
/// swapped two arrays' offsets would fail here.
#[test]
fn a_surface_reads_back_where_it_lies() {
    let quarter = std::f64::consts::FRAC_PI_2;
    let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), quarter);
    let pose = Isometry3::from_parts(Translation3::new(10.0, 0.0, 0.0), turn);
    let file = written(&square(), &pose, &[[0, 1, 2], [2, 1, 3]]);
    assert_eq!(floats(&file, "PointData", "depth_m"), [0.0, 0.0, 0.125, 0.0]);
    assert_eq!(floats(&file, "PointData", "rest_area_m2"), [0.25; 4]);
    // x turns to -z and z to x: the worn node went 0.125 along -x.
    let points = floats(&file, "Points", "Points");
    let expected = [10.0, 0.0, 0.0, 10.0, 0.0, -1.0, 9.875, 1.0, 0.0, 10.0, 1.0, -1.0];
    assert_eq!(points.len(), expected.len());
    for (found, wanted) in points.iter().zip(expected) {
        approx::assert_abs_diff_eq!(*found, wanted, epsilon = 1e-14);
    }
    let normals = floats(&file, "PointData", "normal");
    approx::assert_abs_diff_eq!(normals[0], 1.0, epsilon = 1e-15);
    assert_eq!(integers(&file, "Polys", "connectivity"), [0, 1, 2, 2, 1, 3]);
    assert_eq!(integers(&file, "Polys", "offsets"), [3, 6]);
    assert!(integers(&file, "Verts", "offsets").is_empty());
}

/// A program that wrote a column that nobody gave, or one of another length, would fail here.
#[test]
fn hardness_is_a_column_where_it_is_given() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("surface_0000.vtp");
    let (nodes, pose) = (square(), Isometry3::identity());
    write_surface(&path, &nodes, Some(&[1e9, 2e9, 3e9, 4e9]), &pose, &[]).expect("writable");
    let file = fs::read(&path).expect("there");
    assert_eq!(floats(&file, "PointData", "hardness_Pa"), [1e9, 2e9, 3e9, 4e9]);
    let without = written(&nodes, &pose, &[]);
    assert!(!String::from_utf8_lossy(&without).contains("hardness_Pa"));
    let short = write_surface(&path, &nodes, Some(&[1e9]), &pose, &[]);
    assert!(matches!(short, Err(ReportError::Columns { column: "hardness", found: 1, .. })));
}

/// A program that wrote no cells would show an empty window.
#[test]
fn without_triangles_every_node_is_a_vertex() {
    let file = written(&square(), &Isometry3::identity(), &[]);
    assert_eq!(integers(&file, "Verts", "connectivity"), [0, 1, 2, 3]);
    assert_eq!(integers(&file, "Verts", "offsets"), [1, 2, 3, 4]);
    assert!(integers(&file, "Polys", "connectivity").is_empty());
}

/// A program that lost bytes where one block ends and the next begins, or wrote the size of a
/// full last block instead of 0, would fail at one of these lengths.
#[test]
fn arrays_longer_than_a_block_are_whole() {
    let per_block = block::BLOCK / 8;
    for count in [per_block, per_block + 1, 3 * per_block] {
        let nodes = Nodes {
            rest_position: vec![Point3::origin(); count],
            normal: vec![Vector3::z(); count],
            rest_area: vec![1.0; count],
            depth: (0..count).map(|i| i as f64).collect(),
        };
        let file = written(&nodes, &Isometry3::identity(), &[]);
        assert_eq!(floats(&file, "PointData", "depth_m"), nodes.depth, "{count} nodes");
    }
}

/// A program that wrote the index as it is would crash the reader.
#[test]
fn a_triangle_without_its_node_is_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("surface_0000.vtp");
    let error = write_surface(&path, &square(), None, &Isometry3::identity(), &[[0, 1, 4]]);
    let expected = ReportError::Triangle { triangle: 0, point: 4, points: 4 };
    assert_eq!(error.expect_err("four nodes").to_string(), expected.to_string());
    assert!(!path.exists());
}

/// A program that counted each body's corners from zero would draw the second body's faces on the
/// first; one that left out the spin would show a rolling ball as sliding.
#[test]
fn bodies_share_a_file_and_keep_their_faces() {
    let points = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| Point3::new(x, y, 0.0));
    let mesh = Mesh { points: points.to_vec(), triangles: vec![[0, 1, 2]] };
    let still = State::at(Point3::origin());
    let rolling = State {
        velocity: Vector3::x(),
        spin: Vector3::z() * 2.0,
        ..State::at(Point3::new(0.0, 0.0, 5.0))
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("bodies_0000.vtp");
    let bodies = [still, rolling].map(|state| (mesh.clone(), state));
    let placed: Vec<_> = bodies.iter().map(|(mesh, state)| PlacedBody { mesh, state }).collect();
    write_bodies(&path, &placed).expect("writable");
    let file = fs::read(&path).expect("there");
    assert_eq!(integers(&file, "Polys", "connectivity"), [0, 1, 2, 3, 4, 5]);
    assert_eq!(floats(&file, "PointData", "body"), [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
    // spin 2 about z at (1, 0) adds 2 along y; at (0, 1) it adds -2 along x.
    let velocity = floats(&file, "PointData", "velocity_m_s");
    assert_eq!(velocity[9..], [1.0, 0.0, 0.0, 1.0, 2.0, 0.0, -1.0, 0.0, 0.0]);
}

/// Fails for lines that join other points than those they come from, or an array cut short.
#[test]
fn joined_points_are_lines() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("links_0000.vtp");
    let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 2.0]];
    let stress = [1.0, 1.0, -3.0, -3.0];
    write_plane(&path, &points, &[("normal_Pa", &stress)], true).expect("a file");
    let file = fs::read(&path).expect("the file");
    assert_eq!(integers(&file, "Lines", "connectivity"), [0, 1, 2, 3]);
    assert_eq!(integers(&file, "Lines", "offsets"), [2, 4]);
    assert_eq!(floats(&file, "PointData", "normal_Pa"), stress);
    let short = write_plane(&path, &points, &[("normal_Pa", &stress[..3])], true);
    assert!(matches!(short, Err(ReportError::Columns { found: 3, depths: 4, .. })));
}

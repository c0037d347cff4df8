//! What was written comes back to the last bit, and nothing else passes for it.

use abrade::Nodes;
use nalgebra::Isometry3;
use tempfile::TempDir;

use super::super::write_surface;
use super::*;

/// More nodes than a block has words, so that arrays have a whole and a short block.
const COUNT: usize = BLOCK / 8 + 5;

fn nodes() -> Nodes {
    let number = |i: usize| (i as f64).sin() / 3.0;
    Nodes {
        rest_position: (0..COUNT).map(|i| Point3::new(number(i), number(i + 1), 0.0)).collect(),
        normal: vec![Vector3::z(); COUNT],
        rest_area: vec![0.25; COUNT],
        depth: (0..COUNT).map(|i| number(i).abs()).collect(),
    }
}

fn written(triangles: &[[u32; 3]]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("surface_0000.vtp");
    let pose = Isometry3::identity();
    write_surface(&path, &nodes(), None, &pose, triangles).expect("writable");
    (folder, path)
}

/// Fails for a reader that loses what lies behind the first block, mixes up two arrays, or takes
/// whole numbers for floating ones.
#[test]
fn a_surface_comes_back_to_the_last_bit() {
    let triangles = [[0, 1, 2], [2, 1, COUNT as u32 - 1]];
    let (_folder, path) = written(&triangles);
    let (file, nodes) = (VtpFile::open(&path).expect("readable"), nodes());
    assert_eq!(file.len(), COUNT);
    assert_eq!(file.scalars("depth_m").expect("there"), nodes.depth);
    assert_eq!(file.vectors("normal").expect("there"), nodes.normal);
    assert_eq!(file.triangles().expect("there"), triangles);
    let points: Vec<_> = (0..COUNT).map(|i| nodes.position(i)).collect();
    assert_eq!(file.points().expect("there"), points);
}

/// Fails for a comparison of sizes alone, or of what stands behind the array.
#[test]
fn the_same_triangles_are_told_from_others() {
    let (_a, one) = written(&[[0, 1, 2]]);
    let (_b, same) = written(&[[0, 1, 2]]);
    let (_c, other) = written(&[[0, 2, 1]]);
    let [one, same, other] = [one, same, other].map(|path| VtpFile::open(&path).expect("readable"));
    assert!(one.has_triangles_of(&same));
    assert!(!one.has_triangles_of(&other));
}

/// Fails for a reader that panics on a damaged file, or gives numbers that nobody wrote where a
/// block is cut off. Bytes are changed all over the file, and it is cut everywhere before the last
/// arrays, which hold no more than counts.
#[test]
fn a_damaged_file_is_an_error_or_reads_as_long_as_it_was() {
    let (folder, path) = written(&[[0, 1, 2]]);
    let whole = fs::read(&path).expect("there");
    let damaged = folder.path().join("damaged.vtp");
    let places = (0..2500).step_by(17).chain((2500..whole.len()).step_by(whole.len() / 30));
    for place in places {
        let mut changed = whole.clone();
        changed[place] ^= 0x5a;
        fs::write(&damaged, &changed).expect("writable");
        if let Ok(file) = VtpFile::open(&damaged) {
            let lengths = [
                file.points().map(|points| points.len()),
                file.scalars("depth_m").map(|depths| depths.len()),
                file.vectors("normal").map(|normals| normals.len()),
            ];
            assert!(lengths.iter().flatten().all(|length| *length == file.len()));
            let triangles = file.triangles().unwrap_or_default();
            assert!(triangles.iter().flatten().all(|corner| (*corner as usize) < file.len()));
        }
    }
    for length in (0..whole.len() - 200).step_by(whole.len() / 40) {
        fs::write(&damaged, &whole[..length]).expect("writable");
        let read = VtpFile::open(&damaged).and_then(|file| {
            file.triangles()?;
            file.points()?;
            file.vectors("normal")
        });
        assert!(read.is_err(), "{length} of {} bytes", whole.len());
    }
}

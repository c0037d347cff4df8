//! Mesh files of worn surfaces, for programs that print, mill or simulate: binary STL and OBJ. The
//! nodes stand where they are now, in the surface's own frame [m].

use std::io::Write;
use std::path::Path;

use abrade::Nodes;
use nalgebra::{Point3, Vector3};

use crate::atomic::PartialFile;
use crate::error::{FileAction, ReportError};
use crate::vtp::check_columns;
use crate::vtp::poly::check_triangles;

/// Head of an STL file; it must not begin like a text.
const STL_HEAD: &[u8] = b"binary, worn surface, lengths in m";
/// Length of the head [bytes].
const STL_HEAD_LENGTH: usize = 80;

/// Writes a binary STL file. Its numbers have seven digits: corners are rounded by up to 6e-8 of
/// their distance from the origin.
///
/// # Errors
/// Columns of different length, a triangle that names no node, or the file system refuses.
pub fn write_stl(path: &Path, nodes: &Nodes, triangles: &[[u32; 3]]) -> Result<(), ReportError> {
    write(path, nodes, triangles, |file, corners| {
        let mut head = STL_HEAD.to_vec();
        head.resize(STL_HEAD_LENGTH, b' ');
        file.write_all(&head)?;
        file.write_all(&(triangles.len() as u32).to_le_bytes())?;
        for triangle in triangles {
            let [a, b, c] = triangle.map(|i| corners[i as usize]);
            let normal = (b - a).cross(&(c - a));
            let normal = normal.try_normalize(0.0).unwrap_or_default();
            let vectors: [Vector3<f64>; 4] = [normal, a.coords, b.coords, c.coords];
            for number in vectors.iter().flat_map(|vector| vector.iter()) {
                file.write_all(&(*number as f32).to_le_bytes())?;
            }
            file.write_all(&[0, 0])?;
        }
        Ok(())
    })
}

/// Writes an OBJ file, its corners in the order of the nodes and to every digit.
///
/// # Errors
/// Columns of different length, a triangle that names no node, or the file system refuses.
pub fn write_obj(path: &Path, nodes: &Nodes, triangles: &[[u32; 3]]) -> Result<(), ReportError> {
    write(path, nodes, triangles, |file, corners| {
        writeln!(file, "# worn surface, lengths in m")?;
        for corner in corners {
            writeln!(file, "v {} {} {}", corner.x, corner.y, corner.z)?;
        }
        for [a, b, c] in triangles {
            writeln!(file, "f {} {} {}", u64::from(*a) + 1, u64::from(*b) + 1, u64::from(*c) + 1)?;
        }
        Ok(())
    })
}

/// Checks the mesh, then lets `content` write it.
fn write(
    path: &Path,
    nodes: &Nodes,
    triangles: &[[u32; 3]],
    content: impl FnOnce(&mut PartialFile, &[Point3<f64>]) -> std::io::Result<()>,
) -> Result<(), ReportError> {
    check_columns(nodes)?;
    check_triangles(triangles, nodes.len())?;
    let corners: Vec<_> = (0..nodes.len()).map(|i| nodes.position(i)).collect();
    let mut file = PartialFile::create(path)?;
    content(&mut file, &corners).map_err(ReportError::file(FileAction::Write, path))?;
    file.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tetrahedron, its node at the origin worn by an eighth along minus (1, 1, 1).
    fn worn() -> (Nodes, Vec<[u32; 3]>) {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let nodes = Nodes {
            rest_position: corners.map(Point3::from).to_vec(),
            normal: vec![Vector3::new(-1.0, -1.0, -1.0).normalize(); 4],
            rest_area: vec![0.5; 4],
            depth: vec![3f64.sqrt() / 8.0, 0.0, 0.0, 0.0],
        };
        (nodes, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    }

    /// Fails for undeformed corners, for facets turned inside out, and for a wrong record length.
    #[test]
    fn stl_holds_the_worn_facets() {
        let (nodes, triangles) = worn();
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("worn.stl");
        write_stl(&path, &nodes, &triangles).expect("writable");
        let bytes = std::fs::read(&path).expect("there");
        assert_eq!(bytes.len(), 84 + 4 * 50);
        assert_eq!(bytes[80..84], 4_u32.to_le_bytes());
        let float = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().expect("four"));
        let vector = |at: usize| Vector3::new(float(at), float(at + 4), float(at + 8));
        assert_eq!(vector(84 + 12), Vector3::repeat(0.125));
        let mut volume = 0.0;
        for facet in 0..4 {
            let at = 84 + 50 * facet;
            let [normal, a, b, c] = [0, 12, 24, 36].map(|shift| vector(at + shift));
            assert!((b - a).cross(&(c - a)).normalize().dot(&normal) > 0.9999);
            volume += a.dot(&b.cross(&c)) / 6.0;
        }
        assert!((volume - (1.0 - 3.0 / 8.0) / 6.0).abs() < 1e-6, "{volume}");
    }

    /// Fails for indices that count from zero, and for numbers cut to a few digits.
    #[test]
    fn obj_counts_from_one_and_keeps_every_digit() {
        let (mut nodes, triangles) = worn();
        nodes.rest_position[1].x = 1.0 / 3.0;
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("worn.obj");
        write_obj(&path, &nodes, &triangles).expect("writable");
        let text = std::fs::read_to_string(&path).expect("there");
        let lines: Vec<_> = text.lines().skip(1).collect();
        assert_eq!(lines[1], "v 0.3333333333333333 0 0");
        assert_eq!(lines[4], "f 1 3 2");
        assert_eq!(lines.len(), 8);
    }

    /// Fails for a writer that leaves half a file, or panics.
    #[test]
    fn a_facet_without_a_node_is_refused() {
        let (nodes, _) = worn();
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("worn.stl");
        let error = write_stl(&path, &nodes, &[[0, 1, 4]]).expect_err("no node 4");
        assert!(matches!(error, ReportError::Triangle { point: 4, .. }), "{error}");
        assert!(!path.exists());
    }
}

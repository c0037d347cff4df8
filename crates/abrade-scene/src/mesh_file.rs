//! Mesh files: STL, text or binary, and OBJ, to corners and facets as the file has them. Whether
//! they bound anything is not asked here.

use std::collections::HashMap;
use std::io::Cursor;
use std::path::Path;

use nalgebra::Point3;
use thiserror::Error;

use crate::unread::unread;

/// A mesh file that cannot be read.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("the mesh `{file}` cannot be read: {reason}")]
pub(crate) struct FileTrouble {
    /// The file, as the scene names it.
    pub(crate) file: String,
    /// Why not.
    pub(crate) reason: String,
}

/// Corners [m] and facets. Corners that agree to the last bit are one.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Facets {
    pub(crate) vertices: Vec<Point3<f64>>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

/// Size of a binary STL file without facets, and of a facet [bytes].
const STL_SIZE: [usize; 2] = [84, 50];

/// Reads `file`, which lies in `folder`; its lengths are multiplied by `scale`. A name that ends
/// in `.obj` is an OBJ file, any other one STL.
pub(crate) fn read(folder: &Path, file: &str, scale: f64) -> Result<Facets, FileTrouble> {
    let fail = |reason: String| FileTrouble { file: file.to_owned(), reason };
    let path = folder.join(file);
    let bytes = std::fs::read(&path).map_err(|error| fail(unread(&path, &error)))?;
    let is_obj = Path::new(file).extension().is_some_and(|end| end.eq_ignore_ascii_case("obj"));
    if is_obj { obj(&bytes, scale) } else { stl(bytes, scale) }.map_err(fail)
}

/// The facets of an STL file.
fn stl(mut bytes: Vec<u8>, scale: f64) -> Result<Facets, String> {
    if is_binary_stl(&bytes) {
        // Some programs begin the head of a binary file like a text.
        bytes[..5].fill(b' ');
    } else if !bytes.trim_ascii_start().starts_with(b"solid") {
        return Err("it is neither a text nor a binary STL file".into());
    }
    let mut cursor = Cursor::new(bytes);
    let triangles = stl_io::create_stl_reader(&mut cursor).map_err(|error| error.to_string())?;
    let mut index = Index::default();
    for triangle in triangles {
        let corners = triangle.map_err(|error| error.to_string())?.vertices;
        index.add(corners.map(|corner| corner.0.map(|x| f64::from(x) * scale)))?;
    }
    Ok(index.facets)
}

/// True when the file is as long as a binary STL file says that it is.
fn is_binary_stl(bytes: &[u8]) -> bool {
    let [head, facet] = STL_SIZE;
    let count = bytes.get(80..head).and_then(|count| count.try_into().ok());
    let count = count.map(|count: [u8; 4]| u32::from_le_bytes(count) as usize);
    count.is_some_and(|count| bytes.len() == head + facet * count)
}

/// The facets of an OBJ file, of all its objects and groups; polygons are cut into fans.
fn obj(bytes: &[u8], scale: f64) -> Result<Facets, String> {
    let options = tobj::LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..Default::default()
    };
    let no_materials = |_: &Path| Ok(Default::default());
    let read = tobj::load_obj_buf(&mut Cursor::new(bytes), &options, no_materials);
    let (models, _) = read.map_err(|error| error.to_string())?;
    let mut index = Index::default();
    for tobj::Model { mesh, .. } in models {
        let corner = |i: &u32| -> Option<[f64; 3]> {
            let at = 3 * *i as usize;
            let place = mesh.positions.get(at..at + 3)?;
            Some([place[0] * scale, place[1] * scale, place[2] * scale])
        };
        for triangle in mesh.indices.as_chunks::<3>().0 {
            let [a, b, c] = triangle.each_ref().map(corner);
            let (Some(a), Some(b), Some(c)) = (a, b, c) else {
                return Err("a facet names a vertex that is not there".into());
            };
            index.add([a, b, c])?;
        }
    }
    Ok(index.facets)
}

/// Numbers corners in the order of their first use.
#[derive(Default)]
struct Index {
    facets: Facets,
    /// Only looked up, so its order reaches no number.
    known: HashMap<[u64; 3], u32>,
}

impl Index {
    fn add(&mut self, corners: [[f64; 3]; 3]) -> Result<(), String> {
        let mut numbers = [0; 3];
        for (number, corner) in numbers.iter_mut().zip(corners) {
            // Minus zero is zero.
            let corner = corner.map(|x| x + 0.0);
            let next = self.facets.vertices.len();
            let next = u32::try_from(next).map_err(|_| "it has too many vertices".to_owned())?;
            *number = *self.known.entry(corner.map(f64::to_bits)).or_insert(next);
            if *number == next {
                self.facets.vertices.push(Point3::from(corner));
            }
        }
        self.facets.triangles.push(numbers);
        Ok(())
    }
}

#[cfg(test)]
mod tests;

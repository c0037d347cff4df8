//! The file: an XML head that tells name, type and offset of each array, then the arrays.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

use nalgebra::{Point3, Vector3};

use super::block::Blocks;
use crate::atomic::PartialFile;
use crate::error::{FileAction, ReportError};

/// An array, already compressed.
pub(super) struct Array {
    name: &'static str,
    kind: &'static str,
    components: usize,
    bytes: Vec<u8>,
}

/// Where an array belongs.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    PointData,
    /// Point data that a viewer colours by at first.
    Scalars,
    /// Point data that a viewer lights by.
    Normals,
    Points,
    Verts,
    Lines,
    Polys,
}

/// A file to be.
pub(super) struct PolyData {
    points: usize,
    verts: usize,
    lines: usize,
    polys: usize,
    arrays: Vec<(Place, Array)>,
}

impl Array {
    pub(super) fn f64(name: &'static str, values: impl Iterator<Item = f64>) -> Self {
        Self::new(name, "Float64", 1, values.map(f64::to_le_bytes))
    }

    pub(super) fn vectors(name: &'static str, values: impl Iterator<Item = Vector3<f64>>) -> Self {
        let components = values.flat_map(|v| [v.x, v.y, v.z]);
        Self::new(name, "Float64", 3, components.map(f64::to_le_bytes))
    }

    fn indices(name: &'static str, values: impl Iterator<Item = i64>) -> Self {
        Self::new(name, "Int64", 1, values.map(i64::to_le_bytes))
    }

    fn new(
        name: &'static str,
        kind: &'static str,
        components: usize,
        values: impl Iterator<Item = [u8; 8]>,
    ) -> Self {
        let mut blocks = Blocks::new();
        values.for_each(|value| blocks.push(&value));
        Self { name, kind, components, bytes: blocks.finish() }
    }
}

impl PolyData {
    pub(super) fn new(points: usize) -> Self {
        Self { points, verts: 0, lines: 0, polys: 0, arrays: Vec::new() }
    }

    pub(super) fn add(&mut self, place: Place, array: Array) {
        self.arrays.push((place, array));
    }

    pub(super) fn points(&mut self, points: impl Iterator<Item = Point3<f64>>) {
        self.add(Place::Points, Array::vectors("Points", points.map(|p| p.coords)));
    }

    /// The triangles, or every point as a vertex if there are none.
    pub(super) fn faces(&mut self, triangles: &[[u32; 3]]) -> Result<(), ReportError> {
        check_triangles(triangles, self.points)?;
        let corners = triangles.iter().flatten().map(|&corner| i64::from(corner));
        let ends = (1..=triangles.len() as i64).map(|cell| 3 * cell);
        self.polys = triangles.len();
        self.add(Place::Polys, Array::indices("connectivity", corners));
        self.add(Place::Polys, Array::indices("offsets", ends));
        self.verts = if triangles.is_empty() { self.points } else { 0 };
        let verts = self.verts as i64;
        self.add(Place::Verts, Array::indices("connectivity", 0..verts));
        self.add(Place::Verts, Array::indices("offsets", 1..verts + 1));
        Ok(())
    }

    /// Lines from each even point to the next one.
    pub(super) fn segments(&mut self) {
        self.lines = self.points / 2;
        let lines = self.lines as i64;
        self.add(Place::Lines, Array::indices("connectivity", 0..2 * lines));
        self.add(Place::Lines, Array::indices("offsets", (1..=lines).map(|line| 2 * line)));
    }

    pub(super) fn write(&self, path: &Path) -> Result<(), ReportError> {
        let mut file = PartialFile::create(path)?;
        let (head, order) = self.head();
        let parts = std::iter::once(head.as_bytes()).chain(order.iter().map(|a| &a.bytes[..]));
        for part in parts.chain([FOOT]) {
            file.write_all(part).map_err(ReportError::file(FileAction::Write, path))?;
        }
        file.finish()
    }

    /// The XML up to the first raw byte, and the arrays in the order of their offsets.
    fn head(&self) -> (String, Vec<&Array>) {
        let mut text = String::from(HEAD);
        let (mut offset, mut order) = (0, Vec::new());
        let piece = format!(
            "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" \
             NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n",
            self.points, self.verts, self.lines, self.polys
        );
        text.push_str(&piece);
        for (element, places) in ELEMENTS {
            let _ = writeln!(text, "<{element}{}>", self.attributes(element));
            for (_, array) in self.arrays.iter().filter(|(place, _)| places.contains(place)) {
                let Array { name, kind, components, bytes } = array;
                let _ = writeln!(
                    text,
                    "<DataArray type=\"{kind}\" Name=\"{name}\" \
                     NumberOfComponents=\"{components}\" format=\"appended\" offset=\"{offset}\"/>"
                );
                offset += bytes.len();
                order.push(array);
            }
            let _ = writeln!(text, "</{element}>");
        }
        text.push_str("</Piece>\n</PolyData>\n");
        text.push_str(DATA);
        (text, order)
    }

    fn attributes(&self, element: &str) -> String {
        let named = |wanted: Place, key: &str| {
            let found = self.arrays.iter().find(|(place, _)| *place == wanted);
            found.map_or(String::new(), |(_, array)| format!(" {key}=\"{}\"", array.name))
        };
        match element {
            "PointData" => named(Place::Scalars, "Scalars") + &named(Place::Normals, "Normals"),
            _ => String::new(),
        }
    }
}

/// An error unless every corner is one of `points` points.
pub(crate) fn check_triangles(triangles: &[[u32; 3]], points: usize) -> Result<(), ReportError> {
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&point) = corners.iter().find(|&&corner| corner as usize >= points) {
            return Err(ReportError::Triangle { triangle, point, points });
        }
    }
    Ok(())
}

const HEAD: &str = "<?xml version=\"1.0\"?>\n\
    <VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" \
    header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<PolyData>\n";

/// What the arrays stand behind.
pub(super) const DATA: &str = "<AppendedData encoding=\"raw\">\n_";

const FOOT: &[u8] = b"\n</AppendedData>\n</VTKFile>\n";

const ELEMENTS: [(&str, &[Place]); 5] = [
    ("PointData", &[Place::PointData, Place::Scalars, Place::Normals]),
    ("Points", &[Place::Points]),
    ("Verts", &[Place::Verts]),
    ("Lines", &[Place::Lines]),
    ("Polys", &[Place::Polys]),
];

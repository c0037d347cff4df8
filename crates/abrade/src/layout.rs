//! How the nodes of a surface are laid out: as a lattice, or as the vertices of a mesh.

use std::sync::Arc;

use nalgebra::Point3;

use crate::error::ParameterError;
use crate::grid::Grid;
use crate::medial::reaches;
use crate::nodes::Nodes;
use crate::solid::Solid;
use crate::surface::NODE_LIMIT;

/// A flat strip of nodes in close-packed rows along y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HexStrip {
    /// Extent along x [m].
    pub length: f64,
    /// Extent along y [m].
    pub width: f64,
    /// Distance of neighbours [m].
    pub pitch: f64,
    /// a_s [m2]; sqrt(3)/2 pitch^2 unless given.
    pub rest_area: Option<f64>,
}

/// The layout of a surface.
#[derive(Clone, Debug)]
pub(crate) enum Layout {
    /// Columns and rows of a flat strip; node `row` of a column is the column's number times the
    /// rows, plus `row`; odd columns are shifted by half a pitch.
    Strip { columns_rows: [usize; 2] },
    /// The vertices of a closed mesh.
    Mesh(Arc<Meshed>),
}

/// The solid that a mesh bounds.
#[derive(Debug)]
pub(crate) struct Meshed {
    pub solid: Solid,
    /// Per node: how far below it the material is its own [m].
    pub reach: Vec<f64>,
    /// Radius of a ball of its volume [m].
    pub size: f64,
}

impl HexStrip {
    /// A strip of the given extent [m] on which a node stands for length * width / nodes; the
    /// pitch follows from that area.
    pub fn with_nodes(length: f64, width: f64, nodes: f64) -> Self {
        let area = length * width / nodes;
        let pitch = (2.0 * area / 3f64.sqrt()).sqrt();
        Self { length, width, pitch, rest_area: Some(area) }
    }

    /// Numbers of columns (along x) and rows (along y).
    pub fn columns_rows(&self) -> [f64; 2] {
        [(self.length / (self.pitch * 0.75f64.sqrt())).round(), (self.width / self.pitch).round()]
    }

    /// Undeformed positions of the nodes in the strip's frame, in the order of their numbers [m];
    /// none for a strip without nodes, or with more than [`NODE_LIMIT`](crate::NODE_LIMIT).
    pub fn positions(&self) -> Vec<Point3<f64>> {
        let [columns, rows] = self.columns_rows();
        let has_nodes = columns >= 1.0 && rows >= 1.0 && columns * rows <= NODE_LIMIT;
        let whole = has_nodes && self.check().is_empty();
        if whole {
            strip_positions([columns as usize, rows as usize], self.pitch)
        } else {
            Vec::new()
        }
    }

    /// Every value outside its range.
    pub fn check(&self) -> Vec<ParameterError> {
        let area = self.rest_area.and_then(|a| ParameterError::positive("rest_area", a));
        [("length", self.length), ("width", self.width), ("pitch", self.pitch)]
            .into_iter()
            .filter_map(|(field, value)| ParameterError::positive(field, value))
            .chain(area)
            .collect()
    }
}

impl Layout {
    /// The layout of a mesh with these `nodes`; None when the facets bound no solid.
    pub(crate) fn mesh(nodes: &Nodes, triangles: &[[u32; 3]]) -> Option<Self> {
        let solid = Solid::new(&nodes.rest_position, triangles)?;
        let reach = reaches(nodes, solid.extent());
        let size = solid.size();
        Some(Self::Mesh(Arc::new(Meshed { solid, reach, size })))
    }

    /// Calls `visit` with every triangle whose undeformed place meets the box; of a strip with those
    /// that have their first node in it.
    pub(crate) fn visit_facets(
        &self,
        grid: &Grid,
        low: &Point3<f64>,
        high: &Point3<f64>,
        mut visit: impl FnMut([u32; 3]),
    ) {
        match self {
            Self::Strip { columns_rows: [columns, rows] } => grid.visit(low, high, |i| {
                let (column, row) = (i / rows, i % rows);
                if column + 1 < *columns && row + 1 < *rows {
                    strip_cell(*rows, column, row).into_iter().for_each(&mut visit);
                }
            }),
            Self::Mesh(meshed) => meshed.solid.visit_facets(low, high, visit),
        }
    }

    /// Triangles between neighbouring nodes.
    pub(crate) fn triangles(&self) -> Vec<[u32; 3]> {
        match self {
            Self::Strip { columns_rows } => strip_triangles(*columns_rows),
            Self::Mesh(meshed) => meshed.solid.triangles().to_vec(),
        }
    }
}

fn strip_triangles([columns, rows]: [usize; 2]) -> Vec<[u32; 3]> {
    let mut triangles = Vec::with_capacity(2 * columns * rows);
    for column in 0..columns.saturating_sub(1) {
        for row in 0..rows.saturating_sub(1) {
            triangles.extend(strip_cell(rows, column, row));
        }
    }
    triangles
}

/// The two triangles between a node of a strip, the next of its column, and those beside them in
/// the next column.
fn strip_cell(rows: usize, column: usize, row: usize) -> [[u32; 3]; 2] {
    let [a, b] = [column * rows + row, (column + 1) * rows + row].map(|i| i as u32);
    match column % 2 {
        0 => [[a, b, a + 1], [b, b + 1, a + 1]],
        _ => [[a, b, b + 1], [a, b + 1, a + 1]],
    }
}

/// Distance of neighbouring columns of a strip [m].
pub(crate) fn across(pitch: f64) -> f64 {
    pitch * 0.75f64.sqrt()
}

/// Undeformed positions about the node nearest the middle, column by column [m].
pub(crate) fn strip_positions([columns, rows]: [usize; 2], pitch: f64) -> Vec<Point3<f64>> {
    let across = across(pitch);
    let site = |column: usize, row: usize| {
        let shift = 0.5 * (column % 2) as f64;
        Point3::new(column as f64 * across, (row as f64 + shift) * pitch, 0.0)
    };
    let middle = site((columns - 1) / 2, (rows - 1) / 2).coords;
    let mut positions = Vec::with_capacity(columns * rows);
    for column in 0..columns {
        positions.extend((0..rows).map(|row| site(column, row) - middle));
    }
    positions
}

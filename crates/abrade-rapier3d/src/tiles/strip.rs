//! A strip in tiles, each a height field. Its cells are the distance of columns wide and half a
//! pitch long, which is where the nodes of every other column lie.

use std::ops::Range;

use abrade::Surface;
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use rapier::geometry::SharedShape;
use rapier::parry::utils::Array2;

use crate::scalar;

/// Cells of a tile along x and along y: as many nodes either way. It shows one more of its
/// neighbours' on every side: poses of tiles are rounded, and there would be gaps.
const CELLS: [usize; 2] = [32, 64];

/// A strip's lattice, cut along x and y.
pub(crate) struct StripTiles {
    columns: usize,
    rows: usize,
    pitch: f64,
    /// The first node, undeformed, in the surface's frame [m].
    first: Vector3<f64>,
}

impl StripTiles {
    pub fn of(surface: &Surface) -> Option<Self> {
        let [columns, rows] = surface.columns_rows()?;
        let first = surface.nodes().rest_position[0].coords;
        Some(Self { columns, rows, pitch: surface.pitch(), first })
    }

    /// Cells of the whole strip along x and y.
    fn cells(&self) -> [usize; 2] {
        [self.columns.max(2) - 1, 2 * self.rows - 1]
    }

    /// Extents of a cell along x and y [m].
    fn cell(&self) -> [f64; 2] {
        [0.75f64.sqrt() * self.pitch, 0.5 * self.pitch]
    }

    /// Tiles along x and y.
    fn counts(&self) -> [usize; 2] {
        let cells = self.cells();
        [0, 1].map(|axis| cells[axis].div_ceil(CELLS[axis]))
    }

    pub fn count(&self) -> usize {
        self.counts().iter().product()
    }

    /// The cells of a tile along x and y.
    fn range(&self, tile: usize) -> [Range<usize>; 2] {
        let ([_, along_y], cells) = (self.counts(), self.cells());
        let at = [tile / along_y, tile % along_y];
        [0, 1].map(|axis| {
            let from = at[axis] * CELLS[axis];
            from.saturating_sub(1)..(from + CELLS[axis] + 1).min(cells[axis])
        })
    }

    /// The tiles in which a height depends on node `i`: its own, and those half a pitch beside it.
    pub fn with(&self, i: usize) -> impl Iterator<Item = usize> {
        let counts = self.counts();
        let (column, place) = (i / self.rows, self.place_of(i / self.rows, i % self.rows));
        let [x, y] = [[column, column], [place.saturating_sub(1), place + 1]];
        let tiles = |axis: usize, [low, high]: [usize; 2]| {
            let before = low.saturating_sub(CELLS[axis] + 1).div_ceil(CELLS[axis]);
            before..((high + 1) / CELLS[axis]).min(counts[axis] - 1) + 1
        };
        let along_y = tiles(1, y);
        tiles(0, x).flat_map(move |x| along_y.clone().map(move |y| x * counts[1] + y))
    }

    /// Half pitches from the strip's lower edge to a node.
    fn place_of(&self, column: usize, row: usize) -> usize {
        2 * row + column % 2
    }

    /// Where a tile's height field lies in the surface's frame. Its own x, y, z are the surface's
    /// y, z, x.
    pub fn place(&self, tile: usize) -> Isometry3<f64> {
        let (range, [x, y]) = (self.range(tile), self.cell());
        let [across, along] = range.map(|cells| 0.5 * (cells.start + cells.end) as f64);
        // A lone column stands in the middle of its cell.
        let across = if self.columns > 1 { across * x } else { 0.0 };
        let to_middle = Vector3::new(across, along * y, 0.0);
        let turn = UnitQuaternion::new_unchecked(Quaternion::new(0.5, 0.5, 0.5, 0.5));
        Isometry3::from_parts(Translation3::from(self.first + to_middle), turn)
    }

    /// A height field through every node of a tile, which have sunk by `depth` [m]; between two
    /// nodes of a column it has their mean.
    pub fn shape(&self, tile: usize, depth: &[f64]) -> SharedShape {
        let ([across, along], [x, y]) = (self.range(tile), self.cell());
        let [wide, long] = [&across, &along].map(|cells| cells.len());
        let mut heights = Vec::with_capacity((wide + 1) * (long + 1));
        for place in along.start..=along.end {
            for column in across.start..=across.end {
                heights.push(scalar::narrow(-self.depth_at(column, place, depth)));
            }
        }
        let extent = Vector3::new(long as f64 * y, 1.0, wide as f64 * x);
        let heights = Array2::new(wide + 1, long + 1, heights);
        SharedShape::heightfield(heights, scalar::to_vector(&extent))
    }

    /// Depth at a corner of cells [m].
    fn depth_at(&self, column: usize, place: usize, depth: &[f64]) -> f64 {
        let column = column.min(self.columns - 1);
        let shift = column % 2;
        let [below, above] = [place, place + 1].map(|place| place.saturating_sub(shift) / 2);
        let of = |row: usize| depth[column * self.rows + row.min(self.rows - 1)];
        0.5 * (of(below) + of(above))
    }
}

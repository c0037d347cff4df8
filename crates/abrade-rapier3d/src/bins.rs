//! Boxes sorted into the cells of a uniform grid, layer by layer (slices of time, say): finds those
//! of a layer that may meet a box without asking all of them.

use nalgebra::{Point3, Vector3};

use crate::extent::Extent;

/// Cells of a layer per box that is expected.
const CELLS_PER_BOX: usize = 1;
/// Growth of a cell that proves too small.
const GROWTH: f64 = 1.5;
/// Cells beyond which a box is kept aside and found by every search, in whatever layer.
const WIDE: usize = 64;

/// A grid of cells over a region; what lies outside of it belongs to the cells at its border.
pub(crate) struct Bins {
    low: Point3<f64>,
    cell: f64,
    dims: [usize; 3],
    /// Layer after layer.
    cells: Vec<Vec<u32>>,
    wide: Vec<u32>,
}

impl Default for Bins {
    fn default() -> Self {
        let (low, dims) = (Point3::origin(), [1; 3]);
        Self { low, cell: 1.0, dims, cells: vec![Vec::new()], wide: Vec::new() }
    }
}

impl Bins {
    /// Empties the bins and lays them over `region` in so many layers, for about `count` boxes.
    pub fn lay(&mut self, region: &Extent, layers: usize, count: usize) {
        let size = region.high - region.low;
        let most = CELLS_PER_BOX * count + 1;
        let mut cell = size.amax() / most as f64;
        let dims = |cell: f64| -> [usize; 3] {
            std::array::from_fn(|a| ((size[a] / cell) as usize).saturating_add(1).min(most))
        };
        if !(cell > 0.0 && cell.is_finite()) {
            cell = f64::MAX;
        }
        while dims(cell).iter().map(|&n| n as f64).product::<f64>() > most as f64 {
            cell *= GROWTH;
        }
        (self.low, self.cell, self.dims) = (region.low, cell, dims(cell));
        self.cells.iter_mut().for_each(Vec::clear);
        self.wide.clear();
        let cells = layers * self.layer();
        if self.cells.len() < cells {
            self.cells.resize_with(cells, Vec::new);
        }
    }

    /// Sorts in the box of `item` in a layer, on top of other boxes of the same item.
    pub fn insert(&mut self, layer: usize, extent: &Extent, item: u32) {
        let [from, to] = self.range(extent);
        let count: usize = (0..3).map(|a| to[a] - from[a] + 1).product();
        if count > WIDE {
            if self.wide.last() != Some(&item) {
                self.wide.push(item);
            }
            return;
        }
        let first = layer * self.layer();
        for cell in cells(self.dims, from, to) {
            self.cells[first + cell].push(item);
        }
    }

    /// Items whose boxes in a layer may meet `extent`, in an order that depends on the boxes alone; some of
    /// them more than once.
    pub fn find(&self, layer: usize, extent: &Extent) -> impl Iterator<Item = u32> + '_ {
        let [from, to] = self.range(extent);
        let first = layer * self.layer();
        let cells = cells(self.dims, from, to).flat_map(move |cell| &self.cells[first + cell]);
        cells.chain(&self.wide).copied()
    }

    /// Cells of a layer.
    fn layer(&self) -> usize {
        self.dims.iter().product()
    }

    fn range(&self, extent: &Extent) -> [[usize; 3]; 2] {
        // Saturating float-to-int conversion clamps what lies outside.
        let index = |at: &Vector3<f64>| -> [usize; 3] {
            std::array::from_fn(|a| ((at[a] / self.cell) as usize).min(self.dims[a] - 1))
        };
        [index(&(extent.low - self.low)), index(&(extent.high - self.low))]
    }
}

fn cells(dims: [usize; 3], from: [usize; 3], to: [usize; 3]) -> impl Iterator<Item = usize> {
    (from[2]..=to[2]).flat_map(move |k| {
        (from[1]..=to[1]).flat_map(move |j| {
            let row = (k * dims[1] + j) * dims[0];
            row + from[0]..=row + to[0]
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a search that misses a box across cells, outside the region or of any size, and
    /// for one that asks every box, or those of another layer.
    #[test]
    fn a_search_finds_every_box_that_meets_and_few_others() {
        let around = |x: f64, y: f64, half: f64| {
            let at = Point3::new(x, y, 0.0);
            Extent { low: at, high: at }.grown(half)
        };
        let mut boxes: Vec<Extent> = (0..400)
            .map(|i| around(f64::from(i % 20), f64::from(i / 20), 0.1 + 0.01 * f64::from(i % 7)))
            .collect();
        boxes.push(around(3.0, 3.0, 50.0));
        boxes.push(around(-40.0, 60.0, 0.5));
        let mut bins = Bins::default();
        bins.lay(&Extent { low: Point3::origin(), high: Point3::new(19.0, 19.0, 0.0) }, 2, 400);
        for (i, extent) in boxes.iter().enumerate() {
            bins.insert(1, extent, i as u32);
        }
        for query in [around(5.2, 7.9, 0.3), around(0.0, 19.0, 2.0), around(-40.0, 60.0, 0.1)] {
            let found: Vec<u32> = bins.find(1, &query).collect();
            let meets = |i: &u32| boxes[*i as usize].meets(&query);
            let met: Vec<u32> = (0..boxes.len() as u32).filter(meets).collect();
            assert!(met.iter().all(|i| found.contains(i)), "{met:?} not in {found:?}");
            assert!(found.len() < 60 && bins.find(0, &query).count() == 1);
        }
    }
}

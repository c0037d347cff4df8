//! A uniform grid over the undeformed nodes: finds the candidates near a body at a cost that
//! depends on the body, not on the surface.

use nalgebra::Point3;

/// Cells of nodes, in compressed rows: `items[start[c]..start[c + 1]]` are the nodes of cell `c`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Grid {
    low: Point3<f64>,
    high: Point3<f64>,
    cell: f64,
    dims: [usize; 3],
    start: Vec<u32>,
    items: Vec<u32>,
}

impl Grid {
    /// A grid whose cells are `cell` [m] wide, or wider if there would be more cells than nodes.
    pub(crate) fn new(points: &[Point3<f64>], cell: f64) -> Self {
        let mut low = points[0];
        let mut high = points[0];
        for p in points {
            low = low.inf(p);
            high = high.sup(p);
        }
        let mut cell = cell;
        let mut dims = dims_of(&low, &high, cell);
        let cells = |dims: &[usize; 3]| dims.iter().map(|&n| n as f64).product::<f64>();
        while cells(&dims) > points.len().max(8) as f64 {
            cell *= 1.5;
            dims = dims_of(&low, &high, cell);
        }
        let mut grid = Self { low, high, cell, dims, start: Vec::new(), items: Vec::new() };
        grid.sort(points);
        grid
    }

    /// Counting sort of the nodes into the cells.
    fn sort(&mut self, points: &[Point3<f64>]) {
        let cells = self.dims.iter().product::<usize>();
        let mut start = vec![0u32; cells + 1];
        for p in points {
            start[self.cell_of(p) + 1] += 1;
        }
        for c in 0..cells {
            start[c + 1] += start[c];
        }
        let mut next = start.clone();
        let mut items = vec![0u32; points.len()];
        for (i, p) in points.iter().enumerate() {
            let slot = &mut next[self.cell_of(p)];
            items[*slot as usize] = i as u32;
            *slot += 1;
        }
        self.start = start;
        self.items = items;
    }

    /// Corners of the box around all nodes.
    pub(crate) fn bounds(&self) -> [Point3<f64>; 2] {
        [self.low, self.high]
    }

    /// Calls `visit` with every node in a cell that meets the box, cell by cell.
    pub(crate) fn visit(
        &self,
        low: &Point3<f64>,
        high: &Point3<f64>,
        mut visit: impl FnMut(usize),
    ) {
        if (0..3).any(|a| high[a] < self.low[a] || low[a] > self.high[a]) {
            return;
        }
        let (from, to) = (self.index_of(low), self.index_of(high));
        for k in from[2]..=to[2] {
            for j in from[1]..=to[1] {
                let row = (k * self.dims[1] + j) * self.dims[0];
                let items =
                    self.start[row + from[0]] as usize..self.start[row + to[0] + 1] as usize;
                self.items[items].iter().for_each(|&i| visit(i as usize));
            }
        }
    }

    fn index_of(&self, p: &Point3<f64>) -> [usize; 3] {
        // Saturating float-to-int conversion clamps what lies outside the grid.
        std::array::from_fn(|a| (((p[a] - self.low[a]) / self.cell) as usize).min(self.dims[a] - 1))
    }

    fn cell_of(&self, p: &Point3<f64>) -> usize {
        let [i, j, k] = self.index_of(p);
        (k * self.dims[1] + j) * self.dims[0] + i
    }
}

fn dims_of(low: &Point3<f64>, high: &Point3<f64>, cell: f64) -> [usize; 3] {
    std::array::from_fn(|a| (((high[a] - low[a]) / cell) as usize).saturating_add(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a grid that drops nodes at its upper edge or visits cells outside the box.
    #[test]
    fn a_box_finds_exactly_the_cells_it_meets() {
        let points: Vec<_> =
            (0..400).map(|i| Point3::new((i % 20) as f64, (i / 20) as f64, 0.0)).collect();
        let grid = Grid::new(&points, 2.0);
        let mut found = Vec::new();
        grid.visit(&Point3::new(-9.0, -9.0, -1.0), &Point3::new(99.0, 99.0, 1.0), |i| {
            found.push(i)
        });
        found.sort();
        assert_eq!(found, (0..400).collect::<Vec<_>>());
        let mut near = Vec::new();
        grid.visit(&Point3::new(18.5, 18.5, 0.0), &Point3::new(30.0, 30.0, 0.0), |i| near.push(i));
        near.sort();
        assert_eq!(near, vec![378, 379, 398, 399]);
        grid.visit(&Point3::new(0.0, 0.0, 0.1), &Point3::new(9.0, 9.0, 0.2), |_| panic!("no node"));
    }
}

//! Finds the undeformed nodes near a body at a cost that depends on the body, not on the surface:
//! those of a mesh in a uniform grid, those of a flat strip by their numbers.

use nalgebra::Point3;

use crate::layout::across;

/// The nodes by their places.
#[derive(Clone, Debug, Default)]
pub(crate) struct Grid {
    low: Point3<f64>,
    high: Point3<f64>,
    places: Places,
}

#[derive(Clone, Debug)]
enum Places {
    /// Cells of nodes, in compressed rows: `items[start[c]..start[c + 1]]` are the nodes of cell `c`.
    Cells { cell: f64, dims: [usize; 3], start: Vec<u32>, items: Vec<u32> },
    /// Columns along y, as those of [`Layout::Strip`](crate::layout::Layout), `across` [m] apart.
    Strip { columns_rows: [usize; 2], pitch: f64, across: f64 },
}

impl Default for Places {
    fn default() -> Self {
        Self::Cells { cell: 0.0, dims: [0; 3], start: Vec::new(), items: Vec::new() }
    }
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
        let index = |p: &Point3<f64>| cell_at(dims, index_of(p, &low, cell, dims));
        let [start, items] = sort(points, dims.iter().product(), index);
        Self { low, high, places: Places::Cells { cell, dims, start, items } }
    }

    /// The grid of a strip whose nodes are at `points`.
    pub(crate) fn strip(points: &[Point3<f64>], columns_rows: [usize; 2], pitch: f64) -> Self {
        let [columns, rows] = columns_rows;
        let last = points[points.len() - 1];
        // The odd columns lie half a pitch further.
        let top = points[if columns > 1 { 2 * rows } else { rows } - 1];
        let high = Point3::new(last.x, top.y, last.z);
        let places = Places::Strip { columns_rows, pitch, across: across(pitch) };
        Self { low: points[0], high, places }
    }

    /// Corners of the box around all nodes.
    pub(crate) fn bounds(&self) -> [Point3<f64>; 2] {
        [self.low, self.high]
    }

    /// Calls `visit` with every node in the box, and with some beside it, in an order of their own.
    pub(crate) fn visit(
        &self,
        low: &Point3<f64>,
        high: &Point3<f64>,
        mut visit: impl FnMut(usize),
    ) {
        if (0..3).any(|a| high[a] < self.low[a] || low[a] > self.high[a]) {
            return;
        }
        match &self.places {
            Places::Cells { cell, dims, start, items } => {
                let index = |p| index_of(p, &self.low, *cell, *dims);
                let (from, to) = (index(low), index(high));
                for k in from[2]..=to[2] {
                    for j in from[1]..=to[1] {
                        let row = cell_at(*dims, [0, j, k]);
                        let row = start[row + from[0]] as usize..start[row + to[0] + 1] as usize;
                        items[row].iter().for_each(|&i| visit(i as usize));
                    }
                }
            }
            Places::Strip { columns_rows: [columns, rows], pitch, across } => {
                for column in between(low.x - self.low.x, high.x - self.low.x, *across, *columns) {
                    let y = self.low.y + 0.5 * (column % 2) as f64 * pitch;
                    for row in between(low.y - y, high.y - y, *pitch, *rows) {
                        visit(column * rows + row);
                    }
                }
            }
        }
    }
}

/// Numbers, of the first `count`, of the multiples of `pitch` from `low` to `high`, and of their
/// neighbours. Saturating float-to-int conversion clamps what lies outside.
fn between(low: f64, high: f64, pitch: f64, count: usize) -> std::ops::RangeInclusive<usize> {
    let last = count - 1;
    ((low / pitch) as usize).min(last)..=((high / pitch).ceil() as usize).min(last)
}

/// Counting sort of the nodes into `cells`, in compressed rows.
fn sort(
    points: &[Point3<f64>],
    cells: usize,
    index: impl Fn(&Point3<f64>) -> usize,
) -> [Vec<u32>; 2] {
    let mut start = vec![0u32; cells + 1];
    for p in points {
        start[index(p) + 1] += 1;
    }
    for c in 0..cells {
        start[c + 1] += start[c];
    }
    let mut next = start.clone();
    let mut items = vec![0u32; points.len()];
    for (i, p) in points.iter().enumerate() {
        let slot = &mut next[index(p)];
        items[*slot as usize] = i as u32;
        *slot += 1;
    }
    [start, items]
}

fn index_of(p: &Point3<f64>, low: &Point3<f64>, cell: f64, dims: [usize; 3]) -> [usize; 3] {
    // Saturating float-to-int conversion clamps what lies outside the grid.
    std::array::from_fn(|a| (((p[a] - low[a]) / cell) as usize).min(dims[a] - 1))
}

fn cell_at(dims: [usize; 3], [i, j, k]: [usize; 3]) -> usize {
    (k * dims[1] + j) * dims[0] + i
}

fn dims_of(low: &Point3<f64>, high: &Point3<f64>, cell: f64) -> [usize; 3] {
    std::array::from_fn(|a| (((high[a] - low[a]) / cell) as usize).saturating_add(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::strip_positions;

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

    /// Fails for a strip's grid that misses a node of the box, as of a shifted column, or one at its
    /// edge, or that looks at more of it than a ring around the box.
    #[test]
    fn a_box_finds_every_node_of_a_strip_in_it_and_few_beside_it() {
        let pitch = 0.3;
        for columns_rows in [[1, 1], [1, 7], [2, 3], [9, 1], [12, 11]] {
            let points = strip_positions(columns_rows, pitch);
            let grid = Grid::strip(&points, columns_rows, pitch);
            let [low, high] = grid.bounds();
            assert!(points.iter().all(|p| p.inf(&low) == low && p.sup(&high) == high));
            let far = Point3::new(9.0, 9.0, 9.0);
            for (from, to) in points.iter().flat_map(|a| points.iter().map(move |b| (a, b))) {
                let inside = |p: &Point3<f64>| {
                    (from.x..=to.x).contains(&p.x) && (from.y..=to.y).contains(&p.y)
                };
                let mut found = Vec::new();
                grid.visit(from, to, |i| found.push(i));
                let expected: Vec<_> = (0..points.len()).filter(|&i| inside(&points[i])).collect();
                assert!(expected.iter().all(|i| found.contains(i)), "{from} {to}");
                let size = (to - from) / pitch;
                let most = (size.x.abs() / 0.75f64.sqrt() + 3.01) * (size.y.abs() + 3.01);
                assert!(found.len() as f64 <= most, "{from} {to}: {found:?}");
            }
            let mut all = Vec::new();
            grid.visit(&-far, &far, |i| all.push(i));
            assert_eq!(all, (0..points.len()).collect::<Vec<_>>());
            grid.visit(&Point3::new(-9.0, -9.0, 0.1), &far, |_| panic!("no node"));
        }
    }
}

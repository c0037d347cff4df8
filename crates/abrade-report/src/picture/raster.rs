//! Spreads the depths of nodes over a grid of points.
//!
//! Each node weighs 1 - r/p at distance r < p, its node distance, and a point takes the weighted
//! mean. On a close-packed lattice the weight of a node is zero at its neighbours, so the field
//! meets every node's own depth and is continuous between them. Where an irregular surface leaves
//! a hole, a second, faint cone of twice the reach fills it.

use super::view::Seen;

/// Points in rows; steps may be negative.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    /// The first point [m].
    pub(super) origin: [f64; 2],
    /// From point to point [m].
    pub(super) step: [f64; 2],
    /// Points along each axis.
    pub(super) size: [usize; 2],
}

/// Reach of the faint cone, in node distances.
pub(super) const REACH: f64 = 2.0;
/// Weight of the faint cone: too little to be seen where the first has any.
const FAINT: f32 = 1e-6;

impl Grid {
    /// Depth at every point [m], row by row; NaN where no node is near.
    pub(super) fn spread(&self, nodes: impl Iterator<Item = Seen>) -> Vec<f32> {
        let count = self.size[0] * self.size[1];
        let (mut sums, mut weights) = (vec![0.0_f32; count], vec![0.0_f32; count]);
        let finest = self.step[0].abs().max(self.step[1].abs());
        for node in nodes {
            // Nodes closer than the points must still find one.
            let spacing = node.spacing.max(finest);
            let rows = self.range(1, node.at[1], REACH * spacing);
            let columns = self.range(0, node.at[0], REACH * spacing);
            for row in rows {
                let dy = self.at(1, row) - node.at[1];
                for column in columns.clone() {
                    let dx = self.at(0, column) - node.at[0];
                    let far = (dx.hypot(dy) / spacing) as f32;
                    let weight = (1.0 - far).max(0.0) + FAINT * (REACH as f32 - far).max(0.0);
                    let i = row * self.size[0] + column;
                    sums[i] += weight * node.depth as f32;
                    weights[i] += weight;
                }
            }
        }
        sums.iter().zip(&weights).map(|(sum, weight)| sum / weight).collect()
    }

    /// Coordinate of point `i` along axis `k` [m].
    pub(super) fn at(&self, k: usize, i: usize) -> f64 {
        self.origin[k] + self.step[k] * i as f64
    }

    /// The points along axis `k` within `reach` of `centre`.
    fn range(&self, k: usize, centre: f64, reach: f64) -> std::ops::Range<usize> {
        let ends = [centre - reach, centre + reach].map(|x| (x - self.origin[k]) / self.step[k]);
        let first = ends[0].min(ends[1]).ceil().max(0.0);
        let last = ends[0].max(ends[1]).floor() + 1.0;
        first as usize..(last.max(first) as usize).min(self.size[k]).max(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A close-packed lattice with a depth that is linear in x and y.
    fn lattice(spacing: f64) -> Vec<Seen> {
        let column = |i: i32| (-20..=20).map(move |j| (i, j));
        let nodes = (-20..=20).flat_map(column).map(|(i, j)| {
            let shift = if i % 2 == 0 { 0.0 } else { 0.5 };
            let at = [f64::from(i) * 0.75_f64.sqrt() * spacing, (f64::from(j) + shift) * spacing];
            Seen { at, depth: 10.0 + at[0] - 2.0 * at[1], spacing }
        });
        nodes.collect()
    }

    /// A program that blurs would miss the depth of a lone deep node; one that only paints the
    /// nearest point would leave gaps.
    #[test]
    fn the_field_meets_every_node_and_has_no_holes() {
        let mut nodes = lattice(1.0);
        let middle = nodes.iter_mut().find(|n| n.at == [0.0, 0.0]).expect("a node at the origin");
        middle.depth = 30.0;
        let grid = Grid { origin: [-5.0, 5.0], step: [0.1, -0.1], size: [101, 101] };
        let field = grid.spread(nodes.into_iter());
        assert!(field.iter().all(|depth| depth.is_finite()));
        assert!((field[50 * 101 + 50] - 30.0).abs() < 1e-3, "{}", field[50 * 101 + 50]);
        // A neighbour one pitch up keeps its own depth, 10 - 2.
        assert!((field[40 * 101 + 50] - 8.0).abs() < 1e-3, "{}", field[40 * 101 + 50]);
    }

    /// A program that swapped axes or signs would tilt the plane the wrong way; the tolerance is
    /// a tenth of what the plane changes over one node distance.
    #[test]
    fn a_tilted_plane_stays_a_tilted_plane() {
        let grid = Grid { origin: [-5.0, 5.0], step: [0.5, -0.25], size: [21, 41] };
        let field = grid.spread(lattice(1.0).into_iter());
        for row in 0..41 {
            for column in 0..21 {
                let exact = 10.0 + grid.at(0, column) - 2.0 * grid.at(1, row);
                let found = f64::from(field[row * 21 + column]);
                assert!((found - exact).abs() < 0.25, "{found} for {exact}");
            }
        }
    }

    /// A program that clamped instead of clipping would paint distant nodes on the rim.
    #[test]
    fn nodes_out_of_reach_leave_no_trace() {
        let grid = Grid { origin: [0.0, 0.0], step: [1.0, 1.0], size: [4, 4] };
        let far = Seen { at: [-50.0, 2.0], depth: 1.0, spacing: 1.0 };
        assert!(grid.spread([far].into_iter()).iter().all(|depth| depth.is_nan()));
    }
}

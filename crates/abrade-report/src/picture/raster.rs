//! Spreads the depths of nodes over a grid of points.
//!
//! Each node weighs 1 - r/p at distance r < p, its node distance, and says its own depth plus the
//! way times the mean of its slope and the point's (the trapezoid rule, exact on planes and on
//! bowls); a point takes the weighted mean. On a close-packed lattice the weight of a node is
//! zero at its neighbours, so the field meets every node's own depth and is continuous between
//! them. Where an irregular surface leaves a hole, a second, faint and wider cone fills it.

use super::slope::slopes;
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
pub(super) const REACH: f64 = 1.5;
/// Weight of the faint cone: too little to be seen where the first has any.
const FAINT: f32 = 1e-6;
/// Nodes closer than this many points need no slope: the steps between them cannot be seen.
const FINE: f64 = 2.0;

/// A point is worn where worn nodes have this share of the weight: so a lone node colours about
/// the area it stands for, and an edge of many runs about half-way to the next.
const WORN: f32 = 0.40;

/// What a point has gathered.
#[derive(Clone, Copy, Default)]
struct Sum {
    weight: f32,
    worn: f32,
    /// Own depths and half of what the nodes' slopes add.
    depth: f32,
    slope: [f32; 2],
    way: [f32; 2],
}

impl Grid {
    /// Depth at every point [m], row by row: zero where nothing is worn, NaN where no node is
    /// near.
    pub(super) fn spread(&self, nodes: impl Iterator<Item = Seen>) -> Vec<f32> {
        let mut sums = vec![Sum::default(); self.size[0] * self.size[1]];
        let finest = self.step[0].abs().max(self.step[1].abs());
        let (fine, coarse): (Vec<_>, Vec<_>) = nodes.partition(|node| node.spacing < FINE * finest);
        fine.iter().for_each(|node| self.add(&mut sums, node, [0.0; 2], finest));
        let slopes = slopes(&coarse);
        coarse.iter().zip(slopes).for_each(|(n, slope)| self.add(&mut sums, n, slope, finest));
        sums.iter().map(Sum::mean).collect()
    }

    fn add(&self, sums: &mut [Sum], node: &Seen, slope: [f64; 2], finest: f64) {
        // Nodes closer than the points must still find one.
        let spacing = node.spacing.max(finest);
        let columns = self.range(0, node.at[0], REACH * spacing);
        let worn = f32::from(node.depth > 0.0);
        for row in self.range(1, node.at[1], REACH * spacing) {
            let dy = self.at(1, row) - node.at[1];
            for column in columns.clone() {
                let dx = self.at(0, column) - node.at[0];
                let far = ((dx * dx + dy * dy).sqrt() / spacing) as f32;
                let weight = (1.0 - far).max(0.0) + FAINT * (REACH as f32 - far).max(0.0);
                let sum = &mut sums[row * self.size[0] + column];
                sum.weight += weight;
                sum.worn += weight * worn;
                let half = 0.5 * (slope[0] * dx + slope[1] * dy);
                sum.depth += weight * (node.depth + half) as f32;
                sum.slope[0] += weight * slope[0] as f32;
                sum.slope[1] += weight * slope[1] as f32;
                sum.way[0] += weight * dx as f32;
                sum.way[1] += weight * dy as f32;
            }
        }
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
        first as usize..(last.max(first) as usize).min(self.size[k])
    }
}

impl Sum {
    /// Half of what the point's own slope adds, weighted.
    fn half_by_slope(&self) -> f32 {
        0.5 * (self.slope[0] * self.way[0] + self.slope[1] * self.way[1]) / self.weight
    }

    fn mean(&self) -> f32 {
        match self.weight > 0.0 {
            false => f32::NAN,
            true if self.worn < WORN * self.weight => 0.0,
            // A slope may reach above the undeformed surface; wear does not.
            true => ((self.depth + self.half_by_slope()) / self.weight).max(0.0),
        }
    }
}

#[cfg(test)]
mod tests;

//! The material along one node's line during a contact: solid below the node, less the voids that
//! bodies have cut. Coordinates run along the normal from the node's place at the first touch.

#[cfg(feature = "state")]
use crate::state::{Fault, finite, not_negative, require};

/// Voids a column can hold; beyond that the thinnest slab between two of them breaks off.
const VOIDS: usize = 4;

/// An interval along the normal, lower end first [m].
pub(crate) type Interval = [f64; 2];

/// A short list of intervals, sorted upwards, disjoint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Intervals<const N: usize> {
    items: [Interval; N],
    count: usize,
}

/// Voids of a column, and the spring under the body.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "state", serde(try_from = "ColumnState", into = "ColumnState"))]
pub(crate) struct Column {
    voids: Intervals<VOIDS>,
    /// Compression of the spring [m].
    pub squeeze: f64,
}

/// What a sweep of a column takes away.
pub(crate) type Pieces = Intervals<{ VOIDS + 1 }>;

impl<const N: usize> Default for Intervals<N> {
    fn default() -> Self {
        Self { items: [[0.0; 2]; N], count: 0 }
    }
}

impl<const N: usize> Intervals<N> {
    #[inline]
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Interval> {
        self.items[..self.count].iter()
    }

    #[inline]
    fn push(&mut self, interval: Interval) {
        if interval[1] > interval[0] && self.count < N {
            self.items[self.count] = interval;
            self.count += 1;
        }
    }
}

impl Column {
    /// True once a body has cut it.
    #[inline]
    pub(crate) fn is_cut(&self) -> bool {
        self.voids.count > 0
    }

    /// Lower end of the lowest void: where the solid below every body begins [m].
    #[inline]
    pub(crate) fn floor(&self) -> f64 {
        if self.is_cut() { self.voids.items[0][0] } else { 0.0 }
    }

    /// Depth below the node down to which the column is open, without a roof over it [m].
    #[inline]
    pub(crate) fn open_depth(&self) -> f64 {
        let [low, high] = self.voids.items[0];
        if self.voids.count == 1 && high >= 0.0 { -low } else { 0.0 }
    }

    /// Upper end of the solid on which a body whose deep end is at `z` stands [m].
    #[inline]
    pub(crate) fn level_below(&self, z: f64) -> f64 {
        let under = self.voids.iter().filter(|void| void[0] <= z).last();
        match under {
            // Above a roof that still stands.
            Some(void) if z > void[1] && void[1] < 0.0 => 0.0,
            Some(void) => void[0],
            None => 0.0,
        }
    }

    /// The solid parts of [low, high], below the node.
    #[inline]
    pub(crate) fn solid(&self, low: f64, high: f64) -> Pieces {
        let mut pieces = Pieces::default();
        let (mut from, high) = (low, high.min(0.0));
        for void in self.voids.iter() {
            if void[1] <= from {
                continue;
            }
            if void[0] >= high {
                break;
            }
            pieces.push([from, void[0]]);
            from = void[1];
        }
        pieces.push([from, high]);
        pieces
    }

    /// Turns `share` of a solid piece into void, starting where it borders on one. Returns the
    /// length of a slab that broke off because the column held too many voids [m].
    pub(crate) fn dig(&mut self, piece: &Interval, share: f64) -> f64 {
        let length = share * (piece[1] - piece[0]);
        let bounds_above = piece[1] >= 0.0 || self.voids.iter().any(|void| void[0] == piece[1]);
        let cut = match (share < 1.0, bounds_above) {
            (false, _) => *piece,
            (true, true) => [piece[1] - length, piece[1]],
            (true, false) => [piece[0], piece[0] + length],
        };
        self.insert(cut)
    }

    fn insert(&mut self, cut: Interval) -> f64 {
        let mut merged = cut;
        let mut voids = [Interval::default(); VOIDS + 1];
        let mut count = 0;
        let mut placed = false;
        for void in self.voids.iter() {
            if void[1] < merged[0] {
                voids[count] = *void;
                count += 1;
            } else if void[0] > merged[1] {
                if !placed {
                    voids[count] = merged;
                    count += 1;
                    placed = true;
                }
                voids[count] = *void;
                count += 1;
            } else {
                merged = [merged[0].min(void[0]), merged[1].max(void[1])];
            }
        }
        if !placed {
            voids[count] = merged;
            count += 1;
        }
        let mut broken = 0.0;
        if count > VOIDS {
            let slab = |i: usize| voids[i + 1][0] - voids[i][1];
            let thinnest = (0..count - 1).min_by(|&a, &b| slab(a).total_cmp(&slab(b))).unwrap_or(0);
            broken = slab(thinnest);
            voids[thinnest][1] = voids[thinnest + 1][1];
            voids.copy_within(thinnest + 2..count, thinnest + 1);
            count -= 1;
        }
        self.voids.items.copy_from_slice(&voids[..VOIDS]);
        self.voids.count = count;
        broken
    }

    /// Length of the slabs and overhangs left standing above the floor [m].
    pub(crate) fn standing(&self) -> f64 {
        -self.floor() - self.voids.iter().map(|void| void[1] - void[0]).sum::<f64>()
    }
}

#[cfg(feature = "bench")]
impl Column {
    /// The voids and their number.
    pub(crate) fn recorded(&self) -> ([Interval; VOIDS], usize) {
        (self.voids.items, self.voids.count)
    }
}

/// A column as bytes hold it.
#[cfg(feature = "state")]
#[derive(serde::Serialize, serde::Deserialize)]
pub(crate) struct ColumnState {
    voids: Vec<Interval>,
    squeeze: f64,
}

#[cfg(feature = "state")]
impl From<Column> for ColumnState {
    fn from(column: Column) -> Self {
        Self { voids: column.voids.iter().copied().collect(), squeeze: column.squeeze }
    }
}

#[cfg(feature = "state")]
impl TryFrom<ColumnState> for Column {
    type Error = Fault;

    fn try_from(state: ColumnState) -> Result<Self, Fault> {
        let ends = state.voids.as_flattened();
        let fine = state.voids.len() <= VOIDS && not_negative(state.squeeze) && finite(ends);
        require(fine && ends.is_sorted(), "the voids of a column are in disorder")?;
        let mut column = Self { squeeze: state.squeeze, ..Self::default() };
        state.voids.iter().for_each(|void| column.voids.push(*void));
        Ok(column)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solid(column: &Column, low: f64, high: f64) -> Vec<Interval> {
        column.solid(low, high).iter().copied().collect()
    }

    /// Fails for a column that charges a void again, or forgets a slab between two voids.
    #[test]
    fn only_solid_is_taken_and_every_slab_is_kept() {
        let mut column = Column::default();
        assert_eq!(solid(&column, -1.0, 5.0), [[-1.0, 0.0]]);
        assert_eq!(column.dig(&[-4.0, -3.0], 1.0), 0.0);
        assert_eq!(solid(&column, -5.0, -3.5), [[-5.0, -4.0]]);
        assert_eq!(solid(&column, -5.0, 1.0), [[-5.0, -4.0], [-3.0, 0.0]]);
        assert_eq!(column.standing(), 3.0);
        column.dig(&[-1.0, 0.0], 1.0);
        assert_eq!(column.standing(), 2.0);
        assert_eq!(column.level_below(-0.5), -1.0);
        assert_eq!(column.level_below(-3.5), -4.0);
        column.dig(&[-3.0, -1.0], 1.0);
        assert_eq!((column.standing(), column.floor()), (0.0, -4.0));
        assert_eq!(column.level_below(3.0), -4.0);
    }

    /// Fails for a blocked cut that leaves its rest detached from the solid.
    #[test]
    fn a_share_is_cut_from_the_free_side() {
        let mut column = Column::default();
        column.dig(&[-1.0, 0.0], 0.25);
        assert_eq!(column.floor(), -0.25);
        column.dig(&[-1.0, -0.25], 1.0 / 3.0);
        assert_eq!(column.floor(), -0.5);
    }

    /// Fails for an overflow that loses or invents material.
    #[test]
    fn the_thinnest_slab_breaks_when_there_are_too_many() {
        let mut column = Column::default();
        let mut broken = 0.0;
        for (low, high) in [(-9.0, -8.0), (-7.0, -6.0), (-5.5, -5.0), (-3.0, -2.0), (-1.0, 0.0)] {
            broken += column.dig(&[low, high], 1.0);
        }
        assert_eq!(broken, 0.5);
        assert_eq!(column.standing() + broken, 9.0 - 4.5);
    }
}

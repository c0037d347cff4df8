//! Four numbers at a time: the ends of four pairs, beside each other in the columns or anywhere.
//!
//! Sums over an element's pairs stand in two columns, of the pairs that it begins and of those that it
//! ends. Blocks that follow each other then never add to overlapping quarters, for which a processor
//! would wait.

use wide::f64x4;

/// Pairs in a block.
pub(crate) const LANES: usize = 4;

/// A sum over pairs: of those that an element begins, and of those that it ends.
pub(crate) type Sum = [Vec<f64>; 2];

/// The ends of the pairs of a block.
pub(crate) trait Ends: Copy {
    /// Values of a column at the first and the second ends.
    fn get(self, column: &[f64]) -> [f64x4; 2];
    /// Adds to the sum of the first ends, and of the second.
    fn add(self, sum: &mut Sum, values: [f64x4; 2]);
    /// The ends of one pair.
    fn of(self, lane: usize) -> [usize; 2];
}

/// First ends that follow each other from an element on, and second ends likewise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Run(pub(crate) [u32; 2]);

/// Ends anywhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Loose(pub(crate) [[u32; LANES]; 2]);

impl Ends for Run {
    #[inline(always)]
    fn get(self, column: &[f64]) -> [f64x4; 2] {
        [load(column, self.0[0] as usize), load(column, self.0[1] as usize)]
    }

    #[inline(always)]
    fn add(self, sum: &mut Sum, values: [f64x4; 2]) {
        for side in 0..2 {
            let at = self.0[side] as usize;
            let old = load(&sum[side], at);
            store(&mut sum[side], at, old + values[side]);
        }
    }

    #[inline(always)]
    fn of(self, lane: usize) -> [usize; 2] {
        self.0.map(|first| first as usize + lane)
    }
}

impl Ends for Loose {
    #[inline(always)]
    fn get(self, column: &[f64]) -> [f64x4; 2] {
        self.0.map(|ends| f64x4::new(ends.map(|end| column[end as usize])))
    }

    #[inline(always)]
    fn add(self, sum: &mut Sum, values: [f64x4; 2]) {
        for side in 0..2 {
            let values = values[side].to_array();
            for (end, value) in self.0[side].iter().zip(values) {
                sum[side][*end as usize] += value;
            }
        }
    }

    #[inline(always)]
    fn of(self, lane: usize) -> [usize; 2] {
        self.0.map(|ends| ends[lane] as usize)
    }
}

/// Four numbers of a column.
#[inline(always)]
pub(crate) fn load(column: &[f64], at: usize) -> f64x4 {
    let four: [f64; LANES] = column[at..at + LANES].try_into().expect("four numbers");
    f64x4::new(four)
}

/// Writes four numbers of a column.
#[inline(always)]
pub(crate) fn store(column: &mut [f64], at: usize, values: f64x4) {
    column[at..at + LANES].copy_from_slice(&values.to_array());
}

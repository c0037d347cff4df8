//! Passes over blocks of four pairs, whose ends lie beside each other in the columns of elements or
//! anywhere.
//!
//! Sums over an element's pairs stand in two columns, of the pairs that it begins and of those that it
//! ends. Blocks that follow each other then never add to overlapping quarters, for which a processor
//! would wait.

use crate::block::Block;
use crate::column::Column;
use crate::four::{Four, LANES};

/// A sum over pairs: of those that an element begins, and of those that it ends.
pub(crate) type Sum = [Column; 2];

/// A sum as a pass holds it.
pub(crate) type Sides<'a> = [&'a mut [f64]; 2];

/// The first `count` numbers of a sum's columns: a pass that cuts all columns to one length looks once
/// whether a block is inside them.
pub(crate) fn sides(sum: &mut Sum, count: usize) -> Sides<'_> {
    let [first, second] = sum;
    [&mut first[..count], &mut second[..count]]
}

/// The ends of the pairs of a block.
pub(crate) trait Ends: Copy {
    /// Values of a column at the first and the second ends.
    fn get(self, column: &[f64]) -> [Four; 2];

    /// The sum of the values at both ends.
    #[inline(always)]
    fn sum(self, column: &[f64]) -> Four {
        let [i, j] = self.get(column);
        i + j
    }

    /// Adds to the sum of the first ends, and of the second.
    fn add(self, sum: &mut Sides, values: [Four; 2]);

    /// The ends of one pair.
    fn of(self, lane: usize) -> [u32; 2];
}

/// First ends that follow each other from an element on, and second ends likewise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Run(pub(crate) [u32; 2]);

/// Ends anywhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Loose(pub(crate) [[u32; LANES]; 2]);

impl Ends for Run {
    #[inline(always)]
    fn get(self, column: &[f64]) -> [Four; 2] {
        [load(column, self.0[0] as usize), load(column, self.0[1] as usize)]
    }

    #[inline(always)]
    fn add(self, sum: &mut Sides, values: [Four; 2]) {
        for side in 0..2 {
            let at = self.0[side] as usize;
            let old = load(sum[side], at);
            store(sum[side], at, old + values[side]);
        }
    }

    fn of(self, lane: usize) -> [u32; 2] {
        self.0.map(|first| first + lane as u32)
    }
}

impl Ends for Loose {
    #[inline(always)]
    fn get(self, column: &[f64]) -> [Four; 2] {
        let four = |[a, b, c, d]: [u32; LANES]| {
            let at = |end: u32| column[end as usize];
            Four([at(a), at(b), at(c), at(d)])
        };
        [four(self.0[0]), four(self.0[1])]
    }

    #[inline(always)]
    fn add(self, sum: &mut Sides, values: [Four; 2]) {
        for side in 0..2 {
            let values = values[side].0;
            for (end, value) in self.0[side].iter().zip(values) {
                sum[side][*end as usize] += value;
            }
        }
    }

    fn of(self, lane: usize) -> [u32; 2] {
        [self.0[0][lane], self.0[1][lane]]
    }
}

/// Four numbers of a column.
#[inline(always)]
pub(crate) fn load(column: &[f64], at: usize) -> Four {
    let four: [f64; LANES] = column[at..at + LANES].try_into().expect("four numbers");
    Four(four)
}

/// Writes four numbers of a column.
#[inline(always)]
pub(crate) fn store(column: &mut [f64], at: usize, values: Four) {
    column[at..at + LANES].copy_from_slice(&values.0);
}

/// The sum over both sides of four elements, which begins anew.
#[inline(always)]
pub(crate) fn take(sum: &mut Sides, at: usize) -> Four {
    let total = load(sum[0], at) + load(sum[1], at);
    store(sum[0], at, Four::ZERO);
    store(sum[1], at, Four::ZERO);
    total
}

/// Something done to each block of four pairs.
pub(crate) trait BlockPass {
    /// Does it to block `at`.
    fn block<E: Ends>(&mut self, at: usize, block: &mut Block, ends: E);
}

/// The ends of all pairs: blocks whose ends follow each other, then loose pairs.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct AllEnds {
    pub(crate) runs: Vec<Run>,
    pub(crate) loose: Vec<Loose>,
}

impl AllEnds {
    /// Does a pass over all blocks, in their order.
    #[inline(always)]
    pub(crate) fn sweep(&self, blocks: &mut [Block], pass: &mut impl BlockPass) {
        let (in_runs, loose) = blocks.split_at_mut(self.runs.len());
        for (at, (block, ends)) in in_runs.iter_mut().zip(&self.runs).enumerate() {
            pass.block(at, block, *ends);
        }
        for (at, (block, ends)) in loose.iter_mut().zip(&self.loose).enumerate() {
            pass.block(self.runs.len() + at, block, *ends);
        }
    }

    /// The ends of pair `at`.
    pub(crate) fn of(&self, at: usize) -> [u32; 2] {
        let (block, lane) = (at / LANES, at % LANES);
        match block.checked_sub(self.runs.len()) {
            Some(loose) => self.loose[loose].of(lane),
            None => self.runs[block].of(lane),
        }
    }
}

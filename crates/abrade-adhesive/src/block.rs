//! What every step takes of pairs, by fours: each number of four pairs stands beside the others',
//! so that a pass goes through memory once, from front to back.

use crate::elements::Elements;
use crate::four::Four;

/// Four pairs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Block {
    /// Unit vector from the first to the second end, and their distance [m].
    pub(crate) nx: Four,
    pub(crate) ny: Four,
    pub(crate) distance: Four,
    /// What periodicity adds to x from the first to the second end [m].
    pub(crate) image: Four,
    /// Strain of this step along and across [-].
    pub(crate) stretch: Four,
    pub(crate) shear: Four,
    /// 1 while linked, else 0.
    pub(crate) live: Four,
    /// Normal and tangential stress [Pa].
    pub(crate) normal: Four,
    pub(crate) tangential: Four,
}

/// One pair of a block, with the same numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Line {
    pub(crate) direction: [f64; 2],
    pub(crate) distance: f64,
    pub(crate) image: f64,
    pub(crate) strain: [f64; 2],
    pub(crate) live: f64,
    pub(crate) stress: [f64; 2],
}

impl Line {
    /// A pair that is not linked, of elements as they lie.
    pub(crate) fn new(elements: &Elements, ends: [u32; 2], period: Option<f64>) -> Self {
        let [i, j] = ends.map(|end| end as usize);
        let dx = elements.x[j] - elements.x[i];
        let image = period.map_or(0.0, |period| -period * (dx / period).round());
        let (dx, dy) = (dx + image, elements.y[j] - elements.y[i]);
        let distance = dx.hypot(dy);
        let direction = [dx / distance, dy / distance];
        Self { direction, distance, image, strain: [0.0; 2], live: 0.0, stress: [0.0; 2] }
    }
}

impl Block {
    /// Room for four pairs.
    pub(crate) const EMPTY: Self = Self {
        nx: Four::ZERO,
        ny: Four::ZERO,
        distance: Four::ZERO,
        image: Four::ZERO,
        stretch: Four::ZERO,
        shear: Four::ZERO,
        live: Four::ZERO,
        normal: Four::ZERO,
        tangential: Four::ZERO,
    };

    /// The pair in a lane.
    pub(crate) fn line(&self, lane: usize) -> Line {
        Line {
            direction: [self.nx.0[lane], self.ny.0[lane]],
            distance: self.distance.0[lane],
            image: self.image.0[lane],
            strain: [self.stretch.0[lane], self.shear.0[lane]],
            live: self.live.0[lane],
            stress: [self.normal.0[lane], self.tangential.0[lane]],
        }
    }

    /// Puts a pair into a lane.
    pub(crate) fn put(&mut self, lane: usize, line: &Line) {
        [self.nx.0[lane], self.ny.0[lane]] = line.direction;
        self.distance.0[lane] = line.distance;
        self.image.0[lane] = line.image;
        [self.stretch.0[lane], self.shear.0[lane]] = line.strain;
        self.live.0[lane] = line.live;
        [self.normal.0[lane], self.tangential.0[lane]] = line.stress;
    }

    /// A bit for each that is not linked.
    #[inline(always)]
    pub(crate) fn unlinked(&self) -> u32 {
        self.live.up_to(Four::ZERO)
    }
}

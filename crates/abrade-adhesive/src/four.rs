//! Four numbers at a time, in a plain array. What works on them by lanes becomes vectors, as wide
//! as the target that it is compiled for has them; a pass is compiled for several targets and picks
//! one when it runs. Products and sums are never contracted, so that all of them give the same
//! bits.

use std::array;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// Numbers in a block.
pub(crate) const LANES: usize = 4;

/// Four numbers, which do not lie across two lines of the cache.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(32))]
pub(crate) struct Four(pub(crate) [f64; LANES]);

impl Four {
    pub(crate) const ZERO: Self = Self([0.0; LANES]);

    #[inline(always)]
    pub(crate) const fn splat(value: f64) -> Self {
        Self([value; LANES])
    }

    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }

    /// The greater of both; `other` where one is not a number, as a processor has it.
    #[inline(always)]
    pub(crate) fn max(self, other: Self) -> Self {
        self.with(other, |a, b| if a > b { a } else { b })
    }

    /// Whether any lane is greater than that of `other`.
    #[inline(always)]
    pub(crate) fn any_above(self, other: Self) -> bool {
        (0..LANES).fold(false, |any, lane| any | (self.0[lane] > other.0[lane]))
    }

    /// A bit for each lane that is no greater than that of `other`.
    #[inline(always)]
    pub(crate) fn up_to(self, other: Self) -> u32 {
        let bit = |lane: usize| u32::from(self.0[lane] <= other.0[lane]) << lane;
        (0..LANES).fold(0, |bits, lane| bits | bit(lane))
    }

    /// The sum of the lanes.
    #[inline(always)]
    pub(crate) fn sum(self) -> f64 {
        let [a, b, c, d] = self.0;
        (a + b) + (c + d)
    }

    #[inline(always)]
    fn with(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(array::from_fn(|lane| f(self.0[lane], other.0[lane])))
    }
}

impl Add for Four {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(other, |a, b| a + b)
    }
}

impl Sub for Four {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(other, |a, b| a - b)
    }
}

impl Mul for Four {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(other, |a, b| a * b)
    }
}

impl Div for Four {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.with(other, |a, b| a / b)
    }
}

impl Neg for Four {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(|a| -a))
    }
}

impl AddAssign for Four {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

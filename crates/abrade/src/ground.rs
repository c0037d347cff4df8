//! What the nodes of a patch are of, as far as the inner loop differs: what a flat surface does not
//! ask is not in its loop.

use crate::node_law::STEEP;

/// The surface whose nodes are taken through a step.
pub(crate) trait Ground: Copy {
    /// Area [m2] by which a node of `area` counts in the contact.
    fn area(self, area: f64) -> f64;

    /// True for a node that the body has come upon from inside: with an `overlap` that is not
    /// `foreseen` [m], or by a face of the `cosine` c that looks away from it.
    fn misses(self, overlap: f64, foreseen: f64, cosine: f64) -> bool;
}

/// A flat surface that carries the whole force.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flat;

/// The surface of a solid, or one of two that meet. A node of a solid is met from outside or not at
/// all: with an overlap that the body made in this step, to `jump` [m], and a face that looks at it,
/// by more than `steep`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Closed {
    jump: f64,
    steep: f64,
    /// Share of its area that a node stands for.
    share: f64,
}

impl Closed {
    /// A solid whose nodes yield at an overlap of `jump` [m].
    pub(crate) fn solid(jump: f64, share: f64) -> Self {
        Self { jump, steep: STEEP, share }
    }

    /// A plate, one of two that meet.
    pub(crate) fn plate(share: f64) -> Self {
        Self { jump: f64::INFINITY, steep: f64::NEG_INFINITY, share }
    }
}

impl Ground for Flat {
    #[inline(always)]
    fn area(self, area: f64) -> f64 {
        area
    }

    #[inline(always)]
    fn misses(self, _: f64, _: f64, _: f64) -> bool {
        false
    }
}

impl Ground for Closed {
    #[inline(always)]
    fn area(self, area: f64) -> f64 {
        area * self.share
    }

    #[inline(always)]
    fn misses(self, overlap: f64, foreseen: f64, cosine: f64) -> bool {
        overlap > foreseen + self.jump || cosine <= self.steep
    }
}

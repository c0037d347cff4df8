//! Archard's wear of nodes that slip under load, beside the flow of a surface: K F s / H of volume for a
//! force F that slips by s (Archard, Journal of Applied Physics 24 (1953) 981).
//!
//! A node of area a loses K F s / (a H) of its height, whatever its slope: the volume counts. F is the
//! force along the face's normal, at the end of the step and after the loss, so that a hard spring
//! under much slip is let down, not overshot. What the flow of the step takes comes first, and the
//! force that is left wears: no volume is counted twice.

use crate::elastic::Elastic;
use crate::flow::Flow;
use crate::laws::Archard;
use crate::material::Material;
use crate::node_law::{Advance, Drop, Excess, Loaded, NodeStep, STEEP, Spring};
use crate::query::Query;

/// The flow law `F` on a surface that Archard's law wears as well.
pub(crate) struct Rubbed<F> {
    pub flow: F,
    /// K / H [1/Pa].
    pub rate: f64,
}

/// Share of the first estimate of a loss to which it is found, and the number of trials.
const LOSS: f64 = 1e-12;
const LOSS_STEPS: usize = 20;
/// Largest loss, over the one that the force before it would make.
const LOSS_LIMIT: f64 = 2.0;

impl Archard {
    /// K / H of `material` [1/Pa].
    pub(crate) fn rate(&self, material: &Material) -> f64 {
        self.coefficient / material.hardness
    }
}

impl<F: Flow> Flow for Rubbed<F> {
    const FACE_PRESSURE: bool = F::FACE_PRESSURE;
    const HEADS: bool = F::HEADS;

    #[inline(always)]
    fn times(&self, factor: f64) -> Self {
        Self { flow: self.flow.times(factor), rate: self.rate / factor }
    }

    #[inline(always)]
    fn flow<E: Elastic, Q: Query>(
        &self,
        node: &NodeStep<'_, E, Q>,
        start: &Loaded,
        advance: &Advance,
        old: &Spring,
    ) -> (Drop, Loaded) {
        let (drop, now) = self.flow.flow(node, start, advance, old);
        let (archard, now) = self.wear(node, drop.normal + drop.lateral, &now, advance.share);
        (Drop { archard, ..drop }, now)
    }

    #[inline(always)]
    fn excess(&self, area: f64, loaded: &Loaded) -> Excess {
        self.flow.excess(area, loaded)
    }
}

impl<F> Rubbed<F> {
    /// What a node loses [m] that has flowed by `flowed` [m], and the node after it. A node that was
    /// touched in a `share` of the step counts as if all of it: so much as one that was left in a part of
    /// its last step counts too little, and the loads of all are those of the body.
    fn wear<E: Elastic, Q: Query>(
        &self,
        node: &NodeStep<'_, E, Q>,
        flowed: f64,
        now: &Loaded,
        share: f64,
    ) -> (f64, Loaded) {
        let rate = self.rate / (node.area * share);
        let loss = |k: &Loaded| rate * k.normal_force * k.slip;
        let first = loss(now);
        if first <= 0.0 || now.cosine <= STEEP {
            return (0.0, *now);
        }
        // A secant from the force before the loss and a first step along its relief: the excess is
        // nearly linear.
        let (mut before, mut worn) = ((0.0, first), first / (1.0 + first * node.relief(now)));
        for _ in 0..LOSS_STEPS {
            let at = node.at(flowed + worn);
            let excess = loss(&at) - worn;
            if excess.abs() <= LOSS * first {
                return (worn, at);
            }
            let slope = (before.1 - excess) / (worn - before.0);
            if slope <= 0.0 || !slope.is_finite() {
                break;
            }
            before = (worn, excess);
            worn = (worn + excess / slope).clamp(0.0, LOSS_LIMIT * first);
        }
        (worn, node.at(flowed + worn))
    }
}

//! Archard's wear of nodes that slip under load, beside the flow of a surface: K F s / H of volume for a
//! force F that slips by s (Archard, Journal of Applied Physics 24 (1953) 981).
//!
//! A node of area a loses K F s / (a H) of its height, whatever its slope: the volume counts. F is the
//! force along the face's normal, at the end of the step and after the loss, so that a hard spring
//! under much slip is let down, not overshot. Of a node that flows as well the loss is a part of the
//! way that its flow takes it: no volume is counted twice, and its load stays at the cap.

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
        let flowed = drop.normal + drop.lateral;
        let (worn, now) = self.wear(node, flowed, &now, advance.share);
        let left = if flowed > worn { (flowed - worn) / flowed } else { 0.0 };
        let (normal, lateral) = (drop.normal * left, drop.lateral * left);
        (Drop { normal, lateral, archard: worn }, now)
    }

    #[inline(always)]
    fn excess(&self, area: f64, loaded: &Loaded) -> Excess {
        self.flow.excess(area, loaded)
    }
}

impl<F> Rubbed<F> {
    /// What a node loses [m], of which its flow has taken it `flowed` [m] down, and the node after it. A
    /// node that was touched in a `share` of the step counts as if in all of it: so much as one that was
    /// left in a part of its last step counts too little, and the loads of all are those of the body.
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
        let slips = first > 0.0 && now.cosine > STEEP;
        if !slips || first <= flowed {
            return (if slips { first } else { 0.0 }, *now);
        }
        // A secant from the force before the rest of the loss and a first step along its relief: the
        // excess is nearly linear.
        let (rest, relief) = (first - flowed, first * node.relief(now));
        let (mut before, mut worn) = ((flowed, rest), flowed + rest / (1.0 + relief));
        for _ in 0..LOSS_STEPS {
            let at = node.at(worn);
            let excess = loss(&at) - worn;
            if excess.abs() <= LOSS * first {
                return (worn, at);
            }
            let slope = (before.1 - excess) / (worn - before.0);
            if slope <= 0.0 || !slope.is_finite() {
                break;
            }
            before = (worn, excess);
            worn = (worn + excess / slope).clamp(flowed, LOSS_LIMIT * first);
        }
        (worn, node.at(worn))
    }
}

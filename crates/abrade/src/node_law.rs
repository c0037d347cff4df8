//! The inner loop's one node: query -> elastic -> friction -> flow -> drop.
//!
//! A return mapping, not a rate: within a step a flowing node sinks by the drop after which its
//! force is at its cap. The paper moves a node by V dt whenever it finds a force above the cap;
//! that un-wears on rebound and does not converge.

use nalgebra::{Point3, Vector3};

use crate::elastic::Elastic;
use crate::flow::Flow;
use crate::ground::Ground;
use crate::query::{Query, Touch};
#[cfg(feature = "state")]
use crate::state::finite;

/// Cosine below which a face is too steep for a node to be pushed down by it.
pub(crate) const STEEP: f64 = 0.05;

/// What a node remembers of its contact from step to step.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Spring {
    /// Tangential stretch xi [m].
    pub stretch: Vector3<f64>,
    /// d [m]; zero without contact.
    pub overlap: f64,
    /// |T| [N].
    pub tangential_force: f64,
    /// Of a law with two gates; of another if a ledger is kept.
    pub excess: Excess,
    /// Force along minus the node's normal [N].
    pub normal_load: f64,
    /// Drops of the step [m].
    pub drop: Drop,
}

impl Spring {
    /// Forgets a contact; a spring that had none is left alone, because writing costs.
    #[inline(always)]
    pub(crate) fn release(&mut self) {
        if self.overlap != 0.0 {
            *self = Self::default();
        }
    }
}

/// Loads of a node less their caps [N].
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Excess {
    pub normal: f64,
    pub lateral: f64,
}

/// Parts of a step's drop [m].
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Drop {
    pub normal: f64,
    pub lateral: f64,
    /// By Archard's law.
    pub archard: f64,
}

impl Drop {
    /// All of it [m].
    #[inline(always)]
    pub(crate) fn total(&self) -> f64 {
        self.normal + self.lateral + self.archard
    }
}

/// The body's motion over the step, at mid-step, in the surface's frame.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Motion {
    /// Of the centre of mass over the material of the surface, were it so large.
    pub velocity: Vector3<f64>,
    /// Over the surface: the body's own less that of the surface.
    pub spin: Vector3<f64>,
    /// The part of it that turns the surface below the body; None for one that does not turn.
    pub drag: Option<Vector3<f64>>,
    pub dt: f64,
}

impl Motion {
    /// v* [m/s]: of a point at `arm` from the centre of mass, whose face has the normal `m`, over
    /// the surface's material, without what the body's own spin moves it along that face.
    #[inline(always)]
    pub(crate) fn advance(&self, arm: &Vector3<f64>, m: &Vector3<f64>) -> Vector3<f64> {
        let own = self.drag.map_or(self.spin, |drag| self.spin - drag).cross(arm);
        self.over(arm) + m * m.dot(&own)
    }

    /// Unit tangential direction of the body's motion over a node at `arm` from its centre of mass
    /// with normal `n`; zero at rest.
    #[inline(always)]
    pub(crate) fn heading(&self, arm: &Vector3<f64>, n: &Vector3<f64>) -> Vector3<f64> {
        heading(&self.over(arm), n)
    }

    /// Velocity of the centre of mass over the material at `arm` from it [m/s].
    #[inline(always)]
    fn over(&self, arm: &Vector3<f64>) -> Vector3<f64> {
        self.drag.map_or(self.velocity, |drag| self.velocity + drag.cross(arm))
    }
}

/// A node in one step, before its drop is known.
pub(crate) struct NodeStep<'a, E, Q> {
    pub query: &'a Q,
    pub elastic: E,
    pub x: Point3<f64>,
    pub n: Vector3<f64>,
    pub area: f64,
    pub friction: f64,
    /// Unit tangential direction of the body's motion; zero at rest, and for a law that does not
    /// ask for it.
    pub heading: Vector3<f64>,
    /// Tangential stretch before the drop [m].
    pub trial_stretch: Vector3<f64>,
}

/// The node after a drop: geometry and force.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Loaded {
    pub touch: Touch,
    /// c = -m . n.
    pub cosine: f64,
    /// F [N], along m.
    pub normal_force: f64,
    /// T [N], and its length.
    pub tangential: Vector3<f64>,
    pub tangential_force: f64,
    /// |xi| cut off by slip, and the stretch that is left; zeros without friction.
    pub slip: f64,
    pub stretch: Vector3<f64>,
    /// F_z: force along minus n.
    pub normal_load: f64,
    /// F_x: force along the heading.
    pub lateral_load: f64,
}

impl<E: Elastic, Q: Query> NodeStep<'_, E, Q> {
    /// The node after sinking by `drop` [m]; exact geometry.
    #[inline(always)]
    pub(crate) fn at(&self, drop: f64) -> Loaded {
        self.loaded(self.query.touch(&(self.x - self.n * drop), &self.n), drop)
    }

    /// The force at `touch`, where the node has sunk by `drop` [m].
    #[inline(always)]
    pub(crate) fn loaded(&self, touch: Touch, drop: f64) -> Loaded {
        let m = touch.contact_normal;
        let overlap = touch.overlap.max(0.0);
        let force = self.elastic.normal_force(touch.coefficient, overlap, self.area);
        let cosine = -m.dot(&self.n);
        if !E::RUBS {
            let total = m * force;
            return Loaded {
                touch,
                cosine,
                normal_force: force,
                tangential: Vector3::zeros(),
                tangential_force: 0.0,
                slip: 0.0,
                stretch: Vector3::zeros(),
                normal_load: -total.dot(&self.n),
                lateral_load: total.dot(&self.heading),
            };
        }
        let spring = self.elastic.tangential_stiffness(touch.coefficient, overlap, self.area);
        let xi = self.trial_stretch + (self.n + m * cosine) * drop;
        let (length, limit) = (xi.norm(), self.friction * force);
        let kept = if spring * length > limit { limit / (spring * length) } else { 1.0 };
        let tangential = xi * (kept * spring);
        let total = m * force + tangential;
        Loaded {
            touch,
            cosine,
            normal_force: force,
            tangential,
            tangential_force: kept * spring * length,
            slip: (1.0 - kept) * length,
            stretch: xi * kept,
            normal_load: -total.dot(&self.n),
            lateral_load: total.dot(&self.heading),
        }
    }

    /// How fast a force in proportion to F falls as the node sinks, per unit of that force
    /// [1/m]: (dF/dd) c / F.
    #[inline(always)]
    pub(crate) fn relief(&self, at: &Loaded) -> f64 {
        let Touch { coefficient, overlap, .. } = at.touch;
        self.elastic.normal_stiffness(coefficient, overlap, self.area) * at.cosine / at.normal_force
    }

    /// The smallest drop within `limit` that brings `excess` to zero, or `limit` if none does; where
    /// it jumps below zero, the largest before that.
    /// `excess` is a `load` less its cap, above zero at `start`. Secants between brackets, the
    /// first along the load's own relief: the function is nearly linear.
    #[inline(always)]
    pub(crate) fn sink(
        &self,
        [from, limit]: [f64; 2],
        start: &Loaded,
        load: f64,
        excess: impl Fn(&Loaded) -> f64,
    ) -> (f64, Loaded) {
        if limit <= 0.0 {
            return (0.0, *start);
        }
        let slope = load * self.relief(start);
        let mut last = (0.0, excess(start));
        let tolerance = ROOT * (last.1 + slope * limit);
        let (mut low, mut high, mut asked) = (0.0, limit, false);
        let mut drop = (last.1 / slope).min(limit);
        let mut at = self.at(from + drop);
        for _ in 0..ROOT_STEPS {
            let g = excess(&at);
            if g.abs() <= tolerance || (g > 0.0 && drop == limit) {
                return (drop, at);
            }
            let secant = drop - g * (drop - last.0) / (g - last.1);
            last = (drop, g);
            if g > 0.0 {
                low = drop;
            } else {
                high = drop;
            }
            drop = match (secant > low && secant < high, asked) {
                (true, _) => secant,
                (false, false) => limit,
                (false, true) => 0.5 * (low + high),
            };
            asked |= drop == limit;
            at = self.at(from + drop);
        }
        // The excess jumps where another piece of the body comes upon the node: it stops before that.
        if excess(&at) < -tolerance { (low, self.at(from + low)) } else { (drop, at) }
    }
}

/// Energy of the spring of a node of `area` [m2] [J].
pub(crate) fn stored<E: Elastic>(elastic: E, coefficient: f64, spring: &Spring, area: f64) -> f64 {
    let Spring { overlap, tangential_force, .. } = *spring;
    let stiffness = elastic.tangential_stiffness(coefficient, overlap, area);
    let stretched =
        if stiffness > 0.0 { 0.5 * tangential_force * tangential_force / stiffness } else { 0.0 };
    elastic.normal_energy(coefficient, overlap, area) + stretched
}

/// Tolerance of the root relative to the fall of the excess over the limit, and the number of
/// steps after which it is taken as it is.
const ROOT: f64 = 1e-9;
const ROOT_STEPS: usize = 40;

/// Unit tangential direction in which a body of `velocity` moves over a node of normal `n`; zero
/// at rest.
#[inline]
pub(crate) fn heading(velocity: &Vector3<f64>, n: &Vector3<f64>) -> Vector3<f64> {
    let tangential = velocity - n * velocity.dot(n);
    let speed = tangential.norm();
    if speed > 0.0 { tangential / speed } else { tangential }
}

/// A node's answer to one step.
pub(crate) struct Answer {
    pub spring: Spring,
    pub loaded: Loaded,
    /// Change of the overlap over the step; of a node touched afresh, before it sank [m].
    pub overlap_change: f64,
}

/// Takes a node through one step; None when it is out of contact at the end.
#[inline(always)]
pub(crate) fn resolve<E: Elastic, Q: Query, F: Flow>(
    ground: impl Ground,
    flow: &F,
    node: &mut NodeStep<'_, E, Q>,
    old: &Spring,
    motion: &Motion,
) -> Option<Answer> {
    let trial = node.query.touch(&node.x, &node.n);
    if trial.overlap <= 0.0 {
        return None;
    }
    let m = trial.contact_normal;
    let was_in_contact = old.overlap > 0.0;
    let turning = motion.spin.cross(&trial.arm);
    let step = (motion.velocity + turning) * motion.dt;
    let approach = m.dot(&step);
    let foreseen = if was_in_contact { f64::INFINITY } else { approach.max(0.0) };
    if ground.misses(trial.overlap, foreseen, -m.dot(&node.n)) {
        return None;
    }
    // Share of the step spent in contact.
    let share =
        if was_in_contact || approach <= 0.0 { 1.0 } else { (trial.overlap / approach).min(1.0) };
    if E::RUBS {
        let carried = if was_in_contact { transport(&old.stretch, &m) } else { Vector3::zeros() };
        node.trial_stretch = carried + (step - m * approach) * share;
    }
    let advance = Advance {
        // v* splits the advance into its normal and tangential parts: the full material velocity
        // would let spin leak between the gates.
        step: motion.advance(&trial.arm, &m) * motion.dt,
        share,
        was_in_contact,
        overlap_change: trial.overlap - old.overlap,
    };
    let start = node.loaded(trial, 0.0);
    let (drop, loaded) = flow.flow(node, &start, &advance, old);
    let spring = Spring {
        stretch: loaded.stretch,
        overlap: loaded.touch.overlap.max(f64::MIN_POSITIVE),
        tangential_force: loaded.tangential_force,
        excess: match F::FACE_PRESSURE {
            true => Excess::default(),
            false => flow.excess(node.area, &loaded),
        },
        normal_load: loaded.normal_load,
        drop,
    };
    let overlap_change = match was_in_contact {
        true => (spring.overlap - old.overlap).abs(),
        false => trial.overlap,
    };
    Some(Answer { spring, loaded, overlap_change })
}

/// The body's advance over the step, as the flow laws split it.
pub(crate) struct Advance {
    /// dC = v* dt [m].
    pub step: Vector3<f64>,
    pub share: f64,
    pub was_in_contact: bool,
    pub overlap_change: f64,
}

/// The stretch turned into the new tangent plane, its length and so its energy kept.
fn transport(stretch: &Vector3<f64>, m: &Vector3<f64>) -> Vector3<f64> {
    let projected = stretch - m * stretch.dot(m);
    let (old, new) = (stretch.norm(), projected.norm());
    if new > 0.0 { projected * (old / new) } else { projected }
}

#[cfg(feature = "state")]
impl Spring {
    pub(crate) fn is_finite(&self) -> bool {
        let Self { overlap, tangential_force, excess, normal_load, .. } = self;
        let Drop { normal, lateral, archard } = &self.drop;
        let numbers = [overlap, tangential_force, normal_load, normal, lateral, archard];
        let numbers = numbers.into_iter().chain([&excess.normal, &excess.lateral]);
        finite(numbers.chain(self.stretch.iter())) && *overlap >= 0.0
    }
}

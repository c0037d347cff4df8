//! What a wear world is asked for, and what it counts.

use abrade::{Advance, EncounterSettings, Until};
use rapier::dynamics::RigidBodyHandle;

use crate::resolver::Resolve;

/// Contact steps of a body in a step of the embedder after which Auto hands it on: about a second.
const AUTO_STEPS: u64 = 1_000_000;

/// Settings of a [`WearWorld`](crate::WearWorld).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub struct WearSettings {
    /// Target relative time error of the wear volume [-].
    pub accuracy: f64,
    /// Keep the energy ledger.
    pub ledger: bool,
    /// Contact steps after which a body's contact is given up with an error, per step of the
    /// embedder. Under [`Resolve::Auto`], which then hands the body on, at most 1 000 000: larger ones
    /// take effect with [`Resolve::Micro`] or [`Resolve::Lockstep`].
    pub step_limit: u64,
    /// Which resolvers may be used.
    pub resolve: Resolve,
    /// Whether a step ends early, at the first instant at which a body has left the surfaces.
    /// Takes effect while exactly one body is registered with
    /// [`WearWorld::place`](crate::WearWorld::place): with several, or none, there is no single
    /// exit to stop at, and steps keep their full length.
    pub until: Until,
    /// Whether closed surfaces that have worn deep are renewed
    /// ([`abrade::Surface::renew`]) between their contacts, and what stands for them follows. The
    /// proxy's shape: a ball shrinks to the least one about its centre that holds all nodes, other
    /// convex shapes become the hull of the worn nodes, a mesh the worn mesh; compounds and height
    /// fields stay as they are. Mass, centre and inertia of a dynamic body whose only solid
    /// collider is the proxy: those of the worn solid, its mass spread evenly, on the proxy's own
    /// mass properties in place of densities and additional masses.
    pub renew: bool,
}

impl Default for WearSettings {
    fn default() -> Self {
        let EncounterSettings { accuracy, ledger, step_limit } = EncounterSettings::default();
        let resolve = Resolve::Auto;
        let until = Until::Duration;
        Self { accuracy, ledger, step_limit, resolve, until, renew: true }
    }
}

impl WearSettings {
    pub(crate) fn encounter(&self) -> EncounterSettings {
        EncounterSettings {
            accuracy: self.accuracy,
            ledger: self.ledger,
            step_limit: match self.resolve {
                Resolve::Auto => self.step_limit.min(AUTO_STEPS),
                _ => self.step_limit,
            },
        }
    }
}

/// What was done since the world was made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub struct Counters {
    /// Bodies looked at closely, step by step: those that could come near a wear surface, and
    /// those that were new or changed.
    pub looked: u64,
    /// Body steps resolved by Micro.
    pub micro: u64,
    /// Body steps resolved by QuasiStatic, and contacts among others that it pressed, step by step.
    pub quasi_static: u64,
    /// Body steps resolved by Lockstep.
    pub lockstep: u64,
    /// Blows between two bodies resolved by Collision.
    pub collision: u64,
    /// Times that a body near a wear surface was left to Rapier for a step, or its contact failed in it: what it had
    /// worn by then stays.
    pub refused: u64,
    /// Contact steps of the integrator.
    pub steps: u64,
    /// Nodes taken through the law.
    pub node_evaluations: u64,
}

impl Counters {
    pub(crate) fn add(&mut self, advance: &Advance) {
        self.micro += 1;
        self.steps += advance.steps;
        self.node_evaluations += advance.node_evaluations;
    }
}

/// What one step did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepReport {
    /// Time by which the world went on [s].
    pub dt: f64,
    /// The body that left the surfaces and ended the step.
    pub exited: Option<RigidBodyHandle>,
}

#[cfg(feature = "serde-serialize")]
impl Counters {
    /// True when none of them can overflow.
    pub(crate) fn are_sound(&self) -> bool {
        let Self {
            looked,
            micro,
            quasi_static,
            lockstep,
            collision,
            refused,
            steps,
            node_evaluations,
        } = self;
        let bodies = [looked, micro, quasi_static, lockstep, collision, refused];
        let all = bodies.into_iter().chain([steps, node_evaluations]);
        all.into_iter().all(|count| *count < u64::MAX / 2)
    }
}

//! What a run needs of the physics engine, whatever its precision.

use std::collections::BTreeMap;

use abrade::{Driven, Ledger, State, Surface};
use nalgebra::{Isometry3, Vector3};

use crate::run::RunError;

/// A world with wear surfaces and bodies, named by their index in the scene's order.
pub(crate) trait Engine {
    /// Gives a led surface the velocity with which it follows its path in the next step.
    fn lead(&mut self, surface: usize, stretch: &Stretch);

    /// Steps by at most `dt` [s], showing contact steps to `watch`.
    fn step(&mut self, dt: f64, watch: &mut dyn Watch) -> Result<Stepped, RunError>;

    /// Lets a body that has waited for its time come, as it starts.
    fn bring(&mut self, body: usize) -> Result<(), RunError>;

    /// Takes out a body that will meet nothing any more.
    fn take_out(&mut self, body: usize);

    /// State of a body in the world; of one that waits as it starts, of one that is gone as it left.
    fn state(&self, body: usize) -> State;

    /// A surface.
    fn surface(&self, surface: usize) -> &Surface;

    /// State of the body that a surface moves with, in the world; none for a surface at rest.
    fn carrier(&self, surface: usize) -> Option<State>;

    /// True while nodes carry force on a body.
    fn in_contact(&self, body: usize) -> bool;

    /// Impulse on a body [N s] and time [s] of its contacts that have not ended.
    fn open_contact(&self, body: usize) -> Option<(Vector3<f64>, f64)>;

    /// True while a body's own energies are part of the ledger: near a surface, or driven.
    fn has_ledger(&self, body: usize) -> bool;

    /// The course of a driven body.
    fn driven(&self, body: usize) -> Option<&Driven>;

    /// Energies of all contacts so far.
    fn ledger(&self) -> Ledger;

    /// What was done so far.
    fn counts(&self) -> Counts;
}

/// The part of a surface's path that is followed in a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch {
    /// Frames of the surface in the world, before and after.
    pub from: Isometry3<f64>,
    pub to: Isometry3<f64>,
    /// Length of the step [s].
    pub dt: f64,
    /// Time [s] in which what rounding took it off its path is made up for.
    pub recover: f64,
}

/// Sees contact steps.
pub(crate) trait Watch {
    /// Called once per contact step of a body that it looks at, body after body.
    fn sample(&mut self, sample: &Sample<'_>);

    /// Whether the next contact step of a body tells it anything.
    fn looks_at(&self, body: usize) -> bool;

    /// Whether it looks at any body.
    fn watches(&self) -> bool;
}

/// A contact step of one body, in the world.
pub(crate) struct Sample<'a> {
    pub body: usize,
    /// Time since the engine's step began [s].
    pub time: f64,
    pub state: State,
    /// Force of the surfaces on the body [N].
    pub force: Vector3<f64>,
    /// The surfaces it meets.
    pub surfaces: &'a [Met<'a>],
    /// The body's own energies.
    pub ledger: Option<&'a Ledger>,
}

/// A surface that a body meets.
pub(crate) struct Met<'a> {
    pub index: usize,
    pub surface: &'a Surface,
    /// State of the body that it moves with, in the world.
    pub carrier: Option<State>,
}

/// What a step did.
pub(crate) struct Stepped {
    pub dt: f64,
    /// True when a body's first exit ended it.
    pub exited: bool,
    pub ended: Vec<Ended>,
    /// Contacts that began: (body, surface).
    pub started: Vec<(usize, usize)>,
    /// Volumes displaced over contacts that ended: (body, volume [m3]), once for each surface.
    pub worn: Vec<(usize, f64)>,
    /// Bodies left to the engine near a surface: (body, surface, why); none for the surface's own.
    pub refused: Vec<(Option<usize>, usize, String)>,
}

/// The end of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ended {
    /// None for the body of a surface, which has met a wall.
    pub body: Option<usize>,
    pub impulse: Vector3<f64>,
    pub contact_time: f64,
}

/// What was done so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct Counts {
    pub micro: u64,
    pub quasi_static: u64,
    pub lockstep: u64,
    pub collision: u64,
    /// Body steps by "resolver: why it was not Micro".
    pub reasons: BTreeMap<String, u64>,
    pub steps: u64,
    pub node_evaluations: u64,
}

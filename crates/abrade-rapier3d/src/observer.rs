//! Watching the contact steps inside a step of the embedder.

use abrade::{Instant, Observer, State};
use nalgebra::{Isometry3, Vector3};
use rapier::dynamics::RigidBodyHandle;

use crate::surface::SurfaceId;
use crate::track::Trace;

/// An accepted contact step of one body.
pub struct MicroStep<'a, 'b> {
    /// The body.
    pub body: RigidBodyHandle,
    /// Time since the embedder's step began [s].
    pub time: f64,
    /// The frame of the integration, in the world.
    pub frame: &'a Isometry3<f64>,
    /// Names of the surfaces of `instant`, in its order.
    pub surfaces: &'a [SurfaceId],
    /// State, force, surfaces and ledger in that frame; its own time counts from the last call
    /// into the core.
    pub instant: &'a Instant<'a, 'b>,
}

/// Sees the accepted contact steps of Micro, of QuasiStatic on plates, of tools and of driven bodies. Islands, blows
/// that Collision runs, what lies on moving surfaces, and walls are not shown.
pub trait WearObserver {
    /// Called once per such step, body after body.
    fn micro_step(&mut self, step: &MicroStep<'_, '_>);

    /// Whether it sees anything: a step that is watched is done body after body, with the same
    /// results to the bit.
    fn watches(&self) -> bool {
        true
    }
}

impl MicroStep<'_, '_> {
    /// State of the body in the world.
    pub fn state_world(&self) -> State {
        self.instant.state.placed_by(self.frame)
    }

    /// Force of the surfaces on the body in the world [N].
    pub fn force_world(&self) -> Vector3<f64> {
        self.frame * self.instant.force
    }
}

/// Sees nothing.
impl WearObserver for () {
    fn micro_step(&mut self, _: &MicroStep<'_, '_>) {}

    fn watches(&self) -> bool {
        false
    }
}

/// Passes the core's instants on, with body, frame and time added.
pub(crate) struct Relay<'a> {
    pub observer: &'a mut dyn WearObserver,
    pub body: RigidBodyHandle,
    pub frame: Isometry3<f64>,
    pub surfaces: &'a [SurfaceId],
    /// Time of the embedder's step at which the call into the core began [s].
    pub began: f64,
    /// Where the centre of mass was, in `frame`.
    pub trace: Trace,
}

impl Observer for Relay<'_> {
    fn observe(&mut self, instant: &Instant<'_, '_>) {
        self.trace.go(self.began + instant.time, &instant.state.position);
        self.observer.micro_step(&MicroStep {
            body: self.body,
            time: self.began + instant.time,
            frame: &self.frame,
            surfaces: self.surfaces,
            instant,
        });
    }
}

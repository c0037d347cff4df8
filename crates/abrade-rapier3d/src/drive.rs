//! Driven bodies: kinematic in Rapier, carried by the core's indentation and slide.

use abrade::{Body, Drive, Driven, Ledger, PhysicsError, Placed};
use nalgebra::{Isometry3, Vector3};
use rapier::dynamics::{RigidBodyHandle, RigidBodySet, RigidBodyType};
use rapier::geometry::ColliderSet;

use crate::error::{Led, WearError};
use crate::micro;
use crate::observer::{Relay, WearObserver};
use crate::scalar;
use crate::surface::{SurfaceId, WornCollider};
use crate::track::Trace;
use crate::world::WearWorld;

/// A driven body and its course; the core's state is in the surface's frame.
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct DrivenBody {
    pub handle: RigidBodyHandle,
    surface: SurfaceId,
    body: Body,
    driven: Driven,
    indented: bool,
}

impl WearWorld {
    /// Drives `body`, whose state is given in the frame of `surface`: the first step presses it
    /// in, the following ones slide it. Its rigid body must be position-based kinematic; Rapier
    /// follows the core. A drive lasts until the rigid body is removed.
    ///
    /// # Errors
    /// There is no such body, or it is not kinematic and position-based, or it is driven or a tool
    /// already; a surface of another world; a drive that the surface's laws refuse.
    pub fn drive(
        &mut self,
        surface: SurfaceId,
        handle: RigidBodyHandle,
        mut body: Body,
        drive: Drive,
        bodies: &RigidBodySet,
    ) -> Result<(), WearError> {
        let rb = bodies.get(handle).filter(|rb| rb.is_kinematic());
        let rb = rb.ok_or(WearError::NotKinematic { body: handle })?;
        if rb.body_type() != RigidBodyType::KinematicPositionBased {
            return Err(WearError::NotByPosition { body: handle });
        }
        if self.find_tool(handle).is_some() {
            return Err(WearError::LedAlready { body: handle, led: Led::Tool });
        }
        if self.driven(handle).is_some() {
            return Err(WearError::LedAlready { body: handle, led: Led::Driven });
        }
        let worn = &self.worn(surface)?.surface;
        let driven = Driven::new(&mut body, worn, drive, self.settings.encounter())
            .map_err(|source| WearError::Physics { body: handle, surface, source })?;
        self.driven.push(DrivenBody { handle, surface, body, driven, indented: false });
        Ok(())
    }

    /// The course of a driven body.
    pub fn driven(&self, handle: RigidBodyHandle) -> Option<&Driven> {
        self.driven.iter().find(|d| d.handle == handle).map(|d| &d.driven)
    }

    /// Ends the drives of bodies that are gone.
    pub(crate) fn drop_driven(&mut self, bodies: &RigidBodySet) {
        for mut gone in self.driven.extract_if(.., |driven| !bodies.contains(driven.handle)) {
            let end = |placed: &mut [Placed<'_>]| gone.driven.end(placed);
            micro::end(&mut self.surfaces, &[gone.surface], None, end);
            self.closed += *gone.ledger();
        }
    }

    /// Carries every driven body through the step under way. One on a surface that nobody can meet stays where
    /// it is.
    pub(crate) fn carry_driven(
        &mut self,
        bodies: &mut RigidBodySet,
        colliders: &ColliderSet,
        observer: &mut dyn WearObserver,
    ) {
        let dt = self.current.dt;
        let mut all = std::mem::take(&mut self.driven);
        for driven in &mut all {
            let (body, surface) = (driven.handle, driven.surface);
            let worn = &mut self.surfaces[surface.0];
            let Some(frame) = worn.live_proxy(colliders).map(|proxy| worn.pose(proxy)) else {
                continue;
            };
            match driven.carry(worn, frame, dt, observer) {
                Ok(advance) => self.counters.add(&advance),
                Err(error) => self.fail(body, surface, error),
            }
            if let Some(rb) = bodies.get_mut(body) {
                let state = driven.body.state.placed_by(&frame);
                rb.set_next_kinematic_position(scalar::to_pose(&state.pose()));
            }
        }
        self.driven = all;
    }
}

impl DrivenBody {
    fn carry(
        &mut self,
        worn: &mut WornCollider,
        frame: Isometry3<f64>,
        dt: f64,
        observer: &mut dyn WearObserver,
    ) -> Result<abrade::Advance, PhysicsError> {
        let trace = Trace::new(self.body.state.position, Vector3::zeros(), dt);
        let surfaces = &[self.surface];
        let mut relay = Relay { observer, body: self.handle, frame, surfaces, began: 0.0, trace };
        let pose = Isometry3::identity();
        let mut placed = [Placed::at_rest(worn.owned(), pose)];
        let mut pressed = abrade::Advance::default();
        if !self.indented {
            pressed = self.driven.indent(&mut self.body, &mut placed, &mut relay)?;
            self.indented = true;
        }
        let mut advance = self.driven.advance(&mut self.body, &mut placed, dt, &mut relay)?;
        advance.steps += pressed.steps;
        advance.node_evaluations += pressed.node_evaluations;
        Ok(advance)
    }

    /// State in the world.
    pub fn state(&self, frame: &Isometry3<f64>) -> abrade::State {
        self.body.state.placed_by(frame)
    }

    pub fn ledger(&self) -> &Ledger {
        self.driven.ledger()
    }

    pub fn surface(&self) -> SurfaceId {
        self.surface
    }
}

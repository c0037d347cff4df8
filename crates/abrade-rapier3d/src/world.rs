//! The registry: wear surfaces on colliders, and what is known of the bodies that wear them.

use std::ops::Index;

use abrade::{Body, Ledger, State, Surface};
use nalgebra::{Isometry3, Translation3};
use rapier::dynamics::{RigidBodyHandle, RigidBodySet};
use rapier::geometry::{ColliderHandle, ColliderSet};
use rapier::pipeline::ActiveHooks;

use crate::error::WearError;
use crate::event::WearEvent;
use crate::gate::Lie;
use crate::guard::Taken;
use crate::obstacle::{Obstacles, extent};
use crate::settings::{Counters, WearSettings};
use crate::shadow;
use crate::steer::Steered;
use crate::surface::{SurfaceId, WornCollider};
use crate::tracked::Tracked;

/// Wear surfaces and the bodies that wear them, beside a physics world of Rapier's.
#[derive(Default)]
pub struct WearWorld {
    pub(crate) settings: WearSettings,
    pub(crate) surfaces: Vec<WornCollider>,
    /// By index of the body's handle, so that every loop runs in that order.
    pub(crate) bodies: Vec<Option<Tracked>>,
    pub(crate) taken: Taken,
    pub(crate) obstacles: Obstacles,
    pub(crate) lies: Vec<Lie>,
    /// Bodies near a wear surface in this step.
    pub(crate) candidates: Vec<RigidBodyHandle>,
    /// Bodies whose colliders have changed.
    pub(crate) stale: Vec<RigidBodyHandle>,
    /// Bodies carried through this step.
    pub(crate) integrated: Vec<Integrated>,
    pub(crate) steered: Vec<Steered>,
    pub(crate) events: Vec<WearEvent>,
    pub(crate) counters: Counters,
    /// Energies of encounters that have ended.
    pub(crate) closed: Ledger,
    /// The step under way.
    pub(crate) current: Current,
}

/// Where the integration of a body ended, given in `frame`.
pub(crate) struct Integrated {
    pub body: RigidBodyHandle,
    pub end: State,
    pub frame: Isometry3<f64>,
}

/// What is known of the step under way.
#[derive(Default)]
pub(crate) struct Current {
    pub dt: f64,
    pub exited: Option<RigidBodyHandle>,
    pub failure: Option<WearError>,
}

impl WearWorld {
    /// An empty registry.
    pub fn new(settings: WearSettings) -> Self {
        Self { settings, ..Self::default() }
    }

    /// Puts `surface` on the collider `proxy`, their frames being one. For a flat surface the
    /// proxy's z = 0 plane must be its top, as a half-space's is; see
    /// [`WearWorld::insert_on_top`] for boxes.
    ///
    /// # Errors
    /// There is no such collider, or it carries a surface already.
    pub fn insert(
        &mut self,
        surface: Surface,
        proxy: ColliderHandle,
        colliders: &mut ColliderSet,
    ) -> Result<SurfaceId, WearError> {
        self.insert_at(surface, proxy, Isometry3::identity(), colliders)
    }

    /// Puts `surface` on the top, towards its +z, of the collider `proxy`.
    ///
    /// # Errors
    /// There is no such collider, or it carries a surface already.
    pub fn insert_on_top(
        &mut self,
        surface: Surface,
        proxy: ColliderHandle,
        colliders: &mut ColliderSet,
    ) -> Result<SurfaceId, WearError> {
        let missing = WearError::NoSuchCollider { collider: proxy };
        let shape = colliders.get(proxy).ok_or(missing)?.shape();
        let top = extent(&shape.compute_local_aabb()).high.z;
        let offset = Isometry3::from(Translation3::new(0.0, 0.0, top));
        self.insert_at(surface, proxy, offset, colliders)
    }

    /// Puts `surface` on the collider `proxy`, with its frame at `offset` in the proxy's. Sets
    /// the proxy's flag `FILTER_CONTACT_PAIRS`, which must stay set. The proxy should end where
    /// the nodes do: outside of them a body that wears falls through it.
    ///
    /// # Errors
    /// There is no such collider, or it carries a surface already.
    pub fn insert_at(
        &mut self,
        surface: Surface,
        proxy: ColliderHandle,
        offset: Isometry3<f64>,
        colliders: &mut ColliderSet,
    ) -> Result<SurfaceId, WearError> {
        let missing = WearError::NoSuchCollider { collider: proxy };
        let collider = colliders.get_mut(proxy).ok_or(missing)?;
        if let Some(at) = self.surfaces.iter().position(|worn| worn.proxy == proxy) {
            return Err(WearError::ColliderTaken { collider: proxy, surface: SurfaceId(at) });
        }
        let user_hooks = collider.active_hooks();
        collider.set_active_hooks(user_hooks | ActiveHooks::FILTER_CONTACT_PAIRS);
        self.taken.add_proxy(proxy, user_hooks);
        self.surfaces.push(WornCollider::new(surface, proxy, offset));
        Ok(SurfaceId(self.surfaces.len() - 1))
    }

    /// Lays a surface's frame at `pose` in the world exactly, where the proxy's pose can only
    /// say it rounded. Holds until the proxy is moved.
    ///
    /// # Errors
    /// The proxy is gone.
    pub fn place_surface(
        &mut self,
        surface: SurfaceId,
        pose: Isometry3<f64>,
        colliders: &ColliderSet,
    ) -> Result<(), WearError> {
        let worn = &mut self.surfaces[surface.0];
        let missing = WearError::NoSuchCollider { collider: worn.proxy };
        worn.place(colliders.get(worn.proxy).ok_or(missing)?, pose);
        Ok(())
    }

    /// Registers a body with its exact shape and inertia, and moves it to its exact state, given
    /// in the world. Its frame must be that of the rigid body, moved to the centre of mass.
    ///
    /// # Errors
    /// There is no such body, or it is not dynamic.
    pub fn place(
        &mut self,
        handle: RigidBodyHandle,
        body: Body,
        bodies: &mut RigidBodySet,
        colliders: &ColliderSet,
    ) -> Result<(), WearError> {
        self.place_in(Isometry3::identity(), handle, body, bodies, colliders)
    }

    /// As [`WearWorld::place`], with the state given in the frame of `surface`: exact wherever
    /// the surface lies.
    ///
    /// # Errors
    /// There is no such body, or it is not dynamic; the surface's proxy is gone.
    pub fn place_on(
        &mut self,
        surface: SurfaceId,
        handle: RigidBodyHandle,
        body: Body,
        bodies: &mut RigidBodySet,
        colliders: &ColliderSet,
    ) -> Result<(), WearError> {
        let frame = self.frame(surface, colliders)?;
        self.place_in(frame, handle, body, bodies, colliders)
    }

    fn place_in(
        &mut self,
        frame: Isometry3<f64>,
        handle: RigidBodyHandle,
        body: Body,
        bodies: &mut RigidBodySet,
        colliders: &ColliderSet,
    ) -> Result<(), WearError> {
        let missing = WearError::NoSuchBody { body: handle };
        let rb = bodies.get_mut(handle).filter(|rb| rb.is_dynamic()).ok_or(missing)?;
        rb.recompute_mass_properties_from_colliders(colliders);
        let tracked = Tracked::slot(&mut self.bodies, handle);
        self.closed += tracked.end(&mut self.events);
        tracked.shadow = Some(shadow::write(rb, frame, body.state));
        rb.wake_up(true);
        tracked.register(body);
        Ok(())
    }

    /// Frame of a surface in the world.
    ///
    /// # Errors
    /// The proxy is gone.
    pub fn frame(
        &self,
        surface: SurfaceId,
        colliders: &ColliderSet,
    ) -> Result<Isometry3<f64>, WearError> {
        let worn = &self.surfaces[surface.0];
        let missing = WearError::NoSuchCollider { collider: worn.proxy };
        Ok(worn.pose(colliders.get(worn.proxy).ok_or(missing)?))
    }

    /// State of a body in the world: exact as long as it was resolved here and not moved since,
    /// else as Rapier holds it.
    pub fn state(&self, handle: RigidBodyHandle, bodies: &RigidBodySet) -> Option<State> {
        self.state_from(&Isometry3::identity(), handle, bodies)
    }

    /// State of a body in the frame that `frame` places, such as a surface's.
    pub fn state_from(
        &self,
        frame: &Isometry3<f64>,
        handle: RigidBodyHandle,
        bodies: &RigidBodySet,
    ) -> Option<State> {
        let rb = bodies.get(handle)?;
        let shadow = self.tracked(handle).and_then(|tracked| tracked.shadow.as_ref());
        Some(shadow::read(rb, shadow, frame))
    }

    /// True while a node carries force on the body.
    pub fn in_contact(&self, handle: RigidBodyHandle) -> bool {
        let live = self.tracked(handle).and_then(|tracked| tracked.live.as_ref());
        live.is_some_and(|live| live.encounter.in_contact())
    }

    fn tracked(&self, handle: RigidBodyHandle) -> Option<&Tracked> {
        let slot = self.bodies.get(handle.into_raw_parts().0 as usize)?.as_ref();
        slot.filter(|tracked| tracked.handle == handle)
    }

    /// The surfaces, in the order of insertion.
    pub fn surfaces(&self) -> impl Iterator<Item = (SurfaceId, &Surface)> {
        self.surfaces.iter().enumerate().map(|(id, worn)| (SurfaceId(id), &worn.surface))
    }

    /// What happened in the last step.
    pub fn events(&self) -> &[WearEvent] {
        &self.events
    }

    /// The energies of all contacts so far [J]; zeros unless asked for.
    pub fn ledger(&self) -> Ledger {
        let mut sum = self.closed;
        for live in self.bodies.iter().flatten().filter_map(|tracked| tracked.live.as_ref()) {
            sum += *live.encounter.ledger();
        }
        sum
    }

    /// What was done since the world was made.
    pub fn counters(&self) -> &Counters {
        &self.counters
    }
}

impl Index<SurfaceId> for WearWorld {
    type Output = Surface;

    fn index(&self, id: SurfaceId) -> &Surface {
        &self.surfaces[id.0].surface
    }
}

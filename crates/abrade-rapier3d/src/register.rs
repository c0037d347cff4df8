//! Registering: wear surfaces on colliders, and bodies whose exact state is known.

use abrade::{Body, Surface};
use nalgebra::{Isometry3, Translation3};
use rapier::dynamics::{RigidBodyHandle, RigidBodySet};
use rapier::geometry::{ColliderHandle, ColliderSet};
use rapier::pipeline::ActiveHooks;

use crate::error::WearError;
use crate::obstacle::extent;
use crate::shadow;
use crate::surface::{SurfaceId, WornCollider};
use crate::tracked::Tracked;
use crate::world::WearWorld;

impl WearWorld {
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
    /// the proxy's flags `FILTER_CONTACT_PAIRS` and `MODIFY_SOLVER_CONTACTS`, which must stay set.
    /// The proxy should end where the nodes do: outside of them a body that wears falls through it.
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
        let ours = ActiveHooks::FILTER_CONTACT_PAIRS | ActiveHooks::MODIFY_SOLVER_CONTACTS;
        collider.set_active_hooks(user_hooks | ours);
        self.taken.add_proxy(proxy, user_hooks);
        self.surfaces.push(WornCollider::new(surface, proxy, offset));
        Ok(SurfaceId(self.surfaces.len() - 1))
    }

    /// Lays a surface's frame at `pose` in the world exactly, where the proxy's pose can only
    /// say it rounded. Holds until the proxy is moved.
    ///
    /// # Errors
    /// The surface is not of this world, or its proxy is gone.
    pub fn place_surface(
        &mut self,
        surface: SurfaceId,
        pose: Isometry3<f64>,
        colliders: &ColliderSet,
    ) -> Result<(), WearError> {
        self.worn(surface)?;
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
    /// There is no such body, or it is not dynamic; the surface is not of this world, or its proxy is gone.
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
        self.drop_gone(bodies);
        let missing = WearError::NoSuchBody { body: handle };
        let rb = bodies.get_mut(handle).filter(|rb| rb.is_dynamic()).ok_or(missing)?;
        rb.recompute_mass_properties_from_colliders(colliders);
        let tracked = Tracked::slot(&mut self.bodies, handle);
        tracked.leave(&mut self.surfaces, &mut self.closed, &mut self.events);
        tracked.shadow = Some(shadow::write(rb, frame, body.state));
        rb.wake_up(true);
        if !tracked.registered {
            self.registered.push(handle);
        }
        tracked.register(body);
        self.glances.forget(handle);
        Ok(())
    }
}

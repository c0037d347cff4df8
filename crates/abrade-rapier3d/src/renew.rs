//! Deep wear: a solid that has worn deep, and that nothing touches, is made the undeformed one, and
//! what stands for it in Rapier's world follows: the shape of its proxy, and mass, centre and
//! inertia of a dynamic body that is nothing but this solid.
//!
//! The new proxy holds every node, so that whatever Rapier keeps apart from it is clear of the
//! surface: an encounter can begin wherever Rapier has left the two.

use abrade::{Carrier, Inertia, Loads};
use nalgebra::{Isometry3, Point3};
use rapier::dynamics::{MassProperties, RigidBody, RigidBodyHandle};
use rapier::geometry::{Collider, ColliderSet};

use crate::event::WearEvent;
use crate::surface::{SurfaceId, WornCollider};
use crate::tracked::Tracked;
use crate::view::WorldView;
use crate::world::WearWorld;
use crate::{derive, scalar, shadow, stand_in, steer};

/// Pitches of depth beyond which what lies, slides or rolls on a solid does not keep it from being
/// renewed.
const LATE: f64 = 1.0;

/// A worn solid in the frame of its rigid body.
struct Left {
    inertia: Inertia,
    centre: Point3<f64>,
}

impl WearWorld {
    /// Renews the solids that are due and that no contact holds.
    pub(crate) fn renew_solids(&mut self, world: &mut WorldView<'_>) {
        if !self.settings.renew {
            return;
        }
        for surface in (0..self.surfaces.len()).map(SurfaceId) {
            let worn = &self.surfaces[surface.0];
            let Some(proxy) = world.colliders.get(worn.proxy) else { continue };
            let parent = proxy.parent();
            if !worn.is_due() || self.is_held(surface, parent, world) {
                continue;
            }
            self.break_rubs(surface);
            match self.surfaces[surface.0].renew() {
                Ok(lost) => {
                    self.follow(surface, parent, lost, world);
                    self.events.push(WearEvent::Renewed { surface });
                }
                Err(error) => self.events.push(WearEvent::NotRenewed { surface, error }),
            }
        }
    }

    /// True while a contact with the surface is open, or one of the body that it is on.
    fn is_held(
        &self,
        surface: SurfaceId,
        parent: Option<RigidBodyHandle>,
        world: &WorldView<'_>,
    ) -> bool {
        let there = self.bodies.iter().flatten().filter(|t| world.bodies.contains(t.handle));
        let mut holding = there.filter(|tracked| match Some(tracked.handle) == parent {
            true => tracked.touched().next().is_some(),
            false => tracked.touched().any(|touched| touched == surface),
        });
        let worn = &self.surfaces[surface.0].surface;
        let is_rubbed = worn.deepest() < LATE * worn.pitch() && self.is_rubbed(surface);
        is_rubbed
            || holding.next().is_some()
            || self.tools.iter().any(|tool| tool.touches(surface))
            || self.driven.iter().any(|driven| driven.surface() == surface)
    }

    /// Makes proxy and body those of a renewed solid, which has lost a volume [m3].
    fn follow(
        &mut self,
        surface: SurfaceId,
        parent: Option<RigidBodyHandle>,
        lost: f64,
        world: &mut WorldView<'_>,
    ) {
        let density = parent.and_then(|body| self.density(surface, body, lost, world));
        let worn = &self.surfaces[surface.0];
        let Some(proxy) = world.colliders.get_mut(worn.proxy) else { return };
        let weighed = proxy.mass_properties();
        if let Some(shape) = stand_in::shape(proxy, worn) {
            proxy.set_shape(shape);
        }
        let Some(body) = parent else { return };
        self.glances.forget(body);
        let Some(rb) = world.bodies.get_mut(body) else { return };
        let density = density.filter(|_| rb.is_dynamic());
        let Some(left) = density.and_then(|density| Left::of(worn, proxy, density)) else {
            // The other shape must not change what the body weighs, and what it turns about.
            return proxy.set_mass_properties(weighed);
        };
        proxy.set_mass_properties(left.mass_properties(proxy));
        rb.set_additional_mass_properties(MassProperties::default(), false);
        self.reweigh(body, &left, world);
    }

    /// Density of the solid that is all of a dynamic body, which weighs what it did before the solid
    /// has lost a volume [m3]; the mass is spread evenly [kg/m3].
    fn density(
        &self,
        surface: SurfaceId,
        body: RigidBodyHandle,
        lost: f64,
        world: &WorldView<'_>,
    ) -> Option<f64> {
        let worn = &self.surfaces[surface.0];
        let rb = world.bodies.get(body)?;
        let mut solids = derive::solids(rb, world.colliders, true).map(|(handle, _)| handle);
        if solids.next() != Some(worn.proxy) || solids.next().is_some() {
            return None;
        }
        let registered = Tracked::find(&self.bodies, body).and_then(Tracked::registered);
        let mass = match registered {
            Some(body) => body.inertia.mass,
            None => scalar::wide(rb.mass()) - sensors_mass(rb, world.colliders),
        };
        let (whole, _) = worn.surface.mass_properties(1.0)?;
        let density = mass / (whole.mass + lost);
        (density > 0.0 && density.is_finite()).then_some(density)
    }

    /// Gives a body what is left of it, with the motion of the material that stays.
    fn reweigh(&mut self, body: RigidBodyHandle, left: &Left, world: &mut WorldView<'_>) {
        let Some(rb) = world.bodies.get_mut(body) else { return };
        let colliders = &mut *world.colliders;
        let tracked = Tracked::slot(&mut self.bodies, body);
        tracked.leave(&mut self.surfaces, &mut self.closed, &mut self.events);
        let exact = tracked.shadow.filter(|shadow| shadow.holds(rb));
        let frame = exact.map_or_else(Isometry3::identity, |shadow| shadow.frame);
        let state = shadow::read(rb, exact.as_ref(), &frame);
        let before = scalar::vector(rb.local_center_of_mass());
        rb.recompute_mass_properties_from_colliders(colliders);
        let after = scalar::vector(rb.local_center_of_mass());
        let mut carrier = Carrier { state, inertia: Some(left.inertia), loads: Loads::default() };
        let origin = state.pose() * Isometry3::from(-before);
        carrier.reduce_to(&origin, &left.inertia, &after.into());
        tracked.renew(rb, colliders, left.inertia, &(after - before));
        tracked.shadow = exact.map(|_| shadow::write(rb, frame, carrier.state));
        if exact.is_none() {
            rb.set_linvel(scalar::to_vector(&carrier.state.velocity), false);
        }
        steer::carry_colliders(rb, colliders);
    }
}

/// Mass of the colliders that are not solid [kg].
fn sensors_mass(rb: &RigidBody, colliders: &ColliderSet) -> f64 {
    let sensors =
        derive::solids(rb, colliders, false).filter(|(_, c)| c.is_enabled() && c.is_sensor());
    sensors.map(|(_, sensor)| scalar::wide(sensor.mass_properties().mass())).sum()
}

/// Where the surface on `proxy` lies in the frame of its rigid body.
fn place(worn: &WornCollider, proxy: &Collider) -> Isometry3<f64> {
    let local = proxy.position_wrt_parent().map_or_else(Isometry3::identity, scalar::pose);
    local * worn.offset
}

impl Left {
    /// None for a strip, and for a solid that Rapier's numbers cannot say.
    fn of(worn: &WornCollider, proxy: &Collider, density: f64) -> Option<Self> {
        let (Inertia { mass, tensor }, centre) = worn.surface.mass_properties(density)?;
        let place = place(worn, proxy);
        let turn = place.rotation.to_rotation_matrix();
        let tensor = turn * tensor * turn.inverse();
        let centre = place * centre;
        let mut numbers = tensor.iter().chain(centre.iter()).chain([&mass]);
        let sound = mass > 0.0 && numbers.all(|x| scalar::holds(*x));
        sound.then_some(Self { inertia: Inertia { mass, tensor }, centre })
    }

    /// The same in the frame of the collider, for Rapier.
    fn mass_properties(&self, proxy: &Collider) -> MassProperties {
        let local = proxy.position_wrt_parent().map_or_else(Isometry3::identity, scalar::pose);
        let (moments, axes) = self.inertia.principal();
        MassProperties::with_principal_inertia_frame(
            scalar::to_vector(&(local.inverse() * self.centre).coords),
            scalar::narrow(self.inertia.mass),
            scalar::to_vector(&moments),
            scalar::to_rotation(&(local.rotation.inverse() * axes)),
        )
    }
}

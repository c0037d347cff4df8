//! A body that wears itself: its only solid collider is the proxy of a closed surface, its skin. Micro
//! carries it on one surface at a time, of which it wears the nodes as that wears its own.

use abrade::{Body, Encounter, PhysicsError, Skin, Surface, can_meet};
use nalgebra::Isometry3;
use rapier::dynamics::RigidBody;

use crate::event::Refusal;
use crate::gate::{self, Course, Lie};
use crate::resolver::Resolve;
use crate::start::{Scene, Start};
use crate::surface::{SurfaceId, WornCollider};
use crate::tracked::Tracked;
use crate::{derive, scalar};

impl Scene<'_> {
    /// The skin of a body, and its frame in that of the body, if it wears on the one surface that it
    /// is near. Where their laws cannot meet, it wears that one alone; on plates at rest a body that is
    /// near more than one is carried without its skin.
    pub fn skin(
        &self,
        rb: &RigidBody,
        tracked: &Tracked,
    ) -> Result<Option<(SurfaceId, Isometry3<f64>)>, Refusal> {
        let is_own = |worn: &WornCollider| rb.colliders().contains(&worn.proxy);
        let own = |worn: &WornCollider| is_own(worn) && !worn.surface.is_flat();
        let Some(at) = self.surfaces.iter().position(own) else { return Ok(None) };
        let worn = &self.surfaces[at];
        let mut solids = derive::solids(rb, self.world.colliders, true);
        let proxy = solids.next().filter(|(handle, _)| *handle == worn.proxy);
        let alone = solids.next().is_none() && tracked.near.len() == 1;
        if let (true, [met]) = (alone, &tracked.near[..])
            && !can_meet(&self.surfaces[met.0].surface, &worn.surface)
        {
            return Ok(None);
        }
        if let (Some((_, proxy)), true) = (proxy, alone) {
            let local = proxy.position_wrt_parent().map_or_else(Isometry3::identity, scalar::pose);
            let com = Isometry3::from(-scalar::vector(rb.local_center_of_mass()));
            return Ok(Some((SurfaceId(at), com * local * worn.offset)));
        }
        let plate = |id: &SurfaceId| gate::can_hold(self.lies, self.surfaces, *id);
        match self.settings.resolve != Resolve::Auto || tracked.near.iter().all(plate) {
            true => Ok(None),
            false => Err(Refusal::Wears),
        }
    }

    /// True when a body that wears itself could come near another surface than `met`.
    pub fn meets_others(&self, rb: &RigidBody, met: SurfaceId, course: &Course) -> bool {
        let reach = course.reach(&Isometry3::identity(), self.dt);
        let own = |lie: &Lie| rb.colliders().contains(&self.surfaces[lie.id.0].proxy);
        let mut others = self.lies.iter().filter(|lie| lie.id != met && !own(lie));
        others.any(|lie| lie.extent.meets(&reach))
    }

    /// A new encounter of a body and its skin with the surface that it is near.
    pub fn encounter_of_two(&self, start: &Start, body: &Body) -> Result<Encounter, PhysicsError> {
        let Some((id, pose)) = start.skin else {
            return Err(PhysicsError::Unsupported { what: "a body without a skin" });
        };
        // Asked about, not worn.
        let mut own = Surface::leaf(&self.surfaces[id.0].surface);
        let skin = Skin { surface: &mut own, pose };
        let met = &*self.surfaces[start.surfaces[0].0].surface;
        Encounter::of_two(body, &skin, met, self.settings.encounter())
    }
}

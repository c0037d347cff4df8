//! A surface on a dynamic body: what strikes it moves it, so both go through the step together, and
//! nothing else may come near either of them.

use abrade::Inertia;
use nalgebra::Isometry3;
use rapier::dynamics::{RigidBody, RigidBodyHandle};

use crate::derive;
use crate::event::Refusal;
use crate::extent::Extent;
use crate::gate::{Course, Lead, Lie};
use crate::obstacle::Search;
use crate::start::Scene;
use crate::surface::{SurfaceId, WornCollider};
use crate::track::Track;

/// The dynamic body that a surface is on.
#[derive(Clone, Copy)]
pub(crate) struct Free {
    pub body: RigidBodyHandle,
    pub inertia: Inertia,
}

/// The lead of the free surface among `near`, if there is one.
pub(crate) fn lead(lies: &[Lie], near: &[SurfaceId]) -> Option<(Lead, Free)> {
    near.iter().find_map(|id| {
        let lead = Lie::find(lies, *id)?.lead?;
        Some((lead, lead.free?))
    })
}

/// Box around wherever the body of a free surface, of `radius` [m], may be flung over `dt` [s] by
/// the body of `course`, in the world: an elastic blow gives it twice the speed of approach.
pub(crate) fn reach(lead: &Lead, radius: f64, course: &Course, dt: f64) -> Extent {
    let striker = course.state.velocity.norm()
        + course.state.spin.norm() * course.radius()
        + course.acceleration.norm() * dt;
    let speed = lead.speed + 2.0 * (lead.speed + striker);
    let at = lead.state.position;
    Extent { low: at, high: at }.grown(radius + speed * dt)
}

impl Scene<'_> {
    /// Why `body` may not be carried on the surfaces `near` it, if one of them is free, or if it
    /// could meet a free one that has been carried already.
    pub fn bound_by_free(
        &self,
        own: &RigidBody,
        body: RigidBodyHandle,
        near: &[SurfaceId],
        course: &Course,
    ) -> Option<Refusal> {
        let reach = course.reach(&Isometry3::identity(), self.dt);
        if self.carried.iter().any(|(_, extent)| extent.meets(&reach)) {
            return Some(Refusal::SurfaceMoves);
        }
        let (lead, free) = lead(self.lies, near)?;
        let alone = near.len() == 1
            && !self.is_candidate(free.body, own)
            && !self.world.jointed(free.body)
            && self.world.bodies.get(free.body).is_some_and(|rb| {
                rb.locked_axes().is_empty()
                    && !self.meets(rb, [body, free.body], own, &lead, course)
            });
        (!alone).then_some(Refusal::SurfaceMoves)
    }

    /// Box around wherever the body `rb` of a free surface may be flung by the body of `course`.
    pub fn reach_of(&self, rb: &RigidBody, lead: &Lead, course: &Course) -> Extent {
        let radius = derive::radius(rb, self.world.colliders);
        reach(lead, radius, course, self.dt)
    }

    /// True when the body of a free surface is near one itself, but for that of the body `own`.
    fn is_candidate(&self, free: RigidBodyHandle, own: &RigidBody) -> bool {
        let is_own = |worn: &WornCollider| own.colliders().contains(&worn.proxy);
        self.candidates.contains(&free) && !self.surfaces.iter().any(is_own)
    }

    /// True when something but `body` could meet the body `rb` of a free surface.
    fn meets(
        &self,
        rb: &RigidBody,
        [body, free]: [RigidBodyHandle; 2],
        own: &RigidBody,
        lead: &Lead,
        course: &Course,
    ) -> bool {
        let reach = self.reach_of(rb, lead, course);
        let mine = |lie: &Lie| own.colliders().contains(&self.surfaces[lie.id.0].proxy);
        let other =
            |lie: &Lie| !mine(lie) && lie.lead.and_then(|l| l.free).is_none_or(|f| f.body != free);
        if self.lies.iter().any(|lie| other(lie) && lie.extent.meets(&reach)) {
            return true;
        }
        let (track, frame) = (&Track::still(reach), &Isometry3::identity());
        let (bodies, own) = (&[body, free][..], rb.colliders());
        let search = Search { bodies, own, track, frame, colliders: self.world.colliders };
        self.obstacles.in_way(&search).is_some()
    }
}

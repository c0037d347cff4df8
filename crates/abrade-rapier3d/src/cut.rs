//! One contact of a tool: with one surface, carried by the core as that of a body that nothing moves.
//!
//! A surface that is at rest or led is cut wherever it is. One on a dynamic body, the workpiece, goes
//! through the step with the tool if nothing else could meet it; else Rapier pushes it, and it wears by
//! the blows of that contact.

use abrade::{Body, Encounter, Loads, PhysicsError, State, Until};
use nalgebra::{Isometry3, Vector3};
use rapier::dynamics::{RigidBody, RigidBodyHandle};
use rapier::geometry::{Collider, ColliderHandle};

use crate::booking::{Booking, Contact};
use crate::event::Refusal;
use crate::extent::Extent;
use crate::free::{self, Free};
use crate::gate::{self, Course, Lead, Lie};
use crate::observer::{Relay, WearObserver};
use crate::obstacle::Search;
use crate::resolve::Left;
use crate::resolver::Resolve;
use crate::surface::SurfaceId;
use crate::tool::Tool;
use crate::track::{Trace, Track};
use crate::tracked::Tracked;
use crate::view::WorldView;
use crate::world::{Integrated, WearWorld};
use crate::{derive, micro, shadow};

/// A running contact of a tool with a surface.
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Cut {
    pub surface: SurfaceId,
    pub encounter: Encounter,
    /// The frame that it goes on in: that of the surface when it began.
    pub frame: Isometry3<f64>,
    /// The surface has moved since.
    moves: bool,
    pub contact: Option<Contact>,
}

impl WearWorld {
    /// Leads a tool in `state` through one surface; `body` is the tool in the core.
    pub(crate) fn cut(
        &mut self,
        tool: &mut Tool,
        body: &mut Body,
        surface: SurfaceId,
        state: &State,
        world: &WorldView<'_>,
        observer: &mut dyn WearObserver,
    ) -> Result<(), Left> {
        let Some(lie) = Lie::find(&self.lies, surface) else { return Ok(()) };
        let free = lie.lead.and_then(|lead| Some((lead, lead.free?)));
        if free.is_some_and(|(_, free)| self.lets_sleep(tool.handle, &free, state, world)) {
            return Ok(());
        }
        let reach = match &free {
            Some(pair) => Some(self.reach_of_alone(tool, surface, pair, state, world)?),
            None => None,
        };
        let mut cut = self.take_cut(tool, surface, body, world)?;
        let (frame, dt, handle) = (cut.frame, self.current.dt, tool.handle);
        body.state = state.seen_from(&frame);
        let trace = Trace::new(body.state.position, Vector3::zeros(), dt);
        let surfaces = &[surface];
        let mut relay = Relay { observer, body: handle, frame, surfaces, began: 0.0, trace };
        let seat = micro::seat(surface, &self.lies, &frame);
        let mut placed = micro::place(&mut self.surfaces, surface, seat);
        let (loads, until) = (Loads::default(), Until::Duration);
        let done = cut.encounter.advance(body, &mut placed, &loads, dt, until, &mut relay);
        let end = micro::carrier(&placed);
        let volume = self.surfaces[surface.0].owned().settle().displaced();
        let worn = [(surface, volume)];
        match &done {
            Ok(advance) => {
                let (impulse, contact_time) = (frame * advance.impulse, advance.contact_time);
                let touches = cut.encounter.in_contact();
                let booking = Booking { impulse, contact_time, touches };
                Contact::book(&mut cut.contact, handle, &booking, &worn, &mut self.events);
                self.counters.add(advance);
                tool.load.take(&frame, advance);
            }
            Err(_) => Contact::book_failed(&mut cut.contact, handle, &worn, &mut self.events),
        }
        tool.cuts.push(cut);
        let time = done?.time;
        shadow::check(&body.state, time)?;
        if let (Some((_, free)), Some(end), Some(reach)) = (free, end, reach) {
            shadow::check(&end, time)?;
            self.integrated.push(Integrated { body: free.body, end, frame });
            self.current.carried.push((free.body, reach));
            let own = world.bodies.get(handle).map_or(&[][..], RigidBody::colliders);
            own.iter().for_each(|collider| self.taken.add_wall(free.body, *collider));
        }
        tool.end.get_or_insert((frame, body.state));
        Ok(())
    }

    /// Takes the contact of a tool with a surface to go on with it; a new one where there is none, or
    /// where the surface is not where it was.
    fn take_cut(
        &mut self,
        tool: &mut Tool,
        surface: SurfaceId,
        body: &Body,
        world: &WorldView<'_>,
    ) -> Result<Cut, PhysicsError> {
        let lie = Lie::find(&self.lies, surface);
        let (pose, lead) = lie.map_or((Isometry3::identity(), None), |lie| (lie.pose, lie.lead));
        let free = lead.and_then(|lead| lead.free);
        let is_there = free.is_none_or(|free| self.is_where_it_was(&free, world));
        let goes_on = |cut: &Cut| is_there && (lead.is_some() || cut.moves || cut.frame == pose);
        self.end_cuts(tool, |cut| cut.surface == surface && !goes_on(cut));
        let moves = lead.is_some();
        if let Some(at) = tool.cuts.iter().position(|cut| cut.surface == surface) {
            let cut = tool.cuts.remove(at);
            return Ok(Cut { moves: cut.moves || moves, ..cut });
        }
        let met = &*self.surfaces[surface.0].surface;
        let encounter = Encounter::new(body, [met], self.settings.encounter())?;
        Ok(Cut { surface, encounter, frame: pose, moves, contact: None })
    }

    /// What is to become of a contact that the core has not carried.
    pub(crate) fn leave_cut(&mut self, tool: &mut Tool, surface: SurfaceId, left: Left) {
        let lead = Lie::find(&self.lies, surface).and_then(|lie| lie.lead);
        let free = lead.and_then(|lead| lead.free);
        let reason = match left.reason(self.settings.resolve) {
            Ok(reason) => reason,
            Err(error) => return self.fail(tool.handle, surface, error),
        };
        match (free, self.settings.resolve) {
            (Some(Free { body, .. }), Resolve::Auto) => {
                tool.left.push(surface);
                self.crowd(body, [surface], reason);
            }
            _ => self.refuse(tool.handle, surface, reason),
        }
    }

    /// Ends those contacts of a tool that `which` picks.
    pub(crate) fn end_cuts(&mut self, tool: &mut Tool, which: impl Fn(&Cut) -> bool) {
        for cut in tool.cuts.extract_if(.., |cut| which(cut)) {
            let Cut { surface, mut encounter, frame, mut contact, .. } = cut;
            let seat = micro::seat(surface, &self.lies, &frame);
            let mut placed = micro::place(&mut self.surfaces, surface, seat);
            encounter.end(&mut placed);
            let broken = self.surfaces[surface.0].settle_end();
            Contact::add_broken(&mut contact, &[(surface, broken)]);
            self.closed += *encounter.ledger();
            Contact::end(&mut contact, tool.handle, &mut self.events);
        }
    }

    /// Box around wherever the workpiece of a surface may get, if nothing but the tool in `state` could
    /// meet it.
    fn reach_of_alone(
        &self,
        tool: &Tool,
        surface: SurfaceId,
        (lead, free): &(Lead, Free),
        state: &State,
        world: &WorldView<'_>,
    ) -> Result<Extent, Refusal> {
        let handle = tool.handle;
        let tracked = Tracked::find(&self.bodies, handle);
        let radius = tracked.map_or(0.0, |tracked| tracked.radius);
        let (Some(rb), Some(own)) = (world.bodies.get(free.body), world.bodies.get(handle)) else {
            return Err(Refusal::SurfaceMoves);
        };
        if matches!(self.settings.resolve, Resolve::QuasiStatic | Resolve::Lockstep) {
            return Err(Refusal::Asked);
        }
        let course = Course::from_state(*state, Vector3::zeros(), radius);
        let size = derive::radius(rb, world.colliders);
        let reach = free::reach(lead, size, &course, self.current.dt);
        let on_it = |lie: &Lie| lie.lead.and_then(|l| l.free).is_some_and(|f| f.body == free.body);
        let meets = |lie: &Lie| match on_it(lie) {
            true => lie.id != surface && tool.near.contains(&lie.id),
            false => lie.extent.meets(&reach),
        };
        let bound = world.jointed(free.body)
            || !rb.locked_axes().is_empty()
            || self.candidates.contains(&free.body)
            || self.current.carried.iter().any(|(_, extent)| extent.meets(&reach))
            || self.lies.iter().any(meets);
        if bound {
            return Err(Refusal::SurfaceMoves);
        }
        let still = Track::still(reach);
        let beside = self.met_by(&[handle, free.body], rb.colliders(), &still, world);
        // Parts of the workpiece that do not wear.
        let way = Track::still(course.reach(&Isometry3::identity(), self.current.dt));
        let mut met = self.met_by(&[handle], own.colliders(), &way, world);
        let parent = |collider| world.colliders.get(collider).and_then(Collider::parent);
        met.retain(|collider| parent(*collider) == Some(free.body));
        match beside.first().or(met.first()) {
            Some(&collider) => Err(Refusal::Obstructed { collider }),
            None => Ok(reach),
        }
    }

    /// What colliders of `bodies` could run into on a track of the world.
    fn met_by(
        &self,
        bodies: &[RigidBodyHandle],
        own: &[ColliderHandle],
        track: &Track,
        world: &WorldView<'_>,
    ) -> Vec<ColliderHandle> {
        let (frame, colliders) = (&Isometry3::identity(), &*world.colliders);
        self.obstacles.all_in_way(&Search { bodies, own, track, frame, colliders })
    }

    /// True for a tool in `state` that stands beside a workpiece that sleeps.
    fn lets_sleep(
        &self,
        tool: RigidBodyHandle,
        free: &Free,
        state: &State,
        world: &WorldView<'_>,
    ) -> bool {
        let radius = Tracked::find(&self.bodies, tool).map_or(0.0, |tracked| tracked.radius);
        let speed = state.velocity.norm() + state.spin.norm() * radius;
        let place = state.position.coords.norm() + radius;
        let sleeps = world.bodies.get(free.body).is_some_and(RigidBody::is_sleeping);
        sleeps && !gate::moves(speed * self.current.dt, place)
    }

    /// True for a workpiece that nobody has moved since it was last carried.
    fn is_where_it_was(&self, free: &Free, world: &WorldView<'_>) -> bool {
        let shadow = Tracked::find(&self.bodies, free.body).and_then(|tracked| tracked.shadow);
        world.bodies.get(free.body).is_some_and(|rb| shadow.is_some_and(|s| s.holds(rb)))
    }
}

#[cfg(feature = "serde-serialize")]
impl Cut {
    /// True for a contact in a frame that Rapier's numbers can say.
    pub fn is_sound(&self) -> bool {
        crate::snapshot::is_frame(&self.frame)
    }

    /// The surfaces that it names.
    pub fn surfaces(&self) -> impl Iterator<Item = SurfaceId> {
        std::iter::once(self.surface).chain(self.contact.iter().flat_map(Contact::surfaces))
    }
}

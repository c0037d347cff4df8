//! What is known of one rigid body from step to step.

use abrade::{Body, Encounter, Inertia, Ledger, State};
use abrade_lockstep::Wearer;
use nalgebra::{Isometry3, Point3, Vector3};
use rapier::dynamics::{RigidBody, RigidBodyHandle};
use rapier::geometry::ColliderSet;
use rapier::math::Vector;

use crate::ahead::Ahead;
use crate::booking::{Booking, Contact};
use crate::derive;
use crate::event::{Refusal, WearEvent};
use crate::fingerprint::{self, Print};
use crate::gate::Lie;
use crate::micro::{self, Volumes};
use crate::quasi_static::Pressing;
use crate::resolver::Resolver;
use crate::shadow::{self, Shadow};
use crate::surface::{SurfaceId, WornCollider};
use crate::track::Track;
use crate::wall::Against;

/// Periods on its springs for which a contact may be a blow.
const BLOW: f64 = 20.0;

/// A rigid body and the core's view of it.
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Tracked {
    pub handle: RigidBodyHandle,
    /// Registered by the embedder: shape and inertia are the embedder's, whatever the colliders.
    pub registered: bool,
    pub known: Known,
    /// It was placed by the embedder and not resolved since: where it starts is no engine's doing.
    pub is_placed: bool,
    /// Radius that holds the body about its centre of mass [m].
    pub radius: f64,
    pub shadow: Option<Shadow>,
    pub live: Option<Live>,
    /// Its encounter with a wall, on which its own surface wears.
    pub against: Option<Against>,
    /// The contact that is open: totals since it began.
    pub contact: Option<Contact>,
    /// Springs kept by Lockstep, and the surfaces they are on.
    pub wearer: Option<(Vec<SurfaceId>, Wearer)>,
    /// What QuasiStatic presses it against.
    pub pressing: Vec<Pressing>,
    /// Loads that Rapier's contacts with surfaces bore in the last step [N].
    pub borne: Vec<(SurfaceId, f64)>,
    /// Friction of Rapier's contacts with surfaces, where it ploughs [-].
    pub friction: f64,
    /// How it was last resolved.
    resolver: Option<Resolver>,
    /// Surfaces that it comes near in the step under way.
    #[cfg_attr(feature = "serde-serialize", serde(skip))]
    pub near: Vec<SurfaceId>,
    /// Its course to the first of them, in the world.
    #[cfg_attr(feature = "serde-serialize", serde(skip))]
    pub course: Option<Box<Track>>,
    /// What it does in the step under way if it is alone.
    #[cfg_attr(feature = "serde-serialize", serde(skip))]
    pub ahead: Option<Box<Ahead>>,
    prints: Vec<Print>,
    com: Option<Vector>,
}

/// The core's body, as far as it was needed.
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum Known {
    /// Not asked for yet.
    Unseen,
    /// There is none.
    Refused(Refusal),
    /// Its state is set anew for every step.
    Ready(Box<Body>),
}

/// A running encounter.
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Live {
    pub encounter: Encounter,
    /// The surfaces it was made with, in order.
    pub surfaces: Vec<SurfaceId>,
    /// The surface of the body's own, and its frame in that of the body.
    pub skin: Option<(SurfaceId, Isometry3<f64>)>,
    /// The frame that it goes on in, once a surface of it has moved.
    pub frame: Option<Isometry3<f64>>,
}

impl Tracked {
    fn new(handle: RigidBodyHandle) -> Self {
        Self {
            handle,
            registered: false,
            is_placed: false,
            known: Known::Unseen,
            radius: 0.0,
            shadow: None,
            live: None,
            against: None,
            contact: None,
            wearer: None,
            pressing: Vec::new(),
            borne: Vec::new(),
            friction: 0.0,
            resolver: None,
            near: Vec::new(),
            course: None,
            ahead: None,
            prints: Vec::new(),
            com: None,
        }
    }

    /// The entry of `handle`; a body that reuses an index starts anew.
    pub fn slot(bodies: &mut Vec<Option<Self>>, handle: RigidBodyHandle) -> &mut Self {
        let index = handle.into_raw_parts().0 as usize;
        if bodies.len() <= index {
            bodies.resize_with(index + 1, || None);
        }
        let slot = &mut bodies[index];
        if slot.as_ref().is_some_and(|tracked| tracked.handle != handle) {
            *slot = None;
        }
        slot.get_or_insert_with(|| Self::new(handle))
    }

    /// Takes the embedder's shape, inertia and lock in place of the colliders'.
    pub fn register(&mut self, body: Body) {
        self.registered = true;
        self.is_placed = true;
        self.radius = body.shape.bounding_radius();
        self.known = Known::Ready(Box::new(body));
    }

    /// True when colliders or the centre of mass have changed since the body was derived.
    pub fn is_stale(&mut self, rb: &RigidBody, colliders: &ColliderSet) -> bool {
        if self.registered {
            return false;
        }
        let still = self.com == Some(rb.local_center_of_mass());
        !(still && fingerprint::hold(&mut self.prints, rb, colliders))
    }

    /// Forgets what was derived.
    pub fn refresh(&mut self, rb: &RigidBody, colliders: &ColliderSet) {
        self.com = Some(rb.local_center_of_mass());
        fingerprint::take(&mut self.prints, rb, colliders);
        self.radius = derive::radius(rb, colliders);
        self.known = Known::Unseen;
        self.shadow = None;
    }

    /// Its own surface was renewed, which has changed colliders and mass and moved its centre of
    /// mass by `shift` [m] in its frame. A registered body gets this inertia, and the shape that its
    /// colliders have now, if they have one.
    pub fn renew(
        &mut self,
        rb: &RigidBody,
        colliders: &ColliderSet,
        inertia: Inertia,
        shift: &Vector3<f64>,
    ) {
        match &mut self.known {
            Known::Ready(body) if self.registered => {
                let derived = derive::shape(rb, colliders);
                body.shape = derived.unwrap_or_else(|_| body.shape.moved(&-shift));
                body.inertia = inertia;
                self.radius = body.shape.bounding_radius();
            }
            _ => self.refresh(rb, colliders),
        }
    }

    /// Surfaces with which a contact of it is open.
    pub fn touched(&self) -> impl Iterator<Item = SurfaceId> + '_ {
        let live = self.live.iter().filter(|live| live.encounter.is_open());
        let wall = self.against.iter().filter(|against| against.encounter.is_open());
        let live = live.flat_map(Live::all);
        let sprung = self.wearer.iter().flat_map(|(ids, _)| ids.iter().copied());
        let pressed = self.pressing.iter().map(|pressing| pressing.surface);
        live.chain(wall.map(|against| against.surface)).chain(sprung).chain(pressed)
    }

    /// Drops a shadow that no longer holds. True when the body is not where it was left: an
    /// encounter has then lost the place of its springs.
    pub fn drop_lost_shadow(&mut self, rb: &RigidBody) -> bool {
        self.shadow = self.shadow.filter(|shadow| shadow.holds(rb));
        self.shadow.is_none()
    }

    /// Derives the core's body unless that was done.
    pub fn derive(&mut self, rb: &RigidBody, colliders: &ColliderSet) -> Result<(), Refusal> {
        if matches!(self.known, Known::Unseen) {
            let inertia = derive::inertia(rb);
            self.known = match derive::shape(rb, colliders).and_then(|s| Ok((s, inertia?))) {
                Ok((shape, inertia)) => {
                    let state = State::at(Point3::origin());
                    let body = Body { shape, inertia, state, rotation_locked: false };
                    Known::Ready(Box::new(body))
                }
                Err(refusal) => Known::Refused(refusal),
            };
        }
        match &mut self.known {
            Known::Ready(body) if !self.registered => {
                body.inertia = derive::inertia(rb)?;
                body.rotation_locked = rb.is_rotation_locked() == [true; 3];
                Ok(())
            }
            Known::Ready(_) | Known::Unseen => Ok(()),
            Known::Refused(refusal) => Err(*refusal),
        }
    }

    /// True when the running encounter, if there is one, was made with all the surfaces near,
    /// and all of its own still lie somewhere.
    pub fn knows_surfaces(&self, lies: &[Lie]) -> bool {
        self.live.as_ref().is_some_and(|live| {
            self.near.iter().all(|id| live.surfaces.contains(id))
                && live.surfaces.iter().all(|id| lies.iter().any(|lie| lie.id == *id))
        })
    }

    /// Ends the running encounter, and the contact that is open with it.
    pub fn end(
        &mut self,
        surfaces: &mut [WornCollider],
        closed: &mut Ledger,
        events: &mut Vec<WearEvent>,
    ) {
        let Some(live) = self.live.take() else { return };
        self.close(live.end(surfaces), closed);
        self.end_contact(events);
    }

    /// Ends the encounter with a wall, and the contact that is open with it.
    pub fn end_against(
        &mut self,
        surfaces: &mut [WornCollider],
        closed: &mut Ledger,
        events: &mut Vec<WearEvent>,
    ) {
        let Some(against) = self.against.take() else { return };
        self.close(against.end(surfaces), closed);
        self.end_contact(events);
    }

    /// Ends what QuasiStatic has pressed it against.
    pub fn end_pressing(
        &mut self,
        pressing: Pressing,
        surfaces: &mut [WornCollider],
        closed: &mut Ledger,
    ) {
        self.close(pressing.end(surfaces), closed);
    }

    /// Lets go of the springs that Lockstep kept.
    pub fn end_wearer(&mut self, surfaces: &mut [WornCollider], closed: &mut Ledger) {
        let Some((ids, wearer)) = self.wearer.take() else { return };
        let mut change = Ledger::default();
        let broken = micro::end(surfaces, &ids, None, |placed| change = wearer.end(placed));
        self.close((change, broken), closed);
    }

    /// Adds the energies of what has ended, and what broke off to the contact that is open.
    fn close(&mut self, (ledger, broken): (Ledger, Volumes), closed: &mut Ledger) {
        *closed += ledger;
        Contact::add_broken(&mut self.contact, &broken);
    }

    /// True in the middle of a blow on springs, which may pass the turning point, where it is slow.
    pub fn is_in_blow(&self) -> bool {
        let Some(live) = self.live.as_ref().filter(|live| live.encounter.in_contact()) else {
            return false;
        };
        let time = self.contact.as_ref().map_or(0.0, |contact| contact.time);
        time < BLOW * live.encounter.period()
    }

    /// True while springs that Lockstep left loaded have not come to rest.
    pub fn is_in_lockstep_blow(&self) -> bool {
        let wearer = self.wearer.as_ref().map(|(_, wearer)| wearer);
        wearer.is_some_and(|wearer| wearer.contact().in_contact() && !wearer.is_slow())
    }

    /// Micro has carried it: what the others kept is let go.
    pub fn taken_by_micro(
        &mut self,
        surfaces: &mut [WornCollider],
        closed: &mut Ledger,
        events: &mut Vec<WearEvent>,
    ) {
        self.let_go(surfaces, closed);
        self.hand_to(Resolver::Micro, None, events);
    }

    /// Rapier keeps its motion among others: what the other resolvers kept is let go.
    pub fn taken_by_collision(
        &mut self,
        reason: Refusal,
        surfaces: &mut [WornCollider],
        closed: &mut Ledger,
        events: &mut Vec<WearEvent>,
    ) {
        self.let_go(surfaces, closed);
        self.hand_to(Resolver::Collision, Some(reason), events);
    }

    /// Ends what QuasiStatic presses it against, but for `kept`.
    pub fn let_go_but(
        &mut self,
        kept: &[SurfaceId],
        surfaces: &mut [WornCollider],
        closed: &mut Ledger,
    ) {
        while let Some(at) = self.pressing.iter().position(|p| !kept.contains(&p.surface)) {
            let pressing = self.pressing.remove(at);
            self.end_pressing(pressing, surfaces, closed);
        }
    }

    /// It is away from every surface, or another body than it was: whatever is open ends.
    pub fn leave(
        &mut self,
        surfaces: &mut [WornCollider],
        closed: &mut Ledger,
        events: &mut Vec<WearEvent>,
    ) {
        self.end(surfaces, closed, events);
        self.let_go(surfaces, closed);
        if self.against.is_none() {
            Contact::end(&mut self.contact, self.handle, events);
        }
    }

    /// True while something is kept of a contact.
    pub fn is_open(&self) -> bool {
        let Self { live, against, pressing, wearer, contact, .. } = self;
        let runs = live.is_some() || against.is_some() || wearer.is_some();
        runs || !pressing.is_empty() || contact.is_some()
    }

    /// Lets go of what the resolvers other than Micro kept.
    fn let_go(&mut self, surfaces: &mut [WornCollider], closed: &mut Ledger) {
        self.let_go_but(&[], surfaces, closed);
        self.end_wearer(surfaces, closed);
        self.friction = 0.0;
        self.borne.clear();
    }

    /// Ends the contact that is open.
    pub fn end_contact(&mut self, events: &mut Vec<WearEvent>) {
        Contact::end(&mut self.contact, self.handle, events);
    }

    /// Books a step of its contact.
    pub fn book(
        &mut self,
        booking: &Booking,
        worn: &[(SurfaceId, f64)],
        events: &mut Vec<WearEvent>,
    ) {
        Contact::book(&mut self.contact, self.handle, booking, worn, events);
    }

    /// Books a step of its contact that has failed on its way.
    pub fn book_failed(&mut self, worn: &[(SurfaceId, f64)], events: &mut Vec<WearEvent>) {
        Contact::book_failed(&mut self.contact, self.handle, worn, events);
    }

    /// Notes who resolves it now; a change raises an event.
    pub fn hand_to(&mut self, to: Resolver, reason: Option<Refusal>, events: &mut Vec<WearEvent>) {
        // That Micro begins is what an embedder expects.
        let before = self.resolver.replace(to).unwrap_or(Resolver::Micro);
        if before != to {
            events.push(WearEvent::Resolved { body: self.handle, by: to, reason });
        }
    }

    /// The core's body, once derived.
    pub fn body(&self) -> Option<&Body> {
        match &self.known {
            Known::Ready(body) => Some(body),
            Known::Unseen | Known::Refused(_) => None,
        }
    }

    /// The body that the embedder has registered.
    pub fn registered(&self) -> Option<&Body> {
        self.body().filter(|_| self.registered)
    }

    /// The entry of `handle` among all.
    pub fn find(bodies: &[Option<Self>], handle: RigidBodyHandle) -> Option<&Self> {
        let slot = bodies.get(handle.into_raw_parts().0 as usize)?.as_ref();
        slot.filter(|tracked| tracked.handle == handle)
    }

    /// State in the world, exact where known.
    pub fn state(&self, rb: &RigidBody) -> State {
        shadow::read(rb, self.shadow.as_ref(), &Isometry3::identity())
    }
}

//! A body of the island that wears surfaces.

use abrade::{
    Body, Carried, EncounterSettings, Grip, Ledger, Loads, Met, PhysicsError, Placed, State, Worn,
};
use nalgebra::{Translation3, Vector3};
use rapier::dynamics::RigidBodyHandle;

use crate::calm::{Calm, normal_speed};

/// Share of the yield overlap by which a body that rested may have moved and still be held by the
/// springs that it had before.
const IN_PLACE: f64 = 1e-2;

/// A body that wears the island's surfaces.
#[derive(Clone)]
pub struct Wearer {
    /// The body in the island's world.
    pub handle: RigidBodyHandle,
    /// Geometry, inertia and present state, in the world.
    pub body: Body,
    /// What acts on it beside contacts and joints.
    pub loads: Loads,
    /// Load that it bears while it rests, in the mean over a coarse step [N].
    pub bears: f64,
    pub(crate) contact: Carried,
    pub(crate) calm: Calm,
    /// Present answer of the surfaces.
    pub(crate) grip: Grip,
    pub(crate) impulse: Vector3<f64>,
    pub(crate) contact_time: f64,
    /// The surfaces of the island that it wears, by their places in it.
    pub(crate) uses: Vec<usize>,
    /// By how much each of them is lowered for this body, which an engine left inside it [m].
    pub(crate) lifts: Vec<f64>,
    /// Where its springs have last followed it to.
    left: State,
    worn: Vec<f64>,
    /// Volumes displaced before a step [m3].
    mark: Vec<Worn>,
    /// A node has flowed in the last step.
    pub(crate) wears: bool,
    /// Why its surfaces can follow it no further.
    beyond: Option<PhysicsError>,
    booked: Ledger,
    seen: u64,
}

impl Wearer {
    /// A body that wears those of the island's `surfaces` that `uses` names by their places.
    ///
    /// # Errors
    /// A law that does not go with the body's shape, or an inertia out of range.
    pub fn new(
        handle: RigidBodyHandle,
        body: Body,
        loads: Loads,
        surfaces: &mut [Placed<'_>],
        uses: Vec<usize>,
        settings: EncounterSettings,
    ) -> Result<Self, PhysicsError> {
        let own = own(surfaces, &uses, &[]);
        let mut contact = Carried::new(&body, own.iter().map(|p| &*p.surface), settings)?;
        let lifts = contact.overlaps(&body, &own);
        Ok(Self { uses, ..Self::of(handle, body, loads, contact, lifts) })
    }

    /// A body that joins an island with the `contact` it has.
    pub(crate) fn of(
        handle: RigidBodyHandle,
        body: Body,
        loads: Loads,
        contact: Carried,
        lifts: Vec<f64>,
    ) -> Self {
        Self {
            handle,
            left: body.state,
            body,
            loads,
            bears: 0.0,
            calm: Calm::default(),
            grip: Grip::default(),
            impulse: Vector3::zeros(),
            contact_time: 0.0,
            worn: vec![0.0; lifts.len()],
            mark: vec![Worn::default(); lifts.len()],
            wears: false,
            beyond: None,
            uses: Vec::new(),
            lifts,
            booked: *contact.ledger(),
            seen: contact.node_evaluations(),
            contact,
        }
    }

    /// The same body in another island, from where it is, with the same surfaces.
    pub fn resumed(self, handle: RigidBodyHandle, loads: Loads, uses: Vec<usize>) -> Self {
        let worn = vec![0.0; self.worn.len()];
        let (impulse, contact_time) = (Vector3::zeros(), 0.0);
        let booked = *self.contact.ledger();
        let seen = self.contact.node_evaluations();
        let beyond = None;
        Self { handle, loads, impulse, contact_time, worn, beyond, booked, seen, uses, ..self }
    }

    /// Lets go of its `own` surfaces, in the order in which it named them, wherever it is: what its
    /// springs hold is lost, and overhangs break off. Returns what that changed of its energies.
    pub fn end(mut self, own: &mut [Placed<'_>]) -> Ledger {
        let before = *self.contact.ledger();
        self.contact.let_go(own);
        let mut change = *self.contact.ledger();
        change -= before;
        change
    }

    /// True when it rests on a contact of Rapier's.
    pub fn rests(&self) -> bool {
        self.calm.rests
    }

    /// True when it only rings on its springs, though it may wear as it slides along.
    pub fn is_slow(&self) -> bool {
        self.calm.is_slow
    }

    /// Why its surfaces could follow it no further, if they could not: the crater was deeper than
    /// the body. There it was stopped, and nothing wakes it.
    pub fn beyond(&self) -> Option<&PhysicsError> {
        self.beyond.as_ref()
    }

    /// Volume displaced on each of its surfaces since it joined the island [m3].
    pub fn worn(&self) -> &[f64] {
        &self.worn
    }

    /// Change of its energies since it joined the island; zeros unless asked for.
    pub fn ledger_gained(&self) -> Ledger {
        let mut gained = *self.contact.ledger();
        gained -= self.booked;
        gained
    }

    /// Nodes taken through the law since it joined the island.
    pub fn node_evaluations(&self) -> u64 {
        self.contact.node_evaluations() - self.seen
    }

    /// Its wear contact.
    pub fn contact(&self) -> &Carried {
        &self.contact
    }

    /// Impulse of the surfaces on it so far [N s].
    pub fn impulse(&self) -> Vector3<f64> {
        self.impulse
    }

    /// Time in contact so far [s].
    pub fn contact_time(&self) -> f64 {
        self.contact_time
    }

    /// Back to springs from a rest on contacts of Rapier's, which its springs did not follow. Where
    /// the body has moved they would push it back with energy that nobody gave: it begins anew,
    /// outside of surfaces that are lowered for it to where it is.
    pub(crate) fn wake(&mut self, surfaces: &mut [Placed<'_>]) {
        if self.beyond.is_some() {
            return;
        }
        if self.calm.rests && !self.is_in_place() {
            self.wear(surfaces, |contact, _, surfaces| contact.let_go(surfaces));
            self.lifts.fill(0.0);
            self.lifts =
                self.lowered(surfaces, |contact, body, surfaces| contact.overlaps(body, surfaces));
            self.left = self.body.state;
        }
        self.calm.wake();
    }

    /// Takes it off its springs where its surfaces can follow it no further; true if they cannot.
    pub(crate) fn give_up(&mut self, surfaces: &mut [Placed<'_>]) -> bool {
        let gives_up = self.beyond.is_some() && !self.calm.rests;
        if gives_up {
            self.wear(surfaces, |contact, _, surfaces| contact.let_go(surfaces));
            self.calm.rests = true;
        }
        gives_up
    }

    /// True while the body is where its springs left it.
    fn is_in_place(&self) -> bool {
        let (left, here) = (&self.left, &self.body.state);
        let turn = left.rotation.angle_to(&here.rotation) * self.body.shape.bounding_radius();
        (here.position - left.position).norm() + turn <= IN_PLACE * self.contact.yield_overlap()
    }

    /// Runs `act` with its surfaces where they lie for it.
    fn lowered<R>(
        &mut self,
        surfaces: &mut [Placed<'_>],
        act: impl FnOnce(&mut Carried, &mut Body, &mut [Placed<'_>]) -> R,
    ) -> R {
        let mut own = own(surfaces, &self.uses, &self.lifts);
        act(&mut self.contact, &mut self.body, &mut own)
    }

    /// As [`Wearer::lowered`], counting what is displaced.
    fn wear<R>(
        &mut self,
        surfaces: &mut [Placed<'_>],
        act: impl FnOnce(&mut Carried, &mut Body, &mut [Placed<'_>]) -> R,
    ) -> R {
        for (mark, &at) in self.mark.iter_mut().zip(&self.uses) {
            *mark = surfaces[at].surface.worn();
        }
        let done = self.lowered(surfaces, act);
        self.wears = false;
        for ((worn, mark), &at) in self.worn.iter_mut().zip(&self.mark).zip(&self.uses) {
            let now = surfaces[at].surface.worn();
            *worn += now.displaced() - mark.displaced();
            // What slip rubs off does not keep a body that rests awake.
            let flowed = |w: &Worn| w.normal + w.lateral + w.chip;
            self.wears |= flowed(&now) > flowed(mark);
        }
        done
    }

    /// Bound of the speed at which its points move along the normals of its surfaces [m/s].
    pub(crate) fn normal_speed(&self, surfaces: &[Placed<'_>]) -> f64 {
        let speeds = self.uses.iter().map(|&at| normal_speed(&self.body, &surfaces[at]));
        speeds.fold(0.0, f64::max)
    }

    /// Bound of the speed of its points [m/s].
    pub(crate) fn speed(&self) -> f64 {
        let state = &self.body.state;
        state.velocity.norm() + state.spin.norm() * self.body.shape.bounding_radius()
    }

    /// Longest step that its contact allows [s].
    pub(crate) fn step(&mut self, surfaces: &mut [Placed<'_>]) -> f64 {
        let loads = self.loads;
        self.lowered(surfaces, |contact, body, surfaces| contact.step(body, surfaces, &loads))
    }

    /// Asks the surfaces about a step of `dt` [s].
    pub(crate) fn grasp(&mut self, surfaces: &mut [Placed<'_>], dt: f64) {
        self.grip =
            self.lowered(surfaces, |contact, body, surfaces| contact.grip(body, surfaces, dt));
    }

    /// Asks the surfaces whether they can follow it to `end`.
    pub(crate) fn meet(
        &mut self,
        surfaces: &mut [Placed<'_>],
        end: &State,
        dt: f64,
    ) -> Result<Met, PhysicsError> {
        self.lowered(surfaces, |contact, body, surfaces| contact.meet(body, surfaces, end, dt))
    }

    /// Lets the surfaces follow a step of `dt` [s] that they can, for as long as the body's middle
    /// is above them.
    pub(crate) fn follow(
        &mut self,
        surfaces: &mut [Placed<'_>],
        dt: f64,
    ) -> Result<(), PhysicsError> {
        match self.wear(surfaces, |contact, body, surfaces| contact.follow(body, surfaces)) {
            Err(error @ PhysicsError::Engulfed { .. }) => self.beyond = Some(error),
            followed => followed?,
        }
        self.left = self.body.state;
        self.impulse += self.grip.force * dt;
        if self.contact.in_contact() {
            self.contact_time += dt;
        }
        Ok(())
    }
}

/// The surfaces that `uses` names, in its order, lowered by `lifts` [m].
fn own<'a>(surfaces: &'a mut [Placed<'_>], uses: &[usize], lifts: &[f64]) -> Vec<Placed<'a>> {
    let mut own = Vec::with_capacity(uses.len());
    for (at, placed) in surfaces.iter_mut().enumerate() {
        let Some(order) = uses.iter().position(|used| *used == at) else { continue };
        let lift = lifts.get(order).copied().unwrap_or(0.0);
        let pose = placed.pose * Translation3::new(0.0, 0.0, -lift);
        own.push((order, Placed::at_rest(&mut *placed.surface, pose)));
    }
    own.sort_unstable_by_key(|(order, _)| *order);
    own.into_iter().map(|(_, placed)| placed).collect()
}

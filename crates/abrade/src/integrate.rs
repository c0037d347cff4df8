//! Time integration of a contact: velocity Verlet for the body, trial and reject.
//!
//! dt = eta / omega with omega^2 = (sum of the elastic stiffnesses of the trial contacts) / m. A
//! trial whose omega dt exceeds 1.5 eta is rejected: without that a slow impact, whose first step
//! knows nothing of the stiffness to come, gains energy without bound.

use nalgebra::Vector3;

use crate::adhesion::{Attraction, Glue};
use crate::balance::Balance;
use crate::body::Body;
use crate::carrier::flight_limit;
use crate::contact::Contact;
use crate::damping::{Damping, Dashpots};
use crate::encounter::{Advance, EncounterSettings, Instant, Loads, Observer, Placed, Skin, Until};
use crate::error::PhysicsError;
use crate::flight::{acceleration, free_time, time_to_close, top_speed};
use crate::ledger::Ledger;
use crate::reject::{OVERLAP_STEP, rejected};
use crate::ride::{Answer, Hand, Ride};
use crate::rotation::Dynamics;
use crate::settle::Pull;
#[cfg(feature = "state")]
use crate::state::{Fault, finite, not_negative, positive, require};
use crate::surface::Surface;

/// eta at an accuracy of 3e-3; the error goes as eta^2.
pub(crate) const ETA: f64 = 0.1;
const ETA_ACCURACY: f64 = 3e-3;
/// Hard cap of eta; the linear stability limit is 1.18.
const ETA_LIMIT: f64 = 0.7;
/// Growth of the step from one to the next.
const GROWTH: f64 = 2.0;
/// Longest step that is asked for [s], where no spring bounds it.
const LONGEST: f64 = 1e9;
/// First step into contact, in yield overlaps travelled.
const FLOOR: f64 = 0.1;
/// Share of a step below which the turning point is not worth a step of its own.
const TURN: f64 = 0.05;

/// State of a contact between calls.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "state", serde(remote = "Self"))]
pub(crate) struct Integrator {
    pub(crate) settings: EncounterSettings,
    pub(crate) dynamics: Dynamics,
    pub(crate) eta: f64,
    pub(crate) contacts: Vec<Contact>,
    /// Adhesion of every contact; empty when no surface has any.
    pub(crate) glue: Vec<Option<Glue>>,
    /// What adhesion did in the last trial.
    #[cfg_attr(feature = "state", serde(skip))]
    pub(crate) attraction: Attraction,
    /// Numbers of nodes of the surfaces that it was made with, and how often each had been renewed
    /// when it was last looked at.
    node_counts: Vec<usize>,
    renewals: Vec<u32>,
    /// Step that the last contact asked for [s]; zero when there is none.
    pub(crate) next_dt: f64,
    /// Inverse of the angular frequency on the springs that were touched last [s]; zero for none.
    pub(crate) tau: f64,
    /// What the contacts do to the body at the present instant.
    pub(crate) pull: Pull,
    pub(crate) touching: bool,
    pub(crate) touched: bool,
    pub(crate) energy_before: f64,
    /// What every contact does, for surfaces that move.
    pub(crate) hands: Vec<Hand>,
    /// The carriers prepared for stepping, one per surface, and in the last trial; none when every
    /// surface is at rest.
    #[cfg_attr(feature = "state", serde(skip))]
    pub(crate) mounts: Vec<Option<Dynamics>>,
    #[cfg_attr(feature = "state", serde(skip))]
    pub(crate) rides: Vec<Option<Ride>>,
    /// What every contact did to the body in the last trial, where its surface moves.
    #[cfg_attr(feature = "state", serde(skip))]
    pub(crate) answers: Vec<Answer>,
    /// Angular momentum that placing the end of the last trial ahead of the balance made [N m s].
    #[cfg_attr(feature = "state", serde(skip))]
    pub(crate) ahead: Vector3<f64>,
    /// What columns and dashpots were foreseen to change the velocity [m/s] and spin [rad/s] by over the
    /// first half of the last trial.
    #[cfg_attr(feature = "state", serde(skip))]
    pub(crate) foreseen: [Vector3<f64>; 2],
    /// True when a surface damps the body; what its dashpots do over the last trial, and the
    /// springs that they stand beside.
    pub(crate) is_damped: bool,
    #[cfg_attr(feature = "state", serde(skip))]
    pub(crate) damping: Damping,
    #[cfg_attr(feature = "state", serde(skip))]
    pub(crate) dashpots: Dashpots,
    /// Where the last search for a load ended, of a pressed body.
    pub(crate) balance: Option<Balance>,
    /// Energy that projections with springs were short of [J], or adhesion gave while none was
    /// touched.
    pub(crate) short: f64,
    /// Work of loads since the first touch, whatever its sign [J].
    pub(crate) supplied: f64,
    pub(crate) ledger: Ledger,
    /// Energies, if they are kept: what springs booked in the last trial, and once it is settled what
    /// the step has cost.
    #[cfg_attr(feature = "state", serde(skip))]
    pub(crate) booked: Ledger,
}

impl Integrator {
    pub(crate) fn new<'a>(
        body: &Body,
        surfaces: impl IntoIterator<Item = &'a Surface>,
        settings: EncounterSettings,
    ) -> Result<Self, PhysicsError> {
        let mut contacts = Vec::new();
        for surface in surfaces {
            let contact = Contact::new(&body.shape, surface, settings.ledger)?;
            contacts.push((contact, surface));
        }
        Self::with_contacts(body, contacts, settings)
    }

    /// Of a body with a worn surface of its own.
    pub(crate) fn of_two(
        body: &Body,
        skin: &Skin<'_>,
        surface: &Surface,
        settings: EncounterSettings,
    ) -> Result<Self, PhysicsError> {
        if [surface, &*skin.surface].iter().any(|surface| surface.laws.adhesion.is_some()) {
            let what = "two surfaces that wear do not adhere: leave the adhesion of both out";
            return Err(PhysicsError::Unsupported { what });
        }
        let contact = Contact::mutual(&body.shape, skin, surface, settings.ledger)?;
        Self::with_contacts(body, vec![(contact, surface)], settings)
    }

    fn with_contacts(
        body: &Body,
        pairs: Vec<(Contact, &Surface)>,
        settings: EncounterSettings,
    ) -> Result<Self, PhysicsError> {
        let dynamics = Dynamics::new(&body.inertia, body.rotation_locked).ok_or(
            PhysicsError::Unsupported { what: "the body's mass or inertia is not positive" },
        )?;
        if !(settings.accuracy > 0.0 && settings.accuracy.is_finite()) {
            let what = "the accuracy of a contact must be above zero and finite";
            return Err(PhysicsError::Unsupported { what });
        }
        let node_counts = pairs.iter().map(|(_, surface)| surface.nodes().len()).collect();
        let renewals = pairs.iter().map(|(_, surface)| surface.renewals()).collect();
        let glues = pairs.iter().any(|(_, surface)| surface.laws.adhesion.is_some());
        let glue = pairs.iter().filter(|_| glues).map(|(c, s)| Glue::new(c, s)).collect();
        let contacts: Vec<_> = pairs.into_iter().map(|(contact, _)| contact).collect();
        Ok(Self {
            settings,
            dynamics,
            eta: (ETA * (settings.accuracy / ETA_ACCURACY).sqrt()).min(ETA_LIMIT),
            is_damped: contacts.iter().any(|contact| contact.damping_ratio() > 0.0),
            damping: Damping::default(),
            dashpots: Dashpots::default(),
            contacts,
            glue,
            attraction: Attraction::default(),
            node_counts,
            renewals,
            next_dt: 0.0,
            tau: 0.0,
            pull: Pull::default(),
            touching: false,
            touched: false,
            energy_before: body.inertia.kinetic_energy(&body.state),
            hands: Vec::new(),
            mounts: Vec::new(),
            rides: Vec::new(),
            answers: Vec::new(),
            ahead: Vector3::zeros(),
            foreseen: [Vector3::zeros(); 2],
            balance: None,
            short: 0.0,
            supplied: 0.0,
            ledger: Ledger::default(),
            booked: Ledger::default(),
        })
    }

    pub(crate) fn in_contact(&self) -> bool {
        self.touching
    }

    pub(crate) fn step_limit(&self) -> u64 {
        self.settings.step_limit
    }

    /// An error unless these are surfaces of the sizes that it was made with. Lets go of those that
    /// were renewed, which is an error in the middle of a contact.
    pub(crate) fn fits(&mut self, surfaces: &[Placed<'_>]) -> Result<(), PhysicsError> {
        let counts = surfaces.iter().map(|placed| placed.surface.nodes().len());
        if !counts.eq(self.node_counts.iter().copied()) {
            return Err(PhysicsError::Unsupported {
                what: "the surfaces are not those that the encounter was made with",
            });
        }
        let contacts = self.contacts.iter_mut().zip(&mut self.renewals).zip(surfaces);
        for (i, ((contact, renewals), placed)) in contacts.enumerate() {
            if !contact.fits(placed.skin.as_ref(), self.touched) {
                return Err(PhysicsError::Unsupported {
                    what: "the body's own surface is not the one that the encounter was made with",
                });
            }
            if *renewals == placed.surface.renewals() {
                continue;
            }
            if self.touched {
                return Err(PhysicsError::Unsupported {
                    what: "a surface was renewed in the middle of a contact",
                });
            }
            contact.forget();
            self.glue.get_mut(i).and_then(Option::as_mut).map(Glue::let_go);
            *renewals = placed.surface.renewals();
        }
        Ok(())
    }

    pub(crate) fn advance(
        &mut self,
        body: &mut Body,
        surfaces: &mut [Placed<'_>],
        loads: &Loads,
        duration: f64,
        until: Until,
        observer: &mut dyn Observer,
    ) -> Result<Advance, PhysicsError> {
        self.fits(surfaces)?;
        self.mount(surfaces)?;
        // Nothing acts on a body that is led, or else it would not keep its motion.
        let loads = if self.dynamics.is_immovable() { &Loads::default() } else { loads };
        let mut done = Advance::default();
        while done.time < duration {
            let remaining = duration - done.time;
            let (step, flight) = self.next_step(body, surfaces, loads);
            let mut dt =
                self.step(body, surfaces, loads, step.min(remaining), flight, &mut done)?;
            if dt < remaining && self.is_held(body, surfaces, loads) {
                done.contact_time += remaining - dt;
                dt = remaining;
            }
            // The last step ends on the duration to the bit.
            done.time = if dt == remaining { duration } else { done.time + dt };
            observer.observe(&Instant {
                time: done.time,
                state: &body.state,
                force: self.pull.force,
                surfaces,
                ledger: self.kept_ledger(),
            });
            if self.touched && self.contact_is_over(body, surfaces) {
                self.end_contact(surfaces);
                done.exited = until == Until::FirstExit;
            }
            if done.exited || (until == Until::FirstExit && self.has_stopped(body, surfaces)) {
                self.end_contact(surfaces);
                done.exited = true;
                break;
            }
            if done.steps > self.settings.step_limit {
                return Err(PhysicsError::TooManySteps { steps: done.steps });
            }
        }
        Ok(done)
    }

    /// Step of a body in contact. It ends where the body turns, because there the flow ends: a
    /// sampled peak would miss wear in proportion to dt^2.
    fn contact_step(&self, body: &Body, surfaces: &[Placed<'_>], loads: &Loads) -> f64 {
        let push = self.pull.push;
        let direction = push / push.norm().max(f64::MIN_POSITIVE);
        let net = self.pull.force + loads.pull(&body.inertia);
        let mut approach = -body.state.velocity.dot(&direction);
        let mut slowing = net.dot(&direction) * self.dynamics.inverse_mass;
        if !self.surfaces_rest() {
            let [velocity, acceleration] = self.motion_below(body, surfaces);
            approach += velocity.dot(&direction);
            slowing -= acceleration.dot(&direction);
        }
        let turn = approach / slowing;
        if turn > TURN * self.next_dt && turn < self.next_dt { turn } else { self.next_dt }
    }

    /// Length of the next step, and whether it is flight, in which no node can be touched.
    pub(crate) fn next_step(
        &mut self,
        body: &Body,
        surfaces: &[Placed<'_>],
        loads: &Loads,
    ) -> (f64, bool) {
        let mut limit = self.sweep_limit(body, surfaces, loads);
        if self.adheres() {
            limit = limit.min(self.adhesion_limit(body, surfaces, loads, &self.pull.drawn.force));
        }
        if self.touching {
            return (self.contact_step(body, surfaces, loads).min(limit), false);
        }
        let scale = FLOOR * self.yield_overlap();
        let time = |placed: &Placed<'_>| {
            time_to_close(scale, top_speed(placed, body), acceleration(placed, body, loads))
        };
        let floor = surfaces.iter().map(time).fold(limit, f64::min);
        let mut free = f64::INFINITY;
        for (i, (contact, placed)) in self.contacts.iter_mut().zip(surfaces).enumerate() {
            let local = placed.sees(&body.state);
            let acceleration = acceleration(placed, body, loads);
            let glue = self.glue.get_mut(i).and_then(Option::as_mut);
            free = free.min(free_time(contact, glue, placed, body, &local, acceleration, floor));
        }
        if free > floor || free == f64::INFINITY {
            let free = free.min(self.rise_time(body, surfaces));
            (free.min(flight_limit(surfaces).max(floor)), true)
        } else {
            (floor, false)
        }
    }

    /// The least yield overlap of its contacts [m]; infinite without springs.
    pub(crate) fn yield_overlap(&self) -> f64 {
        self.contacts.iter().map(Contact::yield_overlap).fold(f64::INFINITY, f64::min)
    }

    /// Longest step of the swept rule: |v| dt <= 0.1 pitch, and 0.4 yield overlaps with springs; and
    /// of a led body.
    fn sweep_limit(&self, body: &Body, surfaces: &[Placed<'_>], loads: &Loads) -> f64 {
        let limit = |(contact, placed): (&Contact, &Placed<'_>)| {
            let reach = contact.sweep_reach(placed.surface)?;
            let speed = top_speed(placed, body);
            Some(time_to_close(reach, speed, acceleration(placed, body, loads)))
        };
        let limits = self.contacts.iter().zip(surfaces).filter_map(limit);
        limits.fold(self.led_limit(body, surfaces), f64::min)
    }

    /// Takes one step of at most `dt`; returns its length.
    fn step(
        &mut self,
        body: &mut Body,
        surfaces: &mut [Placed<'_>],
        loads: &Loads,
        dt: f64,
        flight: bool,
        done: &mut Advance,
    ) -> Result<f64, PhysicsError> {
        let mut dt = dt;
        loop {
            if !flight && !self.touched {
                self.start_clear(body, surfaces)?;
            }
            let trial = self.trial(body, surfaces, loads, dt, flight);
            done.node_evaluations += trial.evaluations;
            if !self.is_finite(&trial) {
                return Err(PhysicsError::NotFinite { time: done.contact_time });
            }
            let omega = self.omega(&trial).max(self.damping.rate);
            let mut allowed = (self.eta / omega).min(self.led_limit(body, surfaces));
            if self.adheres() {
                let drawn = &self.attraction.grip.force;
                allowed = allowed.min(self.adhesion_limit(body, surfaces, loads, drawn));
            }
            if let Some(smaller) = rejected(&trial, dt, allowed) {
                if dt < f64::MIN_POSITIVE / f64::EPSILON {
                    return Err(PhysicsError::StepVanished { step: dt });
                }
                dt = smaller;
                continue;
            }
            let touches = !self.touched && trial.touching > 0;
            if touches {
                self.supplied = 0.0;
                self.energy_before = self.relative_energy(body, surfaces);
            }
            if dt > OVERLAP_STEP * allowed && self.grows_short(body, surfaces, loads, &trial) {
                dt *= 0.5;
                continue;
            }
            self.touched |= touches;
            let next_dt = self.step_after(dt, allowed);
            self.keep_step(next_dt, omega);
            self.accept(body, surfaces, loads, dt, trial, done);
            self.check_depth(body, surfaces)?;
            self.check_balance(body, surfaces)?;
            return Ok(dt);
        }
    }

    /// Length of the step after one of `dt`, where springs allow `allowed` [s].
    pub(crate) fn step_after(&self, dt: f64, allowed: f64) -> f64 {
        // A step cut short at a turning point says nothing of the next one.
        allowed.min(GROWTH * dt.max(self.next_dt.min(allowed)))
    }

    /// Keeps the length of the next step [s], and the angular frequency [1/s] on springs, if any is touched.
    pub(crate) fn keep_step(&mut self, dt: f64, omega: f64) {
        self.next_dt = dt.min(LONGEST);
        if omega > 0.0 {
            self.tau = 1.0 / omega;
        }
    }

    /// Period on the springs that were touched last [s]; zero for none.
    pub(crate) fn period(&self) -> f64 {
        std::f64::consts::TAU * self.tau
    }

    /// Largest overlap of a node with the body [m], surface by surface.
    pub(crate) fn overlaps<'a>(
        &'a mut self,
        body: &'a Body,
        surfaces: &'a [Placed<'_>],
    ) -> impl Iterator<Item = f64> + 'a {
        self.contacts.iter_mut().zip(surfaces).map(|(contact, placed)| {
            let local = placed.sees(&body.state);
            contact.cover(placed, body, &local, 0.0);
            contact.deepest(placed, &body.shape, &local)
        })
    }
}

#[cfg(feature = "state")]
impl Integrator {
    pub(crate) fn checked(mut self) -> Result<Self, Fault> {
        let EncounterSettings { accuracy, .. } = self.settings;
        let steps = positive(accuracy) && positive(self.eta) && self.eta <= ETA_LIMIT;
        let steps = steps && not_negative(self.next_dt) && not_negative(self.tau);
        require(steps, "the steps of a contact are out of range")?;
        self.dynamics.check()?;
        let counts = [self.node_counts.len(), self.renewals.len()];
        let same = counts == [self.contacts.len(); 2];
        let mut pairs = self.contacts.iter().zip(&self.node_counts);
        let within = pairs.all(|(contact, &nodes)| contact.lies_on(nodes));
        let glued = self.glue.is_empty() || self.glue.len() == self.contacts.len();
        let glue = self.glue.iter_mut().zip(&self.node_counts);
        for (glue, &nodes) in glue.filter_map(|(glue, nodes)| Some((glue.as_mut()?, nodes))) {
            glue.check()?;
            require(glue.lies_on(nodes), "a candidate is no node of its surface")?;
        }
        require(glued, "adhesion and contacts differ in number")?;
        require(same && within, "a candidate is no node of its surface")?;
        let energies = finite(&[self.energy_before, self.supplied, self.short]);
        let hands = self.hands.iter().all(Hand::is_finite);
        let balance = self.balance.is_none_or(|balance| balance.is_finite());
        let finite = energies && hands && balance && self.pull.is_finite();
        require(finite, "the forces of a contact are not finite")?;
        Ok(self)
    }

    /// True when these are surfaces of the sizes that it was made with.
    pub(crate) fn is_made_for<'a>(&self, surfaces: impl IntoIterator<Item = &'a Surface>) -> bool {
        let counts = surfaces.into_iter().map(|surface| surface.nodes().len());
        counts.eq(self.node_counts.iter().copied())
    }

    /// Number of surfaces.
    pub(crate) fn count(&self) -> usize {
        self.contacts.len()
    }
}

//! How the carriers of moving surfaces go through a step of the body that they meet.
//!
//! The struck body and the carriers go through a step alike: half a kick, a drift, the trial, half
//! a kick. Every force on the body acts on the carrier with the opposite sign at the same point,
//! so that the momentum of both, and their angular momentum, change by their loads alone.

use nalgebra::{Isometry3, UnitQuaternion, Vector3};

use crate::body::{Body, State};
use crate::carried::Grip;
use crate::carrier::{Carrier, velocity_at};
use crate::contact::Contact;
use crate::encounter::{Loads, Placed};
use crate::error::PhysicsError;
use crate::flight::{time_to_close, top_speed};
use crate::integrate::{ETA, Integrator};
use crate::node_law::Motion;
use crate::projection::Change;
use crate::rotation::Dynamics;
use crate::toll::Push;
use crate::trial::{Course, Trial};

/// Way of a led body in a step against springs that nothing moves, in pitches at the accuracy of
/// `ETA`: the deepest point of its path over a node lies between two looks.
const LED_PITCH: f64 = 0.03;

/// A carrier in a trial step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ride {
    pub dynamics: Dynamics,
    /// At the end of the step: the carrier, and the frame of its surface.
    pub end: State,
    pub pose: Isometry3<f64>,
    /// Mid-step velocity [m/s] and spin [rad/s], and the displacement and turn they make.
    velocity: Vector3<f64>,
    spin: Vector3<f64>,
    pub shift: Vector3<f64>,
    pub turn: Vector3<f64>,
    /// Of the surface's frame, half-way.
    middle: UnitQuaternion<f64>,
    /// Impulse that placed the end of the step ahead of the balance [N s].
    predicted: f64,
    /// Longest lever of a force on it [m]; infinite below a strip.
    lever: f64,
}

/// What one contact did to the body in a trial, about its centre of mass.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Answer {
    /// Springs, at the end of the step.
    pub springs: Grip,
    /// Sweeping faces and springs of columns over the step, not yet scaled.
    pub flow: Push,
    pub sprung: Push,
    /// Dashpots and adhesion over the step.
    pub damping: Push,
    pub drawn: Push,
}

/// What one contact does to the body, about its centre of mass: its springs at the present
/// instant; columns, dashpots and adhesion in the mean over the last step.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Hand {
    pub springs: Grip,
    pub swept: Grip,
}

impl Hand {
    #[cfg(feature = "state")]
    pub(crate) fn is_finite(&self) -> bool {
        let grips = [self.springs, self.swept];
        grips.iter().all(|g| g.force.iter().chain(g.torque.iter()).all(|x| x.is_finite()))
    }

    fn total(&self) -> Grip {
        let (springs, swept) = (&self.springs, &self.swept);
        Grip { force: springs.force + swept.force, torque: springs.torque + swept.torque }
    }
}

/// Impulses as a grip.
fn grip(push: &Push) -> Grip {
    Grip { force: push.impulse, torque: push.torque }
}

/// The reaction on a carrier at `carrier` to what acts on a body at `body`.
pub(crate) fn reaction(grip: &Grip, body: &State, carrier: &State) -> Grip {
    let arm = body.position - carrier.position;
    Grip { force: -grip.force, torque: -(grip.torque + arm.cross(&grip.force)) }
}

impl Ride {
    fn kick(&self, grip: &Grip, loads: &Loads, time: f64, state: &mut State) {
        if self.dynamics.is_immovable() {
            return;
        }
        let force = grip.force + loads.force;
        let torque = grip.torque + loads.torque;
        state.velocity += self.dynamics.accelerate(&(force * time)) + loads.gravity * time;
        state.spin += self.dynamics.turn(&state.rotation, &(torque * time));
    }

    /// Angular momentum that placing the end of the step made [N m s].
    fn ahead(&self) -> Vector3<f64> {
        match self.dynamics.is_immovable() {
            true => Vector3::zeros(),
            false => self.shift.cross(&self.end.velocity) / self.dynamics.inverse_mass,
        }
    }

    /// The motion of a body on `course` over the step as seen from the surface, in its frame
    /// half-way.
    pub(crate) fn relative(&self, [from, to]: [&State; 2], course: Course) -> Motion {
        let Course { velocity, spin, dt } = course;
        let arm =
            nalgebra::center(&from.position, &to.position) - (self.end.position - 0.5 * self.shift);
        let velocity = velocity - self.velocity - self.spin.cross(&arm);
        let local = |v: Vector3<f64>| self.middle.inverse_transform_vector(&v);
        let turns = self.spin != Vector3::zeros();
        Motion {
            velocity: local(velocity),
            spin: local(spin - self.spin),
            drag: turns.then(|| local(-self.spin)),
            dt,
        }
    }

    /// The frame half-way, for what columns do over the step.
    pub(crate) fn middle(&self) -> Isometry3<f64> {
        Isometry3::from_parts(self.pose.translation, self.middle)
    }
}

impl Integrator {
    /// Prepares the carriers of `surfaces` for stepping.
    pub(crate) fn mount(&mut self, surfaces: &[Placed<'_>]) -> Result<(), PhysicsError> {
        self.dismount();
        if surfaces.iter().all(|placed| placed.carrier.is_none()) {
            // What a surface did before it stood still is not known once it moves again.
            self.hands.clear();
            return Ok(());
        }
        for placed in surfaces {
            self.mounts.push(placed.carrier.as_ref().map(Carrier::dynamics).transpose()?);
        }
        self.hands.resize(surfaces.len(), Hand::default());
        for (hand, mount) in self.hands.iter_mut().zip(&self.mounts) {
            // What a surface did while it stood still is not known.
            if mount.is_none() {
                *hand = Hand::default();
            }
        }
        Ok(())
    }

    /// True when no surface of the call moves: none has a carrier.
    pub(crate) fn surfaces_rest(&self) -> bool {
        self.mounts.is_empty()
    }

    /// Forgets the carriers of the last call.
    fn dismount(&mut self) {
        self.mounts.clear();
        self.rides.clear();
        self.ahead = Vector3::zeros();
    }

    /// An error unless every surface is at rest.
    pub(crate) fn fits_at_rest(&mut self, surfaces: &[Placed<'_>]) -> Result<(), PhysicsError> {
        self.fits(surfaces)?;
        self.dismount();
        match surfaces.iter().all(|placed| placed.carrier.is_none()) {
            true => Ok(()),
            false => Err(PhysicsError::Unsupported {
                what: "a driven or pressed body needs surfaces at rest",
            }),
        }
    }

    /// Takes every carrier through the first half of a step of `dt` [s]: kick and drift, with a
    /// `share` of what columns did in the last step as a prediction.
    pub(crate) fn ride(&mut self, body: &Body, surfaces: &[Placed<'_>], dt: f64, share: f64) {
        if self.surfaces_rest() {
            return;
        }
        self.rides.clear();
        self.ahead = Vector3::zeros();
        for ((placed, mount), hand) in surfaces.iter().zip(&self.mounts).zip(&self.hands) {
            let ride = match (&placed.carrier, mount) {
                (Some(carrier), Some(dynamics)) => {
                    let hand = Hand { swept: hand.swept * share, ..*hand };
                    Some(depart(carrier, placed, dynamics, &hand, &body.state, dt))
                }
                _ => None,
            };
            self.ahead += ride.as_ref().map_or(Vector3::zeros(), Ride::ahead);
            self.rides.push(ride);
        }
        self.answers.clear();
        self.answers.resize(surfaces.len(), Answer::default());
    }

    /// Largest change of a carrier's velocity over `half` a step that its columns predict [m/s].
    pub(crate) fn carriers_prediction(&self, half: f64) -> f64 {
        if self.surfaces_rest() {
            return 0.0;
        }
        let pairs = self.hands.iter().zip(&self.mounts);
        let change = |(hand, mount): (&Hand, &Option<Dynamics>)| {
            Some(mount.as_ref()?.accelerate(&(hand.swept.force * half)).norm())
        };
        pairs.filter_map(change).fold(0.0, f64::max)
    }

    /// Change of the kinetic energy of the body and the carriers by impulses of the last trial.
    pub(crate) fn change(
        &self,
        total: &Push,
        state: &State,
        part: impl Fn(&Answer) -> &Push,
    ) -> Change {
        let mut change = Change::of(total, state, &self.dynamics);
        if self.surfaces_rest() {
            return change;
        }
        for (ride, answer) in self.rides.iter().zip(&self.answers) {
            let Some(ride) = ride else { continue };
            let back = reaction(&grip(part(answer)), state, &ride.end);
            let push = Push { impulse: back.force, torque: back.torque, ..Push::default() };
            change += Change::of(&push, &ride.end, &ride.dynamics);
        }
        change
    }

    /// Gives every carrier the reaction to impulses on the body at `state`.
    pub(crate) fn react(&mut self, state: &State, part: impl Fn(&Answer) -> Push) {
        if self.surfaces_rest() {
            return;
        }
        for ((ride, answer), hand) in self.rides.iter_mut().zip(&self.answers).zip(&mut self.hands)
        {
            let Some(ride) = ride else { continue };
            let push = grip(&part(answer));
            let back = reaction(&push, state, &ride.end);
            ride.end.velocity += ride.dynamics.accelerate(&back.force);
            ride.end.spin += ride.dynamics.turn(&ride.end.rotation, &back.torque);
            hand.swept.force += push.force;
            hand.swept.torque += push.torque;
        }
    }

    /// Begins to sum up what is done to the carriers in a step.
    pub(crate) fn begin_hands(&mut self) {
        self.hands.iter_mut().for_each(|hand| hand.swept = Grip::default());
    }

    /// The second half of the carriers' kick by springs that hold the body at `state`.
    pub(crate) fn kick_carriers(&mut self, surfaces: &[Placed<'_>], state: &State, half: f64) {
        let carriers = surfaces.iter().zip(&mut self.rides).zip(&self.answers);
        for ((placed, ride), answer) in carriers {
            let (Some(carrier), Some(ride)) = (&placed.carrier, ride) else { continue };
            let mut end = ride.end;
            ride.kick(&reaction(&answer.springs, state, &end), &carrier.loads, half, &mut end);
            ride.end = end;
        }
    }

    /// Takes the angular momentum that placing the end of the step made from the carrier that the
    /// columns held most: their impulse acted half-way. Returns the energy that it gained [J].
    pub(crate) fn give_back(&mut self) -> f64 {
        let ahead = self.ahead;
        let strength = |answer: &Answer| {
            let Answer { flow, sprung, damping, drawn, .. } = answer;
            (flow.impulse + sprung.impulse + damping.impulse + drawn.impulse).norm()
        };
        let rides = self.rides.iter_mut().zip(&self.answers);
        let free = rides.filter_map(|(ride, answer)| {
            let ride = ride.as_mut().filter(|ride| !ride.dynamics.is_immovable())?;
            Some((strength(answer) + ride.predicted, ride))
        });
        let most = free.max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, ride)) = most.filter(|(strength, _)| *strength > 0.0) else { return 0.0 };
        let turn = ride.dynamics.turn(&ride.end.rotation, &-ahead);
        let gained = -ride.dynamics.work(&ahead, &(ride.end.spin + 0.5 * turn));
        ride.end.spin += turn;
        gained
    }

    /// Makes the springs of the last trial those of the present instant. Returns the work over the
    /// step of the loads on free carriers and of what leads the others [J].
    pub(crate) fn hold_on(
        &mut self,
        body: &Body,
        surfaces: &[Placed<'_>],
        end: &State,
        dt: f64,
    ) -> f64 {
        let mut work = 0.0;
        let carriers = surfaces.iter().zip(&self.rides).zip(&self.answers);
        for (((placed, ride), answer), hand) in carriers.zip(&mut self.hands) {
            let (Some(carrier), Some(ride)) = (&placed.carrier, ride) else { continue };
            work += match &carrier.inertia {
                Some(inertia) if !ride.dynamics.is_immovable() => {
                    let pull = carrier.loads.pull(inertia);
                    pull.dot(&ride.shift) + carrier.loads.torque.dot(&ride.turn)
                }
                _ => {
                    let before = reaction(&hand.springs, &body.state, &carrier.state) * (0.5 * dt);
                    let after = reaction(&answer.springs, end, &ride.end) * (0.5 * dt);
                    let swept = reaction(&hand.swept, end, &ride.end);
                    let force = before.force + after.force + swept.force;
                    let torque = before.torque + after.torque + swept.torque;
                    -(force.dot(&ride.velocity) + torque.dot(&ride.spin))
                }
            };
            *hand = Hand { springs: answer.springs, swept: hand.swept * (1.0 / dt) };
        }
        work
    }

    /// Velocity [m/s] and acceleration [m/s2] of the material that the body leans on most; zeros
    /// at rest.
    pub(crate) fn motion_below(&self, body: &Body, surfaces: &[Placed<'_>]) -> [Vector3<f64>; 2] {
        let hands = self.hands.iter().zip(&self.mounts).zip(surfaces);
        let moving = hands.filter_map(|((hand, mount), placed)| {
            Some((hand.total(), mount.as_ref()?, placed.carrier.as_ref()?))
        });
        let most = moving.max_by(|a, b| a.0.force.norm().total_cmp(&b.0.force.norm()));
        let Some((grip, dynamics, carrier)) = most else { return Default::default() };
        let moved: Vector3<f64> = self.hands.iter().map(|hand| hand.total().force).sum();
        if grip.force.norm() < (self.pull.force - moved).norm() {
            // It leans more on surfaces at rest.
            return Default::default();
        }
        let state = &carrier.state;
        let arm = body.state.position - state.position;
        let back = reaction(&grip, &body.state, state);
        let mut acceleration = state.spin.cross(&state.spin.cross(&arm));
        if !dynamics.is_immovable() {
            let Loads { gravity, force, torque, .. } = &carrier.loads;
            acceleration += dynamics.accelerate(&(back.force + force)) + gravity;
            acceleration += dynamics.turn(&state.rotation, &(back.torque + torque)).cross(&arm);
        }
        [velocity_at(state, &body.state), acceleration]
    }

    /// Highest angular frequency [1/s] of the body and the carriers on the touching springs.
    pub(crate) fn omega(&self, trial: &Trial) -> f64 {
        if self.surfaces_rest() {
            return trial.omega(&self.dynamics, 0.0);
        }
        let reach = trial.lever();
        let of = |ride: &Ride| {
            let apart = (trial.state.position - ride.end.position).norm() + reach;
            let lever = apart.min(ride.lever);
            ride.dynamics.inverse_mass + ride.dynamics.agility() * lever * lever
        };
        trial.omega(&self.dynamics, self.rides.iter().flatten().map(of).fold(0.0, f64::max))
    }

    /// Longest step of springs between two that nothing moves: they have no frequency to bound it, so
    /// the way does.
    pub(crate) fn led_limit(&self, body: &Body, surfaces: &[Placed<'_>]) -> f64 {
        if !self.dynamics.is_immovable() {
            return f64::INFINITY;
        }
        let limit = |(contact, placed): (&Contact, &Placed<'_>)| {
            let led = placed.keeps_its_motion() && contact.sweep_reach(placed.surface).is_none();
            let reach = LED_PITCH * self.eta / ETA * placed.surface.pitch();
            led.then(|| time_to_close(reach, top_speed(placed, body), 0.0))
        };
        self.contacts.iter().zip(surfaces).filter_map(limit).fold(f64::INFINITY, f64::min)
    }

    /// Makes the last trial the state of the carriers; returns what their damping took [J].
    pub(crate) fn arrive(&mut self, surfaces: &mut [Placed<'_>], dt: f64) -> f64 {
        let mut damped = 0.0;
        for (placed, ride) in surfaces.iter_mut().zip(&self.rides) {
            let (Some(carrier), Some(ride)) = (&mut placed.carrier, ride) else { continue };
            carrier.state = ride.end;
            placed.pose = ride.pose;
            if !ride.dynamics.is_immovable() {
                let before = carrier.kinetic_energy();
                carrier.state.velocity /= 1.0 + dt * carrier.loads.linear_damping;
                carrier.state.spin /= 1.0 + dt * carrier.loads.angular_damping;
                damped += before - carrier.kinetic_energy();
            }
        }
        damped
    }
}

/// A carrier's half kick and drift.
fn depart(
    carrier: &Carrier,
    placed: &Placed<'_>,
    dynamics: &Dynamics,
    hand: &Hand,
    body: &State,
    dt: f64,
) -> Ride {
    let start = carrier.state;
    let mut ride = Ride {
        dynamics: *dynamics,
        end: start,
        pose: placed.pose,
        velocity: Vector3::zeros(),
        spin: Vector3::zeros(),
        shift: Vector3::zeros(),
        turn: Vector3::zeros(),
        middle: placed.pose.rotation,
        predicted: hand.swept.force.norm() * 0.5 * dt,
        lever: placed.surface.ball().map_or(f64::INFINITY, |(centre, radius)| {
            (placed.pose * centre - start.position).norm() + radius
        }),
    };
    let mut state = start;
    ride.kick(&reaction(&hand.springs, body, &start), &carrier.loads, 0.5 * dt, &mut state);
    let kicked = state;
    // The last mean force of columns places the step's end, as for the body.
    let swept = reaction(&hand.swept, body, &start);
    state.velocity += dynamics.accelerate(&(swept.force * (0.5 * dt)));
    ride.velocity = state.velocity;
    ride.spin = dynamics.drift(&mut state, dt);
    state.velocity = kicked.velocity;
    ride.shift = ride.velocity * dt;
    ride.turn = ride.spin * dt;
    ride.end = state;
    ride.pose = state.pose() * (start.pose().inverse() * placed.pose);
    ride.middle = UnitQuaternion::from_scaled_axis(-0.5 * ride.turn) * ride.pose.rotation;
    ride
}

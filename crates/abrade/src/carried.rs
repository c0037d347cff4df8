//! A body that something else moves, such as the solver of an engine in small steps: the surfaces
//! answer with a force, and wear as it goes.
//!
//! The mover applies the force of the present instant and takes a step (symplectic Euler); the
//! surfaces follow. Columns, whose force is a mean over a step, are asked about the step ahead.

use std::borrow::Cow;
use std::ops::Mul;

use nalgebra::{Isometry3, Vector3};

use crate::body::{Body, State};
use crate::damping::Damping;
use crate::encounter::{EncounterSettings, Loads, Placed};
use crate::error::PhysicsError;
use crate::integrate::Integrator;
use crate::ledger::Ledger;
use crate::reject::rejected;
use crate::settle::Charge;
#[cfg(feature = "state")]
use crate::state::{Fault, finite, not_negative, require};
use crate::surface::Surface;
use crate::trial::{Course, Trial};

/// Share of the step of springs that columns get: no projection closes their energy here, so that
/// their error is of first order.
const COLUMNS: f64 = 0.3;

/// Contact of a body that something else moves.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "state", serde(remote = "Self"))]
pub struct Carried {
    integrator: Integrator,
    #[cfg_attr(feature = "state", serde(skip))]
    pending: Option<Pending>,
    /// Impulse of the last step's dashpots [N s] and its torque [N m s], which the next step gets.
    owed: [Vector3<f64>; 2],
    /// What columns did in the last step.
    swept: Grip,
    #[cfg_attr(feature = "state", serde(skip))]
    foreseen: Foreseen,
    /// Length of the last step, if it ended in contact [s].
    last: f64,
    evaluations: u64,
}

/// What columns will have done in the step ahead.
#[derive(Clone, Copy, Debug, Default)]
struct Foreseen {
    grip: Grip,
    /// Energy that their springs are short of, and what of that of before they let go unpaid [J].
    short: f64,
    forgiven: f64,
    /// Length of a step that they should be asked about instead [s].
    shorter: Option<f64>,
}

/// What the surfaces do to a carried body.
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Grip {
    /// Force on the body [N].
    pub force: Vector3<f64>,
    /// Torque about its centre of mass [N m].
    pub torque: Vector3<f64>,
}

/// Whether the surfaces can follow a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Met {
    /// They can.
    Fits,
    /// It is too long for the springs that it meets: a step of this length [s] should be tried.
    TooLong(f64),
}

/// A step that the surfaces can follow.
#[derive(Clone, Debug)]
struct Pending {
    trial: Trial,
    end: State,
    dt: f64,
    /// Step that the springs allow [s].
    allowed: f64,
    damping: Damping,
}

impl Mul<f64> for Grip {
    type Output = Self;

    fn mul(self, by: f64) -> Self {
        Self { force: self.force * by, torque: self.torque * by }
    }
}

impl Grip {
    /// Given in a frame at `pose`, seen from outside it.
    pub(crate) fn turned(&self, pose: &Isometry3<f64>) -> Self {
        Self { force: pose * self.force, torque: pose * self.torque }
    }
}

impl Carried {
    /// A carried `body` near `surfaces`, not yet in contact.
    ///
    /// # Errors
    /// As [`Encounter::new`](crate::Encounter::new).
    pub fn new<'a>(
        body: &Body,
        surfaces: impl IntoIterator<Item = &'a Surface>,
        settings: EncounterSettings,
    ) -> Result<Self, PhysicsError> {
        let mut integrator = Integrator::new(body, surfaces, settings)?;
        if integrator.has_columns() {
            integrator.eta *= COLUMNS;
        }
        Ok(Self {
            integrator,
            pending: None,
            owed: Default::default(),
            swept: Grip::default(),
            foreseen: Default::default(),
            last: 0.0,
            evaluations: 0,
        })
    }

    /// Largest overlap of a node with the body [m], surface by surface; none of surfaces that it was
    /// not made with.
    pub fn overlaps(&mut self, body: &Body, surfaces: &[Placed<'_>]) -> Vec<f64> {
        if self.integrator.fits_at_rest(surfaces).is_err() {
            return Vec::new();
        }
        self.integrator.overlaps(body, surfaces).collect()
    }

    /// Length of the next step [s]: in contact a share of the period on the springs; out of it
    /// the time in which no node can be touched under `loads`. Zero between surfaces that it was not
    /// made with, which [`Carried::meet`] refuses.
    pub fn step(&mut self, body: &Body, surfaces: &[Placed<'_>], loads: &Loads) -> f64 {
        if self.integrator.fits_at_rest(surfaces).is_err() {
            return 0.0;
        }
        // A symplectic step leaves the velocity half a kick behind the position.
        let mut body = Cow::Borrowed(body);
        let pull = self.integrator.pull.spring_force * (0.5 * self.last);
        if pull != Vector3::zeros() {
            body.to_mut().state.velocity += self.integrator.dynamics.accelerate(&pull);
        }
        self.integrator.next_step(&body, surfaces, loads).0
    }

    /// What the surfaces do to the body during a step of `dt` [s] from its present state.
    ///
    /// The force of springs is scaled so that its impulse is that of half the step before and
    /// half the coming one: symplectic Euler with steps of changing length is then leapfrog.
    pub fn grip(&mut self, body: &Body, surfaces: &[Placed<'_>], dt: f64) -> Grip {
        if self.integrator.fits_at_rest(surfaces).is_err() {
            return Grip::default();
        }
        let share = if self.last > 0.0 { 0.5 * (self.last + dt) / dt } else { 1.0 };
        let pull = self.integrator.pull;
        let mut springs = Grip { force: pull.spring_force, torque: pull.spring_torque } * share;
        springs.force += self.owed[0] / dt;
        springs.torque += self.owed[1] / dt;
        if !self.integrator.has_columns() && !self.integrator.adheres() {
            return springs;
        }
        let dynamics = self.integrator.dynamics;
        let mut end = body.state;
        end.velocity += dynamics.accelerate(&(self.swept.force * (0.5 * dt)));
        end.spin += dynamics.turn(&end.rotation, &(self.swept.torque * (0.5 * dt)));
        let (velocity, spin) = (end.velocity, end.spin);
        dynamics.drift(&mut end, dt);
        let trial = self.integrator.ask(body, surfaces, &end, Course { velocity, spin, dt });
        let mut state = body.state;
        if self.integrator.adheres() {
            self.integrator.apply(&self.integrator.attraction.push.scaled(0.5), &mut state);
        }
        let charge = self.integrator.charge(&trial.toll, [0.0; 2], &mut state);
        let drawn = self.integrator.attraction.mean(dt);
        let swept = Grip {
            force: charge.impulse / dt + drawn.force,
            torque: charge.torque / dt + drawn.torque,
        };
        let allowed = self.integrator.eta / self.integrator.omega(&trial);
        let shorter = rejected(&trial, dt, allowed);
        let Charge { short, forgiven, .. } = charge;
        self.foreseen = Foreseen { grip: swept, short, forgiven, shorter };
        Grip { force: springs.force + swept.force, torque: springs.torque + swept.torque }
    }

    /// Asks the surfaces whether they can follow the body to `end` over `dt` [s]; changes nothing.
    ///
    /// # Errors
    /// A state that is not finite.
    pub fn meet(
        &mut self,
        body: &Body,
        surfaces: &[Placed<'_>],
        end: &State,
        dt: f64,
    ) -> Result<Met, PhysicsError> {
        self.integrator.fits_at_rest(surfaces)?;
        // A force from too long a step may have thrown the body to where it touches nothing.
        if let Some(shorter) = self.foreseen.shorter {
            return Ok(Met::TooLong(shorter));
        }
        let velocity = (end.position - body.state.position) / dt;
        let spin = (end.rotation * body.state.rotation.inverse()).scaled_axis() / dt;
        let course = Course { velocity, spin, dt };
        let trial = self.integrator.ask(body, surfaces, end, course);
        self.evaluations += trial.evaluations;
        if !self.integrator.is_finite(&trial) {
            return Err(PhysicsError::NotFinite { time: dt });
        }
        let damping = match self.integrator.is_damped {
            true => {
                self.integrator.damp(surfaces, &trial);
                self.integrator.damping
            }
            false => Damping::default(),
        };
        let omega = self.integrator.omega(&trial).max(damping.rate);
        let allowed = self.integrator.eta / omega;
        let shorter = rejected(&trial, dt, allowed);
        self.pending =
            shorter.is_none().then_some(Pending { trial, end: *end, dt, allowed, damping });
        Ok(shorter.map_or(Met::Fits, Met::TooLong))
    }

    /// Lets nodes and springs follow to where [`Carried::meet`] found that they can.
    ///
    /// # Errors
    /// The body has gone below the surface.
    pub fn follow(
        &mut self,
        body: &mut Body,
        surfaces: &mut [Placed<'_>],
    ) -> Result<(), PhysicsError> {
        self.integrator.fits_at_rest(surfaces)?;
        let Some(Pending { trial, end, dt, allowed, damping }) = self.pending.take() else {
            return Ok(());
        };
        let next_dt = self.integrator.step_after(dt, allowed);
        self.owed = [damping.impulse, damping.torque];
        (self.swept, self.integrator.short) = (self.foreseen.grip, self.foreseen.short);
        self.integrator.book_damping(damping.dissipated);
        self.integrator.book_forgiven(self.foreseen.forgiven);
        self.last = if trial.touching > 0 { dt } else { 0.0 };
        if trial.touching > 0 {
            self.integrator.touched = true;
        }
        self.integrator.lead(body, surfaces, &trial, [end.velocity, end.spin]);
        self.integrator.keep_step(next_dt, self.integrator.eta / allowed);
        if self.integrator.touched && self.integrator.contact_is_over(body, surfaces) {
            self.integrator.end_contact(surfaces);
        }
        self.integrator.check_depth(body, surfaces)
    }

    /// Lets go of the surfaces in the middle of a contact: what the springs hold is lost, and
    /// overhangs break off.
    pub fn let_go(&mut self, surfaces: &mut [Placed<'_>]) {
        if self.integrator.fits_at_rest(surfaces).is_ok() {
            self.integrator.let_go(surfaces);
        }
        self.owed = Default::default();
        self.swept = Grip::default();
        self.last = 0.0;
    }

    /// Overlap at which the first spring yields [m]; zero without springs.
    pub fn yield_overlap(&self) -> f64 {
        let least = self.integrator.yield_overlap();
        if least.is_finite() { least } else { 0.0 }
    }

    /// True while a node carries force.
    pub fn in_contact(&self) -> bool {
        self.integrator.in_contact()
    }

    /// Force of the surfaces on the body at the present instant [N].
    pub fn force(&self) -> Vector3<f64> {
        self.integrator.pull.force
    }

    /// Period of the body on the springs that it touched last [s]; zero before any contact, and on
    /// surfaces without springs.
    pub fn period(&self) -> f64 {
        self.integrator.period()
    }

    /// Nodes taken through the law so far.
    pub fn node_evaluations(&self) -> u64 {
        self.evaluations
    }

    /// The energies; zeros unless asked for. The kinetic energy is the mover's: what it gave to
    /// the contact is `external_work`.
    pub fn ledger(&self) -> &Ledger {
        self.integrator.ledger()
    }
}

#[cfg(feature = "state")]
impl Carried {
    /// True when these are surfaces of the sizes that it was made with; with others it does nothing, or ends in an error.
    pub fn is_made_for<'a>(&self, surfaces: impl IntoIterator<Item = &'a Surface>) -> bool {
        self.integrator.is_made_for(surfaces)
    }

    pub(crate) fn checked(self) -> Result<Self, Fault> {
        let parts = self.owed.iter().chain([&self.swept.force, &self.swept.torque]);
        let owed = parts.into_iter().all(|part| finite(part.iter()));
        let counted = self.evaluations < u64::MAX / 2;
        require(not_negative(self.last) && owed && counted, "a carried body is out of range")?;
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{HexStrip, Hull, Material, Piece, Shape, SurfaceLaws, cuboid_vertices};
    use nalgebra::{Isometry3, Point3};

    /// Fails for columns whose force over too long a step throws the body to where it touches
    /// nothing, which fits.
    #[test]
    fn a_step_that_columns_cannot_foresee_is_too_long() {
        let material = Material {
            hardness: 6.6e9,
            shear_ratio: 0.25,
            young: Some(200e9),
            poisson: 0.3,
            friction: 0.0,
        };
        let strip = HexStrip { length: 10e-3, width: 10e-3, pitch: 0.5e-3, rest_area: None };
        let mut surface = Surface::hex_strip(strip, SurfaceLaws::of(material)).expect("a plate");
        let (hull, inertia, _) =
            Hull::solid(&cuboid_vertices(&Vector3::repeat(2e-3)), 300.0).expect("a cube");
        let shape = Shape::union(vec![Piece::Hull(hull)]).expect("a cube");
        let mut state = State::at(Point3::new(0.0, 0.0, 2e-3 + 1e-9));
        state.velocity.z = -1.0;
        let body = Body { shape, inertia, state, rotation_locked: false };
        let settings = EncounterSettings::default();
        let mut carried = Carried::new(&body, [&surface], settings).expect("columns");
        let placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
        let long = 1e-5;
        let force = carried.grip(&body, &placed, long).force;
        let mut end = body.state;
        end.velocity += force * (long / body.inertia.mass);
        end.position += end.velocity * long;
        assert!(end.position.z > body.state.position.z, "the force throws the body off");
        let met = carried.meet(&body, &placed, &end, long).expect("a finite state");
        let Met::TooLong(shorter) = met else { panic!("it fits") };
        assert!(shorter < 0.1 * long, "{shorter:e}");
    }
}

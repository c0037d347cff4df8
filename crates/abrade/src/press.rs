//! A body held against surfaces by a known load, without inertia: at every increment of its path
//! the height at which the nodes carry the load.
//!
//! The paper's driven scratch (Section 3.3) and whatever an engine holds against a surface at
//! steps that do not resolve the springs.

use nalgebra::{UnitQuaternion, Vector3};

use crate::balance::{LOAD, Search};
use crate::body::{Body, State};
use crate::encounter::{Advance, EncounterSettings, Instant, Observer, Placed};
use crate::error::PhysicsError;
use crate::integrate::Integrator;
use crate::ledger::Ledger;
use crate::surface::Surface;
use crate::trial::{Course, Trial};

/// An increment of a pressed body.
pub(crate) struct Press {
    /// Displacement [m] and turn [rad], but for the sinking.
    pub along: Vector3<f64>,
    pub turn: Vector3<f64>,
    /// Unit vector along which the body is pressed.
    pub down: Vector3<f64>,
    /// Load [N], and its relative tolerance.
    pub load: f64,
    pub tolerance: f64,
    /// Farthest sinking at which the load is sought, if it is bound [m].
    pub reach: Option<f64>,
}

/// A way in equal increments.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Creep {
    /// Time of the whole [s].
    pub duration: f64,
    /// Number of increments.
    pub count: f64,
    /// Sinking that a search for the load begins with [m].
    pub scale: f64,
}

impl Integrator {
    /// The trial of an increment after which the load is balanced, with the node evaluations of the
    /// whole search, which begins where the last one ended, or else `scale` [m] to either side.
    /// Commits nothing.
    pub(crate) fn press(
        &mut self,
        body: &Body,
        placed: &[Placed<'_>],
        press: &Press,
        scale: f64,
    ) -> Result<Trial, PhysicsError> {
        let limit = 2.0 * body.shape.bounding_radius() + scale;
        let last = self.balance;
        let mut evaluations = 0;
        let mut asked = None;
        let search = Search::new(press.load, press.tolerance, |sink| {
            let trial = self.push(body, placed, press, sink);
            evaluations += trial.evaluations;
            let over = -self.grip(&trial).force.dot(&press.down) - press.load;
            asked = Some(trial);
            over
        });
        let found = search.find(last, scale, limit, press.reach)?;
        self.balance = Some(found);
        let mut trial = asked.expect("a search asks");
        trial.evaluations = evaluations;
        Ok(trial)
    }

    /// Takes a body through equal increments, each ending where the load is balanced.
    pub(crate) fn creep(
        &mut self,
        body: &mut Body,
        placed: &mut [Placed<'_>],
        press: &Press,
        creep: &Creep,
        observer: &mut dyn Observer,
    ) -> Result<Advance, PhysicsError> {
        self.fits_at_rest(placed)?;
        let Creep { duration, count, scale } = *creep;
        let dt = duration / count;
        let mut done = Advance { time: duration, contact_time: duration, ..Advance::default() };
        for i in 0..count as u64 {
            let trial = self.press(body, placed, press, scale)?;
            if !self.is_finite(&trial) {
                return Err(PhysicsError::NotFinite { time: i as f64 * dt });
            }
            done.node_evaluations += trial.evaluations;
            done.steps += 1;
            if done.steps > self.step_limit() {
                return Err(PhysicsError::TooManySteps { steps: done.steps });
            }
            self.touched |= trial.touching > 0;
            let spin =
                if press.turn == Vector3::zeros() { body.state.spin } else { press.turn / dt };
            self.lead(body, placed, &trial, [trial.shift / dt, spin]);
            done.impulse += self.pull.force * dt;
            done.twist += self.pull.torque * dt;
            self.check_depth(body, placed)?;
            observer.observe(&Instant {
                time: (i + 1) as f64 * dt,
                state: &body.state,
                force: self.pull.force,
                surfaces: placed,
                ledger: self.kept_ledger(),
            });
        }
        Ok(done)
    }

    /// The trial of an increment by which the body sinks `sink` [m].
    fn push(&mut self, body: &Body, placed: &[Placed<'_>], press: &Press, sink: f64) -> Trial {
        let shift = press.along + press.down * sink;
        let mut end = body.state;
        end.position += shift;
        end.rotation = UnitQuaternion::from_scaled_axis(press.turn) * end.rotation;
        self.ask(body, placed, &end, Course { velocity: shift, spin: press.turn, dt: 1.0 })
    }
}

/// A body that is held against surfaces.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub struct Pressed {
    integrator: Integrator,
}

/// What holds a pressed body, and how finely its path is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hold {
    /// Load that presses the body against the surfaces [N]; its direction is the one in which the
    /// body finds its height.
    pub load: Vector3<f64>,
    /// Time of the move [s].
    pub duration: f64,
    /// Longest way of a point of the body between two balances of the load [m].
    pub increment: f64,
    /// Most balances of a move; a longer one is sampled more coarsely.
    pub limit: u64,
    /// Farthest sinking of an increment [m], if it is bound: a load that is not carried within it, or
    /// only by a force that jumps past it, is then not reached.
    pub reach: Option<f64>,
}

impl Pressed {
    /// A pressed `body` near `surfaces`, not yet in contact.
    ///
    /// # Errors
    /// As [`Encounter::new`](crate::Encounter::new).
    pub fn new<'a>(
        body: &Body,
        surfaces: impl IntoIterator<Item = &'a Surface>,
        settings: EncounterSettings,
    ) -> Result<Self, PhysicsError> {
        Ok(Self { integrator: Integrator::new(body, surfaces, settings)? })
    }

    /// Moves the body to `end`, but for its height, wearing what it is pressed against.
    ///
    /// # Errors
    /// A load that the surfaces do not carry; a physical state outside the model's reach.
    pub fn advance(
        &mut self,
        body: &mut Body,
        placed: &mut [Placed<'_>],
        end: &State,
        hold: &Hold,
        observer: &mut dyn Observer,
    ) -> Result<Advance, PhysicsError> {
        self.integrator.fits_at_rest(placed)?;
        let is_sound = |x: f64| x > 0.0 && x.is_finite();
        let load = hold.load.norm();
        if !(is_sound(hold.increment) && is_sound(hold.duration) && load.is_finite()) {
            let what =
                "increment and duration of a hold must be above zero, and with its load finite";
            return Err(PhysicsError::Unsupported { what });
        }
        let Some(down) = hold.load.try_normalize(0.0) else {
            return Ok(Advance { time: hold.duration, ..Advance::default() });
        };
        if !self.integrator.touched {
            self.integrator.lift(body, placed, &down);
        }
        let way = end.position - body.state.position;
        let way = way - down * down.dot(&way);
        let turn = (end.rotation * body.state.rotation.inverse()).scaled_axis();
        let length = way.norm() + turn.norm() * body.shape.bounding_radius();
        let count = (length / hold.increment).ceil().clamp(1.0, hold.limit.max(1) as f64);
        let reach = hold.reach;
        let (along, turn) = (way / count, turn / count);
        let press = Press { along, turn, down, load, tolerance: LOAD, reach };
        let creep = Creep { duration: hold.duration, count, scale: hold.increment };
        self.integrator.creep(body, placed, &press, &creep, observer)
    }

    /// Ends the contact: what its springs hold is lost, and overhangs break off.
    pub fn end(&mut self, surfaces: &mut [Placed<'_>]) {
        if self.integrator.fits(surfaces).is_ok() {
            self.integrator.let_go(surfaces);
        }
    }

    /// Force of the surfaces on the body at the end of the last increment [N].
    pub fn force(&self) -> Vector3<f64> {
        self.integrator.pull.force
    }

    /// The energies; zeros unless asked for.
    pub fn ledger(&self) -> &Ledger {
        self.integrator.ledger()
    }
}

#[cfg(feature = "state")]
impl Pressed {
    /// True when these are surfaces of the sizes that it was made with; with others it does nothing, or ends in an error.
    pub fn is_made_for<'a>(&self, surfaces: impl IntoIterator<Item = &'a Surface>) -> bool {
        self.integrator.is_made_for(surfaces)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Isometry3;

    use super::*;
    use crate::body::Inertia;
    use crate::layout::HexStrip;
    use crate::material::Material;
    use crate::shape::Shape;
    use crate::surface::SurfaceLaws;

    /// Fails for a search that begins anew at every increment, and for one that counts the nodes of
    /// the last trial alone.
    #[test]
    fn a_search_for_the_load_goes_on_from_the_last_one() {
        let material = Material {
            hardness: 1.7e9,
            shear_ratio: 0.25,
            young: Some(200e9),
            poisson: 0.3,
            friction: 0.5,
        };
        let strip = HexStrip { length: 30e-3, width: 12e-3, pitch: 0.6e-3, rest_area: None };
        let mut surface = Surface::hex_strip(strip, SurfaceLaws::of(material)).expect("a surface");
        let mut body = Body {
            shape: Shape::ball(10e-3).expect("a ball"),
            inertia: Inertia::of_ball(10e-3, 8000.0),
            state: State::at(nalgebra::Point3::new(-8e-3, 0.0, 10e-3)),
            rotation_locked: true,
        };
        let settings = EncounterSettings::default();
        let mut integrator = Integrator::new(&body, [&surface], settings).expect("an integrator");
        let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
        let (count, load, scale) = (200, 10e3, 0.05e-3);
        let mut press = Press {
            along: Vector3::zeros(),
            turn: Vector3::zeros(),
            down: -Vector3::z(),
            load,
            tolerance: LOAD,
            reach: None,
        };
        let (mut trials, mut least) = (0.0, f64::INFINITY);
        for i in 0..=count {
            let trial = integrator.press(&body, &placed, &press, scale).expect("a balance");
            let force = integrator.grip(&trial).force;
            assert!((force.z / load - 1.0).abs() < LOAD);
            integrator.lead(&mut body, &mut placed, &trial, [Vector3::zeros(); 2]);
            // The first one sinks where it stands, from nothing that it knows.
            if i > 0 {
                let trial = trial.evaluations as f64 / trial.touching as f64;
                (trials, least) = (trials + trial, least.min(trial));
            }
            press.along = Vector3::x() * scale;
        }
        let mean = trials / f64::from(count);
        println!("{mean} trials per increment, at least {least}");
        assert!(mean < 5.0 && least > 1.5, "{mean} {least}");
    }
}

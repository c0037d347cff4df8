//! Driven bodies: pressed into a surface up to a load, then slid at constant speed under constant
//! load, rotation locked (Capozza & Hanley, Section 3: indentation and scratching).

use nalgebra::Vector3;

use crate::balance::{LOAD, Search, slide_tolerance};
use crate::body::Body;
use crate::encounter::{Advance, EncounterSettings, Instant, Loads, Observer, Placed, Until};
use crate::error::PhysicsError;
use crate::integrate::Integrator;
use crate::ledger::Ledger;
use crate::press::{Creep, Press};
#[cfg(feature = "state")]
use crate::state::{Fault, not_negative, require};
use crate::surface::Surface;
use crate::trial::{Course, Trial};

/// Increments of the indentation in yield overlaps, and in pitches without springs.
const INDENT_YIELD: f64 = 0.1;
const INDENT_PITCH: f64 = 0.01;
/// Share of the distance that the sum of the steps may have lost by rounding: such a rest is no step.
const ROUNDING: f64 = 1e-9;

/// What a driven body does.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub struct Drive {
    /// Load at which the indentation ends [N].
    pub indent_to: f64,
    /// Load while sliding [N].
    pub load: f64,
    /// Sliding speed along the surface's x [m/s].
    pub speed: f64,
    /// Sliding distance [m]; zero only indents.
    pub distance: f64,
    /// Mass that moves vertically while sliding [kg].
    pub mass: f64,
    /// How the sliding is solved.
    pub solution: DriveSolution,
}

/// How the vertical motion of a sliding body follows from its load.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub enum DriveSolution {
    /// Newton's law for the driven mass.
    Dynamic,
    /// Balance of the load at every increment of travel.
    QuasiStatic {
        /// Increment of travel [m].
        increment: f64,
    },
}

impl Drive {
    /// True for values that end the searches for a load.
    fn is_sound(&self) -> bool {
        let increment = match self.solution {
            DriveSolution::Dynamic => 1.0,
            DriveSolution::QuasiStatic { increment } => increment,
        };
        [self.indent_to, self.load, increment].iter().all(|x| x.is_finite() && *x > 0.0)
            && self.distance >= 0.0
            && (self.distance == 0.0 || self.speed > 0.0)
            && self.speed.is_finite()
            && self.distance.is_finite()
    }
}

/// A driven body in its course.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "state", serde(remote = "Self"))]
pub struct Driven {
    drive: Drive,
    integrator: Integrator,
    travelled: f64,
    /// How far [`Driven::indent`] has pressed the body in [m].
    pressed_in: f64,
}

impl Driven {
    /// A driven `body` above `surface`: it gets the mass of the drive, stands still and no longer turns. One that
    /// is refused stays as it was.
    ///
    /// # Errors
    /// A law that does not go with the body's shape, a mass that cannot move, or a drive out of
    /// range.
    pub fn new(
        body: &mut Body,
        surface: &Surface,
        drive: Drive,
        settings: EncounterSettings,
    ) -> Result<Self, PhysicsError> {
        if !drive.is_sound() {
            let what = "a drive's loads and increment must be above zero, its distance not below, its \
                        speed above zero where it slides, all of them finite";
            return Err(PhysicsError::Unsupported { what });
        }
        let mut led = body.clone();
        led.rotation_locked = true;
        led.inertia.mass = drive.mass;
        led.state.velocity = Vector3::zeros();
        led.state.spin = Vector3::zeros();
        let integrator = Integrator::new(&led, [surface], settings)?;
        *body = led;
        Ok(Self { drive, integrator, travelled: 0.0, pressed_in: 0.0 })
    }

    /// The drive.
    pub fn drive(&self) -> &Drive {
        &self.drive
    }

    /// Distance slid so far [m].
    pub fn travelled(&self) -> f64 {
        self.travelled
    }

    /// True when the whole distance is slid.
    pub fn is_done(&self) -> bool {
        self.travelled >= self.drive.distance
    }

    /// Ends the contact: what its springs hold is lost, and overhangs break off. Leaves surfaces alone
    /// that it was not made with.
    pub fn end(&mut self, surfaces: &mut [Placed<'_>]) {
        if self.integrator.fits(surfaces).is_ok() {
            self.integrator.let_go(surfaces);
        }
    }

    /// The energies since the sliding began; zeros unless asked for.
    pub fn ledger(&self) -> &Ledger {
        self.integrator.ledger()
    }

    /// Force of the surface on the body at the present instant [N].
    pub fn force(&self) -> Vector3<f64> {
        self.integrator.pull.force
    }

    /// Presses the body straight down until the surface answers with `indent_to`; takes no time.
    ///
    /// # Errors
    /// A load that is not reached before the body is pressed in by its own size, in this call and those before,
    /// or within the limit of steps.
    pub fn indent(
        &mut self,
        body: &mut Body,
        placed: &mut [Placed<'_>; 1],
        observer: &mut dyn Observer,
    ) -> Result<Advance, PhysicsError> {
        self.integrator.fits_at_rest(placed)?;
        let down = -(placed[0].pose.rotation * Vector3::z());
        let overlap = self.integrator.contacts[0].yield_overlap();
        let increment = match overlap.is_finite() {
            true => INDENT_YIELD * overlap,
            false => INDENT_PITCH * placed[0].surface.pitch(),
        };
        let gap = self.integrator.gap(body, placed);
        body.state.position += down * gap.max(0.0);
        let limit = body.shape.bounding_radius();
        let mut done = Advance::default();
        loop {
            if self.pressed_in > limit {
                let (load, depth) = (self.drive.indent_to, self.pressed_in);
                return Err(PhysicsError::LoadNotReached { load, depth });
            }
            if done.steps > self.integrator.step_limit() {
                return Err(PhysicsError::TooManySteps { steps: done.steps });
            }
            let target = self.drive.indent_to;
            let load = |force: Vector3<f64>| -force.dot(&down);
            let mut trial = self.push(body, placed, down * increment);
            done.node_evaluations += trial.evaluations;
            let mut step = increment;
            let over = load(self.integrator.grip(&trial).force) - target;
            if over >= 0.0 {
                let ends = [[0.0, load(self.force()) - target], [increment, over]];
                let (sink, found) = self.find(body, placed, down, ends, target);
                (step, trial) = (sink, found);
                done.node_evaluations += trial.evaluations;
            }
            let reached = load(self.integrator.grip(&trial).force) >= (1.0 - LOAD) * target;
            self.pressed_in += step;
            done.steps += 1;
            self.lead(body, placed, &trial);
            observer.observe(&Instant {
                time: 0.0,
                state: &body.state,
                force: self.force(),
                surfaces: placed,
                ledger: None,
            });
            if reached {
                self.integrator.restart(body, &-down);
                return Ok(done);
            }
        }
    }

    /// Slides for `duration` [s], or to the end of the distance if that comes first.
    ///
    /// # Errors
    /// A physical state outside the model's reach.
    pub fn advance(
        &mut self,
        body: &mut Body,
        placed: &mut [Placed<'_>; 1],
        duration: f64,
        observer: &mut dyn Observer,
    ) -> Result<Advance, PhysicsError> {
        if duration.is_nan() || duration <= 0.0 || self.is_done() {
            return Ok(Advance::default());
        }
        let left = (self.drive.distance - self.travelled) / self.drive.speed;
        let last = left - duration <= ROUNDING * (self.drive.distance / self.drive.speed);
        let duration = if last { left } else { duration };
        let advance = match self.drive.solution {
            DriveSolution::Dynamic => {
                let rotation = placed[0].pose.rotation;
                let vertical = rotation * Vector3::z();
                let rise = body.state.velocity.dot(&vertical);
                body.state.velocity = rotation * Vector3::x() * self.drive.speed + vertical * rise;
                let loads = Loads { force: -vertical * self.drive.load, ..Loads::default() };
                self.integrator.advance(
                    body,
                    placed,
                    &loads,
                    duration,
                    Until::Duration,
                    observer,
                )?
            }
            DriveSolution::QuasiStatic { increment } => {
                self.creep(body, placed, duration, increment, observer)?
            }
        };
        self.travelled =
            if last { self.drive.distance } else { self.travelled + duration * self.drive.speed };
        Ok(advance)
    }

    /// Quasi-static sliding: at every increment the height at which the load is balanced.
    fn creep(
        &mut self,
        body: &mut Body,
        placed: &mut [Placed<'_>; 1],
        duration: f64,
        increment: f64,
        observer: &mut dyn Observer,
    ) -> Result<Advance, PhysicsError> {
        let rotation = placed[0].pose.rotation;
        let (ahead, down) = (rotation * Vector3::x(), -(rotation * Vector3::z()));
        let travel = duration * self.drive.speed;
        let count = (travel / increment).ceil().max(1.0);
        let along = ahead * (travel / count);
        let (turn, load) = (Vector3::zeros(), self.drive.load);
        let tolerance = slide_tolerance(self.integrator.settings.accuracy);
        let press = Press { along, turn, down, load, tolerance, reach: None };
        let creep = Creep { duration, count, scale: increment };
        self.integrator.creep(body, placed, &press, &creep, observer)
    }

    /// The sink [m] between `ends`, with their excesses of the load, at which the load is `target`,
    /// and its trial, with the node evaluations of the search.
    fn find(
        &mut self,
        body: &Body,
        placed: &[Placed<'_>; 1],
        down: Vector3<f64>,
        [low, high]: [[f64; 2]; 2],
        target: f64,
    ) -> (f64, Trial) {
        let mut evaluations = 0;
        let mut asked = None;
        let mut search = Search::new(target, LOAD, |sink| {
            let trial = self.push(body, placed, down * sink);
            evaluations += trial.evaluations;
            let over = -self.integrator.grip(&trial).force.dot(&down) - target;
            asked = Some(trial);
            over
        });
        let found = search.between(low, high);
        let mut trial = asked.expect("a search asks");
        trial.evaluations = evaluations;
        (found.sink, trial)
    }

    /// Makes a push the state, which takes no time.
    fn lead(&mut self, body: &mut Body, placed: &mut [Placed<'_>; 1], trial: &Trial) {
        self.integrator.lead(body, placed, trial, [Vector3::zeros(); 2]);
    }

    /// A trial of a straight push by `shift` [m]; commits nothing.
    fn push(&mut self, body: &Body, placed: &[Placed<'_>; 1], shift: Vector3<f64>) -> Trial {
        let mut state = body.state;
        state.position += shift;
        let course = Course { velocity: shift, spin: Vector3::zeros(), dt: 1.0 };
        self.integrator.ask(body, placed, &state, course)
    }
}

#[cfg(feature = "state")]
impl Driven {
    pub(crate) fn checked(self) -> Result<Self, Fault> {
        let fine =
            self.drive.is_sound() && not_negative(self.travelled) && not_negative(self.pressed_in);
        require(fine && self.integrator.count() == 1, "a drive is out of range")?;
        Ok(self)
    }
}

//! One body's running contact with wear surfaces: the state that outlives a step of the
//! embedder, and the call that carries it through such a step.

use nalgebra::{Isometry3, Point3, Vector3};

use crate::body::{Body, Inertia, State};
use crate::carrier::Carrier;
use crate::error::PhysicsError;
use crate::integrate::Integrator;
use crate::ledger::Ledger;
use crate::surface::Surface;

/// What an encounter is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub struct EncounterSettings {
    /// Target relative time error of the wear volume [-].
    pub accuracy: f64,
    /// Keep the energy ledger.
    pub ledger: bool,
    /// Steps after which a contact is given up, per call of [`Encounter::advance`].
    pub step_limit: u64,
}

impl Default for EncounterSettings {
    fn default() -> Self {
        Self { accuracy: 1e-3, ledger: false, step_limit: 5_000_000 }
    }
}

/// A surface where it lies, in the frame of the integration.
pub struct Placed<'a> {
    /// The surface.
    pub surface: &'a mut Surface,
    /// Its frame at the present instant.
    pub pose: Isometry3<f64>,
    /// The body that it moves with; None for a surface at rest. No two surfaces of a call share
    /// one that is free to move.
    pub carrier: Option<Carrier>,
    /// The surface of the body itself, which this one wears as well; of an encounter made by
    /// [`Encounter::of_two`].
    pub skin: Option<Skin<'a>>,
}

/// The worn surface of a struck body: the nodes of both surfaces meet the facets of the other. The
/// softer flows; of two that are as hard each takes half of every drop. The laws of the surface
/// whose nodes flow hold, of equals those of each by half.
pub struct Skin<'a> {
    /// The surface of a solid within the body's shape.
    pub surface: &'a mut Surface,
    /// Its frame in that of the body, whose origin is the centre of mass.
    pub pose: Isometry3<f64>,
}

/// What acts on the body beside the contact, constant over a call.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Loads {
    /// Acceleration of gravity [m/s2].
    pub gravity: Vector3<f64>,
    /// Force at the centre of mass [N].
    pub force: Vector3<f64>,
    /// Torque [N m].
    pub torque: Vector3<f64>,
    /// Linear damping [1/s], as Rapier defines it.
    pub linear_damping: f64,
    /// Angular damping [1/s].
    pub angular_damping: f64,
}

impl Loads {
    /// Force on a body with its weight [N]; zero for one that nothing moves.
    pub(crate) fn pull(&self, inertia: &Inertia) -> Vector3<f64> {
        match inertia.is_immovable() {
            true => Vector3::zeros(),
            false => self.force + self.gravity * inertia.mass,
        }
    }

    /// Bound of what they accelerate a body by [m/s2].
    pub(crate) fn acceleration(&self, inertia: &Inertia) -> f64 {
        match inertia.is_immovable() {
            true => 0.0,
            false => self.gravity.norm() + self.force.norm() / inertia.mass,
        }
    }
}

/// When [`Encounter::advance`] may return before its duration is over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub enum Until {
    /// Never.
    #[default]
    Duration,
    /// At the first instant after contact at which the whole body is above every undeformed
    /// surface, or its kinetic energy over the surface is below 1e-9 of what it was before the
    /// contact.
    FirstExit,
}

/// What a call of [`Encounter::advance`] did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Advance {
    /// Time gone by [s]; less than asked for after a [`Until::FirstExit`].
    pub time: f64,
    /// True when `Until::FirstExit` ended the call.
    pub exited: bool,
    /// Accepted steps.
    pub steps: u64,
    /// Nodes taken through the law, rejected steps included.
    pub node_evaluations: u64,
    /// Impulse of the surfaces on the body [N s].
    pub impulse: Vector3<f64>,
    /// Angular impulse of the surfaces about the body's centre of mass, wherever that was at the time
    /// [N m s].
    pub twist: Vector3<f64>,
    /// Time in contact [s].
    pub contact_time: f64,
}

/// Sees every accepted step.
pub trait Observer {
    /// Called once per accepted step.
    fn observe(&mut self, instant: &Instant<'_, '_>);
}

/// An instant after an accepted step.
pub struct Instant<'a, 'b> {
    /// Time since the call began [s].
    pub time: f64,
    /// State of the body, in the frame of the integration.
    pub state: &'a State,
    /// Force of the surfaces on the body [N].
    pub force: Vector3<f64>,
    /// The surfaces.
    pub surfaces: &'a [Placed<'b>],
    /// The energies, if kept.
    pub ledger: Option<&'a Ledger>,
}

/// Sees nothing.
impl Observer for () {
    fn observe(&mut self, _: &Instant<'_, '_>) {}
}

/// One body's running contact with wear surfaces.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub struct Encounter {
    integrator: Integrator,
}

impl Encounter {
    /// An encounter of `body` with `surfaces`, not yet in contact.
    ///
    /// # Errors
    /// Settings or an inertia out of range, or a law that does not go with the body's shape.
    pub fn new<'a>(
        body: &Body,
        surfaces: impl IntoIterator<Item = &'a Surface>,
        settings: EncounterSettings,
    ) -> Result<Self, PhysicsError> {
        Integrator::new(body, surfaces, settings).map(|integrator| Self { integrator })
    }

    /// An encounter of `body`, which wears on a surface of its own, with one `surface`. One that goes
    /// on from its bytes lists its nodes and facets anew, and so may differ as that does.
    ///
    /// # Errors
    /// As [`Encounter::new`]; laws other than `Foundation`, `Eq5`, Archard's law, or a restitution below
    /// one; a
    /// skin that is not the surface of a solid within the body's shape.
    pub fn of_two(
        body: &Body,
        skin: &Skin<'_>,
        surface: &Surface,
        settings: EncounterSettings,
    ) -> Result<Self, PhysicsError> {
        let integrator = Integrator::of_two(body, skin, surface, settings)?;
        Ok(Self { integrator })
    }

    /// Carries `body` through `duration` [s], wearing the surfaces it touches: those that the
    /// encounter was made with, in their order. Surfaces with a carrier move with it: pose and
    /// state of it end where the call ends. A surface that was renewed since the last call begins
    /// anew, which takes that the contact was over.
    ///
    /// # Errors
    /// A physical state outside the model's reach; the body and the surfaces are left as they
    /// were after the last accepted step.
    pub fn advance(
        &mut self,
        body: &mut Body,
        surfaces: &mut [Placed<'_>],
        loads: &Loads,
        duration: f64,
        until: Until,
        observer: &mut dyn Observer,
    ) -> Result<Advance, PhysicsError> {
        self.integrator.advance(body, surfaces, loads, duration, until, observer)
    }

    /// Ends the contact where it is: what its springs hold is lost, and overhangs break off.
    pub fn end(&mut self, surfaces: &mut [Placed<'_>]) {
        if self.integrator.fits(surfaces).is_ok() {
            self.integrator.let_go(surfaces);
        }
    }

    /// True while a node carries force.
    pub fn in_contact(&self) -> bool {
        self.integrator.in_contact()
    }

    /// True from the first touch until the contact is over: so long its surfaces cannot be renewed.
    pub fn is_open(&self) -> bool {
        self.integrator.touched
    }

    /// Moves `body` back, against the unit vector `down`, until it is clear of the surfaces that an
    /// engine has left it in; stays where it is on surfaces that it was not made with.
    pub fn lift(&mut self, body: &mut Body, surfaces: &[Placed<'_>], down: &Vector3<f64>) {
        if self.integrator.fits(surfaces).is_ok() {
            self.integrator.lift(body, surfaces, down);
        }
    }

    /// Period of the body on the springs that it touched last [s]; zero before any contact, and on
    /// surfaces without springs.
    pub fn period(&self) -> f64 {
        self.integrator.period()
    }

    /// Per surface, the box around the undeformed nodes whose depths were read since the last
    /// call, in the surface's frame [m]. What happens to other nodes cannot have changed a bit of
    /// what the encounter did.
    pub fn take_reads(&mut self) -> impl Iterator<Item = Option<[Point3<f64>; 2]>> + '_ {
        self.integrator.take_reads()
    }

    /// The energies since the encounter began; zeros unless asked for.
    pub fn ledger(&self) -> &Ledger {
        self.integrator.ledger()
    }
}

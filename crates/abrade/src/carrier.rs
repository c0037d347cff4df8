//! What a moving surface is fixed to: a body that answers to the contact, or one that something
//! else leads.

use nalgebra::{Isometry3, Vector3};

use crate::body::{Inertia, State};
use crate::encounter::{Loads, Placed};
use crate::error::PhysicsError;
use crate::rotation::Dynamics;
use crate::surface::Surface;

/// A body that carries a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Carrier {
    /// Where it is and how it moves.
    pub state: State,
    /// Mass and inertia of a body that the contact moves; None for one that keeps its velocity and
    /// its spin whatever acts on it.
    pub inertia: Option<Inertia>,
    /// What acts on it beside the contact.
    pub loads: Loads,
}

impl<'a> Placed<'a> {
    /// A surface at rest.
    pub fn at_rest(surface: &'a mut Surface, pose: Isometry3<f64>) -> Self {
        Self { surface, pose, carrier: None, skin: None }
    }

    /// True for a surface that no contact moves: at rest, or led.
    pub(crate) fn keeps_its_motion(&self) -> bool {
        let inertia = self.carrier.as_ref().and_then(|carrier| carrier.inertia);
        inertia.is_none_or(|inertia| inertia.is_immovable())
    }

    /// Velocity and spin of a body in `state` over the surface's material below it.
    pub(crate) fn relative(&self, state: &State) -> [Vector3<f64>; 2] {
        match &self.carrier {
            None => [state.velocity, state.spin],
            Some(Carrier { state: carrier, .. }) => {
                [state.velocity - velocity_at(carrier, state), state.spin - carrier.spin]
            }
        }
    }

    /// A body in `state` as seen from the surface, which moves and turns with its carrier.
    pub(crate) fn sees(&self, state: &State) -> State {
        if self.carrier.is_none() {
            return state.seen_from(&self.pose);
        }
        let [velocity, spin] = self.relative(state);
        State { velocity, spin, ..*state }.seen_from(&self.pose)
    }
}

/// Velocity of the material of `carrier` where `state` is [m/s].
pub(crate) fn velocity_at(carrier: &State, state: &State) -> Vector3<f64> {
    carrier.velocity + carrier.spin.cross(&(state.position - carrier.position))
}

impl Carrier {
    pub(crate) fn dynamics(&self) -> Result<Dynamics, PhysicsError> {
        let Some(inertia) = &self.inertia else { return Ok(Dynamics::immovable()) };
        Dynamics::new(inertia, false).ok_or(PhysicsError::Unsupported {
            what: "the mass or inertia of a surface's carrier is not positive",
        })
    }

    /// Angular acceleration by its torque [1/s2]; zero for a led one.
    fn twisting(&self) -> f64 {
        if self.loads.torque == Vector3::zeros() {
            return 0.0;
        }
        let dynamics = self.inertia.as_ref().and_then(|inertia| Dynamics::new(inertia, false));
        dynamics.map_or(0.0, |dynamics| dynamics.agility() * self.loads.torque.norm())
    }

    /// Kinetic energy [J]; zero for a led one.
    pub(crate) fn kinetic_energy(&self) -> f64 {
        self.inertia.as_ref().map_or(0.0, |inertia| inertia.kinetic_energy(&self.state))
    }

    /// Bound of what its loads and its turning accelerate points near `state` by, as seen from it
    /// [m/s2]: inertial forces in a turning frame.
    pub(crate) fn acceleration(&self, state: &State) -> f64 {
        let loads = match &self.inertia {
            Some(inertia) => self.loads.acceleration(inertia),
            None => 0.0,
        };
        let turn = self.state.spin.norm();
        let arm = (state.position - self.state.position).norm();
        let relative = (state.velocity - velocity_at(&self.state, state)).norm();
        loads + self.twisting() * arm + TURNING * turn * (turn * arm + 2.0 * relative)
    }
}

/// Growth of the inertial forces over a flight step, and the angle [rad] that bounds it.
const TURNING: f64 = 2.0;
const FLIGHT_TURN: f64 = 0.1;

/// Kinetic energy of the carriers that the contact moves [J].
pub(crate) fn carriers_energy(surfaces: &[Placed<'_>]) -> f64 {
    let carriers = surfaces.iter().filter_map(|placed| placed.carrier.as_ref());
    carriers.map(Carrier::kinetic_energy).sum()
}

/// Length of a flight step in which no carrier turns far [s].
pub(crate) fn flight_limit(surfaces: &[Placed<'_>]) -> f64 {
    let carriers = surfaces.iter().filter_map(|placed| placed.carrier.as_ref());
    carriers.map(|c| FLIGHT_TURN / c.state.spin.norm()).fold(f64::INFINITY, f64::min)
}

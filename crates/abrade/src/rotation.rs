//! Free motion of a rigid body over a step: straight for the centre of mass, Euler's equations
//! for the spin. The implicit midpoint rule with a Cayley rotation (Simo & Wong 1991) keeps the
//! rotational energy and the angular momentum to round-off.

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

use crate::body::{Inertia, State};
#[cfg(feature = "state")]
use crate::state::{Fault, finite, not_negative, require};

/// Relative spread of the principal moments below which a body turns like a ball.
const ISOTROPIC: f64 = 1e-12;
const MIDPOINT_STEPS: usize = 50;
/// Angle [rad] that the midpoint rule turns at a time, and the most pieces of a step: long flights
/// turn a body many times over. Beyond that the rule has long lost count of the turns, and the rest of
/// them is left out: the body keeps its energy and its angular momentum.
const TURN_STEP: f64 = 0.1;
const TURN_STEPS: f64 = 1e5;

/// Mass and inertia prepared for stepping.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Dynamics {
    pub inverse_mass: f64,
    tensor: Matrix3<f64>,
    inverse: Matrix3<f64>,
    /// Largest angular answer to a torque [1/(kg m2)].
    agility: f64,
    isotropic: bool,
    locked: bool,
    /// The only direction in which forces move a guided body.
    guide: Option<Vector3<f64>>,
}

impl Dynamics {
    /// None when mass or inertia cannot move a body.
    pub(crate) fn new(inertia: &Inertia, locked: bool) -> Option<Self> {
        if inertia.is_immovable() {
            return Some(Self::immovable());
        }
        let tensor = inertia.tensor;
        let mean = tensor.trace() / 3.0;
        let isotropic = (tensor - Matrix3::from_diagonal_element(mean)).amax() < ISOTROPIC * mean;
        let inverse = match (locked, isotropic) {
            (true, _) => Matrix3::zeros(),
            (_, true) => Matrix3::from_diagonal_element(1.0 / mean),
            // Scaled first: moments of small bodies underflow a determinant.
            _ => (tensor / mean).try_inverse()? / mean,
        };
        // A mean below zero would turn the sign of the others.
        let is_positive =
            locked || mean > 0.0 && (isotropic || (tensor / mean).cholesky().is_some());
        let usable = inertia.mass > 0.0
            && inertia.mass.is_finite()
            && is_positive
            && inverse.iter().all(|x| x.is_finite());
        usable.then_some(Self {
            inverse_mass: 1.0 / inertia.mass,
            tensor,
            inverse,
            agility: match isotropic {
                true => inverse.m11,
                false => inverse.symmetric_eigenvalues().max(),
            },
            isotropic,
            locked,
            guide: None,
        })
    }

    /// A body that nothing moves: its velocity and spin stay what they are.
    pub(crate) fn immovable() -> Self {
        Self {
            inverse_mass: 0.0,
            tensor: Matrix3::identity(),
            inverse: Matrix3::zeros(),
            agility: 0.0,
            isotropic: true,
            locked: false,
            guide: None,
        }
    }

    /// True for a body that nothing moves.
    pub(crate) fn is_immovable(&self) -> bool {
        self.inverse_mass == 0.0
    }

    /// A body that is led along everything but the unit vector `free`.
    pub(crate) fn guided(self, free: Vector3<f64>) -> Self {
        Self { guide: Some(free), ..self }
    }

    /// True for a body that turns like a ball.
    pub(crate) fn is_isotropic(&self) -> bool {
        self.isotropic
    }

    /// True for a body that something else leads.
    pub(crate) fn is_guided(&self) -> bool {
        self.guide.is_some()
    }

    /// Change of the velocity by an impulse [N s].
    pub(crate) fn accelerate(&self, impulse: &Vector3<f64>) -> Vector3<f64> {
        let free = self.guide.map_or(*impulse, |axis| axis * axis.dot(impulse));
        free * self.inverse_mass
    }

    /// Change of the spin by an impulsive torque [N m s] at `rotation`.
    pub(crate) fn turn(
        &self,
        rotation: &UnitQuaternion<f64>,
        torque: &Vector3<f64>,
    ) -> Vector3<f64> {
        if self.locked {
            return Vector3::zeros();
        }
        if self.isotropic {
            return torque * self.inverse.m11;
        }
        rotation * (self.inverse * rotation.inverse_transform_vector(torque))
    }

    /// Angular momentum about the centre of mass [N m s].
    pub(crate) fn angular_momentum(
        &self,
        rotation: &UnitQuaternion<f64>,
        spin: &Vector3<f64>,
    ) -> Vector3<f64> {
        rotation * (self.tensor * rotation.inverse_transform_vector(spin))
    }

    /// Work per unit time of `torque` [W]: none on a locked body.
    pub(crate) fn work(&self, torque: &Vector3<f64>, spin: &Vector3<f64>) -> f64 {
        if self.locked { 0.0 } else { torque.dot(spin) }
    }

    /// Largest angular answer to a torque [1/(kg m2)].
    pub(crate) fn agility(&self) -> f64 {
        self.agility
    }

    /// Moves `state` freely through `dt`; returns the mid-step spin.
    pub(crate) fn drift(&self, state: &mut State, dt: f64) -> Vector3<f64> {
        state.position += state.velocity * dt;
        if state.spin == Vector3::zeros() {
            return state.spin;
        }
        if self.locked || self.isotropic {
            let spin = state.spin;
            state.rotation = UnitQuaternion::from_scaled_axis(spin * dt) * state.rotation;
            return spin;
        }
        let start = state.rotation;
        let pieces = (state.spin.norm() * dt / TURN_STEP).ceil().max(1.0);
        for _ in 0..pieces.min(TURN_STEPS) as u32 {
            self.tumble(state, dt / pieces);
        }
        (state.rotation * start.inverse()).scaled_axis() / dt
    }

    /// Turns a body whose principal moments differ through a small angle.
    fn tumble(&self, state: &mut State, dt: f64) {
        let before = state.rotation.inverse_transform_vector(&state.spin);
        let mut middle = before;
        for _ in 0..MIDPOINT_STEPS {
            let turning = (self.tensor * middle).cross(&middle);
            let next = before + self.inverse * turning * (0.5 * dt);
            let change = (next - middle).norm();
            middle = next;
            if change <= f64::EPSILON * middle.norm() {
                break;
            }
        }
        let half = state.rotation * middle * (0.5 * dt);
        let turn = UnitQuaternion::new_normalize(Quaternion::from_parts(1.0, half));
        state.rotation = turn * state.rotation;
        state.rotation.renormalize();
        state.spin = state.rotation * (middle * 2.0 - before);
    }
}

#[cfg(feature = "state")]
impl Dynamics {
    pub(crate) fn check(&self) -> Result<(), Fault> {
        let guide = self.guide.unwrap_or_default();
        let numbers = self.tensor.iter().chain(self.inverse.iter()).chain(guide.iter());
        let answers = [self.inverse_mass, self.agility].into_iter().all(not_negative);
        let fine = answers && finite(numbers);
        require(fine, "a mass or inertia in contact is out of range")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;

    /// Fails for pieces of a turn that get longer with the flight until the rule does not converge.
    #[test]
    fn flights_of_a_million_radians_keep_energy_and_angular_momentum() {
        let tensor = Matrix3::from_diagonal(&[1.0, 2.0, 2.5].into());
        let inertia = Inertia { mass: 1.0, tensor };
        let dynamics = Dynamics::new(&inertia, false).expect("a body");
        let mut state = State::at(Point3::origin());
        state.spin = Vector3::new(3e6, -2e6, 1e6);
        let of = |state: &State| dynamics.angular_momentum(&state.rotation, &state.spin);
        let (energy, before) = (inertia.kinetic_energy(&state), of(&state));
        dynamics.drift(&mut state, 1.0);
        let gained = inertia.kinetic_energy(&state) / energy - 1.0;
        let lost = (of(&state) - before).norm() / before.norm();
        assert!(gained.abs() < 1e-10 && lost < 1e-10, "{gained:e} {lost:e}");
    }

    /// Fails for an explicit step, which gains energy, for a wrong sign of the gyroscopic term, and
    /// for a rotation that is not the midpoint rule's own.
    #[test]
    fn free_tumbling_keeps_energy_and_angular_momentum_and_turns_to_second_order() {
        let tensor = Matrix3::from_diagonal(&[1.0, 2.0, 3.0].into());
        let inertia = Inertia { mass: 1.0, tensor };
        let dynamics = Dynamics::new(&inertia, false).expect("a body");
        let momentum =
            |s: &State| s.rotation * (tensor * s.rotation.inverse_transform_vector(&s.spin));
        let drift = |steps: u32| {
            let mut state = State::at(Point3::origin());
            state.spin = Vector3::new(0.3, 2.0, 0.1);
            let (energy, before) = (inertia.kinetic_energy(&state), momentum(&state));
            for _ in 0..steps {
                dynamics.drift(&mut state, 10.0 / f64::from(steps));
            }
            let gained = inertia.kinetic_energy(&state) / energy - 1.0;
            let round_off = 1e-15 * f64::from(steps.max(1000));
            assert!(gained.abs() < round_off, "{steps}: {gained:e}");
            let lost = (momentum(&state) - before).norm() / before.norm();
            assert!(lost < round_off, "{steps}: {lost:e}");
            state.rotation
        };
        let miss = |steps: u32| drift(steps).angle_to(&drift(10_000));
        // A step longer than a turn is taken in pieces.
        assert!(miss(1) < 3e-2, "{}", miss(1));
        let order = (miss(1000) / miss(2000)).log2();
        assert!((1.9..2.1).contains(&order), "order {order}");
    }
}

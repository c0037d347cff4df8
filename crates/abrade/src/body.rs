//! A rigid body: shape, inertia, state. Its frame has its origin at the centre of mass.

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

use crate::shape::Shape;
#[cfg(feature = "state")]
use crate::state::{Fault, finite, positive, require};

/// Mass and inertia about the centre of mass.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "state", serde(remote = "Self"))]
pub struct Inertia {
    /// Mass [kg]; infinite for a body that nothing moves.
    pub mass: f64,
    /// Inertia tensor in the body's frame [kg m2].
    pub tensor: Matrix3<f64>,
}

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "state", serde(remote = "Self"))]
pub struct State {
    /// Centre of mass [m].
    pub position: Point3<f64>,
    /// Orientation of the body's frame.
    pub rotation: UnitQuaternion<f64>,
    /// Velocity of the centre of mass [m/s].
    pub velocity: Vector3<f64>,
    /// Angular velocity [rad/s].
    pub spin: Vector3<f64>,
}

/// A rigid body that can wear a surface.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub struct Body {
    /// Geometry about the centre of mass.
    pub shape: Shape,
    /// Mass and inertia.
    pub inertia: Inertia,
    /// Present state.
    pub state: State,
    /// Held upright: contacts exert no torque and the spin stays as it is.
    pub rotation_locked: bool,
}

impl State {
    /// At rest, unrotated, at `position` [m].
    pub fn at(position: Point3<f64>) -> Self {
        Self {
            position,
            rotation: UnitQuaternion::identity(),
            velocity: Vector3::zeros(),
            spin: Vector3::zeros(),
        }
    }

    /// Pose of the body's frame.
    pub fn pose(&self) -> Isometry3<f64> {
        Isometry3::from_parts(Translation3::from(self.position.coords), self.rotation)
    }

    /// This state seen from the frame that `frame` places (a frame at rest).
    pub fn seen_from(&self, frame: &Isometry3<f64>) -> Self {
        Self {
            position: frame.inverse_transform_point(&self.position),
            rotation: frame.rotation.inverse() * self.rotation,
            velocity: frame.inverse_transform_vector(&self.velocity),
            spin: frame.inverse_transform_vector(&self.spin),
        }
    }

    /// The inverse of [`State::seen_from`].
    pub fn placed_by(&self, frame: &Isometry3<f64>) -> Self {
        Self {
            position: frame * self.position,
            rotation: frame.rotation * self.rotation,
            velocity: frame * self.velocity,
            spin: frame * self.spin,
        }
    }

    /// True when every number is finite.
    pub fn is_finite(&self) -> bool {
        let parts = [self.position.coords, self.velocity, self.spin];
        parts.iter().all(|v| v.iter().all(|x| x.is_finite()))
            && self.rotation.coords.iter().all(|x| x.is_finite())
    }
}

impl Inertia {
    /// A solid ball of `radius` [m] and `density` [kg/m3].
    pub fn of_ball(radius: f64, density: f64) -> Self {
        let mass = 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3) * density;
        Self { mass, tensor: Matrix3::from_diagonal_element(0.4 * mass * radius * radius) }
    }

    /// That of a body that keeps its velocity and its spin whatever acts on it: a floor, or a tool
    /// that something else leads in a straight line.
    pub fn immovable() -> Self {
        Self { mass: f64::INFINITY, tensor: Matrix3::identity() }
    }

    /// Principal moments of inertia [kg m2], and the turn from their axes to those of the tensor.
    pub fn principal(&self) -> (Vector3<f64>, UnitQuaternion<f64>) {
        let eigen = self.tensor.symmetric_eigen();
        let mut axes = eigen.eigenvectors;
        if axes.determinant() < 0.0 {
            axes.column_mut(0).neg_mut();
        }
        // Directly: nalgebra's search for the nearest rotation does not end for some half turns.
        let turn = Rotation3::from_matrix_unchecked(axes);
        (eigen.eigenvalues, UnitQuaternion::from_rotation_matrix(&turn))
    }

    /// True for a body that nothing moves.
    pub fn is_immovable(&self) -> bool {
        self.mass == f64::INFINITY
    }

    /// Kinetic energy [J] of a body in `state`; zero for one that nothing moves.
    pub fn kinetic_energy(&self, state: &State) -> f64 {
        if self.is_immovable() {
            return 0.0;
        }
        let spin = state.rotation.inverse_transform_vector(&state.spin);
        0.5 * self.mass * state.velocity.norm_squared() + 0.5 * spin.dot(&(self.tensor * spin))
    }
}

#[cfg(feature = "state")]
impl State {
    pub(crate) fn checked(self) -> Result<Self, Fault> {
        let unit = (self.rotation.norm() - 1.0).abs() < UNIT;
        require(self.is_finite() && unit, "a state is not finite, or its rotation none")?;
        Ok(self)
    }
}

#[cfg(feature = "state")]
impl Inertia {
    pub(crate) fn checked(self) -> Result<Self, Fault> {
        let fine = (positive(self.mass) || self.is_immovable()) && finite(self.tensor.iter());
        require(fine, "an inertia is not finite, or its mass not above zero")?;
        Ok(self)
    }
}

/// Round-off of unit vectors that have turned for long.
#[cfg(feature = "state")]
const UNIT: f64 = 1e-6;

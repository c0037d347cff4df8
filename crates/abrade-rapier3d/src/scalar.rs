//! Between Rapier's numbers and vectors (glam, `f32` or `f64`) and the core's (nalgebra, `f64`).
//! The only file that depends on Rapier's scalar type.
#![allow(clippy::unnecessary_cast, reason = "the casts change nothing in the f64 package")]

use nalgebra::{Isometry3, Matrix3, Quaternion, Translation3, UnitQuaternion, Vector3};
use rapier::math::{Matrix, Pose, Real, Rotation, Vector};

/// Relative rounding of Rapier's numbers [-].
pub const ROUNDING: f64 = Real::EPSILON as f64;

/// A number of Rapier's.
pub fn wide(x: Real) -> f64 {
    x as f64
}

/// A number for Rapier, rounded.
pub fn narrow(x: f64) -> Real {
    x as Real
}

/// True for a number that Rapier can hold with its square.
pub fn holds(x: f64) -> bool {
    x.abs() < wide(Real::MAX).sqrt()
}

/// A vector of Rapier's.
pub fn vector(v: Vector) -> Vector3<f64> {
    Vector3::new(wide(v.x), wide(v.y), wide(v.z))
}

/// A vector for Rapier, rounded.
pub fn to_vector(v: &Vector3<f64>) -> Vector {
    Vector::new(narrow(v.x), narrow(v.y), narrow(v.z))
}

/// A rotation of Rapier's, normalised anew.
pub fn rotation(q: &Rotation) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::new(wide(q.w), wide(q.x), wide(q.y), wide(q.z)))
}

/// A rotation for Rapier, rounded.
pub fn to_rotation(q: &UnitQuaternion<f64>) -> Rotation {
    Rotation::from_xyzw(narrow(q.i), narrow(q.j), narrow(q.k), narrow(q.w))
}

/// A pose of Rapier's.
pub fn pose(p: &Pose) -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::from(vector(p.translation)), rotation(&p.rotation))
}

/// A pose for Rapier, rounded.
pub fn to_pose(p: &Isometry3<f64>) -> Pose {
    Pose::from_parts(to_vector(&p.translation.vector), to_rotation(&p.rotation))
}

/// A matrix of Rapier's.
pub fn matrix(m: &Matrix) -> Matrix3<f64> {
    Matrix3::from_columns(&[vector(m.x_axis), vector(m.y_axis), vector(m.z_axis)])
}

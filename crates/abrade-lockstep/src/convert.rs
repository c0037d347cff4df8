//! Between Rapier's `f64` vectors (glam) and the core's (nalgebra).

use abrade::State;
use nalgebra::{Isometry3, Point3, Quaternion, UnitQuaternion, Vector3};
use rapier::dynamics::RigidBody;
use rapier::math::{Pose, Rotation, Vector};

/// A vector of Rapier's.
pub fn from_vector(v: Vector) -> Vector3<f64> {
    Vector3::new(v.x, v.y, v.z)
}

/// A vector for Rapier.
pub fn to_vector(v: &Vector3<f64>) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

/// A pose for Rapier.
pub fn to_pose(p: &Isometry3<f64>) -> Pose {
    let q = p.rotation;
    Pose::from_parts(to_vector(&p.translation.vector), Rotation::from_xyzw(q.i, q.j, q.k, q.w))
}

/// A pose of Rapier's.
#[cfg(test)]
pub(crate) fn from_pose(p: &Pose) -> Isometry3<f64> {
    let q = p.rotation;
    let rotation = UnitQuaternion::new_normalize(Quaternion::new(q.w, q.x, q.y, q.z));
    Isometry3::from_parts(from_vector(p.translation).into(), rotation)
}

/// State of a body about its centre of mass, in the world.
pub(crate) fn state(body: &RigidBody) -> State {
    let q = body.rotation();
    State {
        position: Point3::from(from_vector(body.center_of_mass())),
        rotation: UnitQuaternion::new_normalize(Quaternion::new(q.w, q.x, q.y, q.z)),
        velocity: from_vector(body.linvel()),
        spin: from_vector(body.angvel()),
    }
}

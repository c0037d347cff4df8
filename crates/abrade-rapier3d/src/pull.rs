//! What accelerates a body beside its contacts and joints.

use nalgebra::Vector3;
use rapier::dynamics::RigidBody;

use crate::scalar;
use crate::tracked::Tracked;

/// Acceleration of a body by `gravity` [m/s2] and by the embedder's force, of the mass that it was
/// registered with, else of Rapier's; of Rapier's alone where nothing `tracked` is given. Nothing
/// pulls a body without a mass [m/s2].
pub(crate) fn pull(
    rb: &RigidBody,
    tracked: Option<&Tracked>,
    gravity: &Vector3<f64>,
) -> Vector3<f64> {
    let registered = tracked.and_then(Tracked::registered).map(|body| body.inertia.mass);
    let mass = registered.unwrap_or_else(|| scalar::wide(rb.mass()));
    match mass > 0.0 {
        true => gravity * scalar::wide(rb.gravity_scale()) + scalar::vector(rb.user_force()) / mass,
        false => Vector3::zeros(),
    }
}

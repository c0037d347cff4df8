//! What accelerates a body beside its contacts and joints.

use nalgebra::Vector3;
use rapier::dynamics::RigidBody;

use crate::scalar;
use crate::tracked::Tracked;

/// Mass of a body: that which it was registered with, else Rapier's [kg].
pub(crate) fn mass(rb: &RigidBody, tracked: Option<&Tracked>) -> f64 {
    let registered = tracked.and_then(Tracked::registered).map(|body| body.inertia.mass);
    registered.unwrap_or_else(|| scalar::wide(rb.mass()))
}

/// Acceleration of a body by `gravity` [m/s2] and by the embedder's force, of the mass that it was
/// registered with, else of Rapier's; of Rapier's alone where nothing `tracked` is given. Nothing
/// pulls a body without a mass [m/s2].
pub(crate) fn pull(
    rb: &RigidBody,
    tracked: Option<&Tracked>,
    gravity: &Vector3<f64>,
) -> Vector3<f64> {
    let mass = mass(rb, tracked);
    match mass > 0.0 {
        true => gravity * scalar::wide(rb.gravity_scale()) + scalar::vector(rb.user_force()) / mass,
        false => Vector3::zeros(),
    }
}

//! Rapier's parameters for tiny steps.
//!
//! Errors of position, such as the sinking of resting bodies at an embedder's step, must not be
//! corrected at a rate that follows the step: at 1e-7 s a tenth of a micrometre would become a
//! metre a second. The constraints are overdamped: hard in velocity, and an error decays at a
//! fixed rate.

use rapier::dynamics::{GenericJoint, IntegrationParameters, SpringCoefficients};
use rapier::math::Real;

/// Rate at which errors of position decay [1/s].
const DECAY: f64 = 1.0;
/// Damping ratio of the constraints: cfm ~ 1 / (4 ratio^2 rate h), nothing at any step.
const DAMPING_RATIO: f64 = 1e9;

/// Softness under which an error decays at [`DECAY`].
fn overdamped() -> SpringCoefficients<f64> {
    // erp / h = omega / (h omega + 2 ratio), and omega = 2 pi f.
    let frequency = 2.0 * DAMPING_RATIO * DECAY / std::f64::consts::TAU;
    SpringCoefficients::new(frequency, DAMPING_RATIO)
}

/// Makes `parameters` fit for tiny steps.
pub(crate) fn refine(parameters: &mut IntegrationParameters) {
    parameters.contact_softness = overdamped();
    parameters.static_contact_softness = overdamped();
    parameters.num_solver_iterations = 1;
    parameters.normalized_max_linear_velocity = Real::MAX;
    parameters.max_ccd_substeps = 0;
    parameters.contact_recycling = false;
    parameters.warmstart_joints = true;
}

/// Makes a joint fit for tiny steps.
pub(crate) fn refine_joint(joint: &mut GenericJoint) {
    joint.softness = overdamped();
}

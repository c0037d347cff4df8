//! Steering Rapier to an integrated state and back to it afterwards.
//!
//! Rapier takes n substeps of h = dt / n: v += a h, then x += v h, so that
//! x_end = x + v dt + a dt^2 (n + 1) / (2 n), and after them v /= 1 + dt damping. The velocity
//! that lands on x_end follows. What the velocity is off by after the step was done by others.

use nalgebra::Vector3;
use rapier::dynamics::{IntegrationParameters, RigidBody};
use rapier::geometry::ColliderSet;
use rapier::math::Vector;

use crate::pull::pull;
use crate::scalar;
use crate::shadow::{self, Shadow};
use crate::world::Integrated;

/// Roundings by which Rapier's integrator may miss a velocity before others are held responsible.
const ROUNDINGS: f64 = 64.0;
/// Share of Rapier's speed limit that steering stays below.
const BELOW_LIMIT: f64 = 0.99;

/// A body on its way through Rapier's step.
pub(crate) struct Steered {
    pub integrated: Integrated,
    linear: Leg,
    angular: Leg,
    gyroscopic: bool,
}

/// One velocity of a steered body.
struct Leg {
    /// Velocity that undisturbed integration ends with.
    expected: Vector3<f64>,
    /// 1 + dt damping.
    damping: f64,
    /// Rounding scale of the velocity.
    scale: f64,
}

impl Leg {
    /// Displacement over `dt` under constant acceleration in `substeps`; returns the velocity to
    /// set with the leg.
    fn new(
        displacement: &Vector3<f64>,
        acceleration: &Vector3<f64>,
        dt: f64,
        substeps: f64,
        damping: f64,
        limit: f64,
    ) -> (Vector, Self) {
        let mean = if dt > 0.0 { displacement / dt } else { Vector3::zeros() };
        let mut start = mean - acceleration * (dt * (substeps + 1.0) / (2.0 * substeps));
        let speed = start.norm();
        if speed > limit {
            start *= limit / speed;
        }
        let set = scalar::to_vector(&start);
        let damping = 1.0 + dt * damping;
        let gain = acceleration * dt;
        let expected = (scalar::vector(set) + gain) / damping;
        (set, Self { expected, damping, scale: start.norm() + gain.norm() })
    }

    /// Change of velocity that others made, seen from the velocity after the step.
    fn change_by_others(&self, after: Vector) -> Option<Vector3<f64>> {
        let change = (scalar::vector(after) - self.expected) * self.damping;
        let rounding = ROUNDINGS * scalar::ROUNDING * self.scale;
        (change.norm() > rounding).then_some(change)
    }
}

/// Sets the velocities that take `rb` to where its integration ended in `dt` [s].
pub(crate) fn steer(
    integrated: Integrated,
    rb: &mut RigidBody,
    gravity: &Vector3<f64>,
    parameters: &IntegrationParameters,
    dt: f64,
) -> Steered {
    let substeps = (parameters.num_solver_iterations + rb.additional_solver_iterations()) as f64;
    let world = integrated.end.placed_by(&integrated.frame);
    let gyroscopic = rb.gyroscopic_forces_enabled();
    let limit = BELOW_LIMIT * scalar::wide(parameters.max_linear_velocity());
    // A body that is registered with a mass may have none of Rapier's.
    let pull = pull(rb, None, gravity);
    let way = world.position.coords - scalar::vector(rb.center_of_mass());
    let (linvel, linear) =
        Leg::new(&way, &pull, dt, substeps, scalar::wide(rb.linear_damping()), limit);
    let turn = (world.rotation * scalar::rotation(rb.rotation()).inverse()).scaled_axis();
    let inverse = rb.mass_properties().effective_world_inv_inertia;
    let twist = scalar::vector(inverse * rb.user_torque());
    let damping = scalar::wide(rb.angular_damping());
    let (angvel, angular) = Leg::new(&turn, &twist, dt, substeps, damping, f64::INFINITY);
    // Spins after oblique impacts are beyond Rapier's cap: it is off from here on, or the flight after the
    // contact would lose them. Its gyroscopic term, which the integration has dealt with, would blur what others
    // did in this step.
    rb.set_allow_fast_rotation(true);
    rb.enable_gyroscopic_forces(false);
    rb.set_linvel(linvel, false);
    rb.set_angvel(angvel, false);
    Steered { integrated, linear, angular, gyroscopic }
}

impl Steered {
    /// Writes the end of the integration over what Rapier's step left, with whatever others did
    /// added. The shadow is lost to bodies that others pushed or that fell asleep.
    pub fn settle(&self, rb: &mut RigidBody) -> Option<Shadow> {
        rb.enable_gyroscopic_forces(self.gyroscopic);
        let Integrated { end, frame, .. } = &self.integrated;
        if rb.is_sleeping() {
            return None;
        }
        let pushed = self.linear.change_by_others(rb.linvel());
        let turned = self.angular.change_by_others(rb.angvel());
        if pushed.is_none() && turned.is_none() {
            return Some(shadow::write(rb, *frame, *end));
        }
        let world = end.placed_by(frame);
        let linvel = world.velocity + pushed.unwrap_or_default();
        let angvel = world.spin + turned.unwrap_or_default();
        rb.set_linvel(scalar::to_vector(&linvel), false);
        rb.set_angvel(scalar::to_vector(&angvel), false);
        None
    }
}

/// Brings the colliders of `rb` to where it was written.
pub(crate) fn carry_colliders(rb: &RigidBody, colliders: &mut ColliderSet) {
    for &handle in rb.colliders() {
        let Some(collider) = colliders.get(handle) else { continue };
        let Some(local) = collider.position_wrt_parent().copied() else { continue };
        let pose = rb.position() * local;
        if *collider.position() != pose
            && let Some(collider) = colliders.get_mut(handle)
        {
            collider.set_position(pose);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a velocity that does not land, and for one whose end is taken for a push. The
    /// integrator is Rapier's scheme, written out.
    #[test]
    fn a_steered_body_lands_and_owes_nothing_to_others() {
        let (dt, substeps, damping) = (1.0 / 60.0, 4, 0.7);
        let displacement = Vector3::new(0.1, -0.02, 0.3);
        let pull = Vector3::new(0.0, 2.0, -9.81);
        let limit = f64::INFINITY;
        let (set, leg) = Leg::new(&displacement, &pull, dt, f64::from(substeps), damping, limit);
        let (mut v, mut x) = (scalar::vector(set), Vector3::zeros());
        for _ in 0..substeps {
            v += pull * (dt / f64::from(substeps));
            x += v * (dt / f64::from(substeps));
        }
        v /= 1.0 + dt * damping;
        assert!((x - displacement).norm() < 4.0 * scalar::ROUNDING * displacement.norm());
        assert_eq!(leg.change_by_others(scalar::to_vector(&v)), None);
        let push = Vector3::new(0.0, 0.0, 0.01);
        let pushed = scalar::to_vector(&(v + push / (1.0 + dt * damping)));
        let seen = leg.change_by_others(pushed).unwrap_or_default();
        assert!((seen - push).norm() < 100.0 * scalar::ROUNDING * v.norm(), "{seen}");
    }
}

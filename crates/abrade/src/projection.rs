//! The exact energy balance of a swept step: impulses along the faces are scaled by one scalar so
//! that the body loses what the removed volume costs, to round-off.

use crate::body::State;
use crate::columns::Toll;
use crate::rotation::Dynamics;

/// Largest deviation of the scalar from 1 that springs allow: near a turning point the impulse
/// does no work, and no scalar could balance it.
const NEAR_ONE: f64 = 0.2;

/// The scalar and what follows from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Projection {
    /// Scale of the impulse.
    pub scale: f64,
    /// Share of the removal that the body can pay; below 1 when it is blocked.
    pub share: f64,
    /// Kinetic energy that the body loses less than the step costs [J]; carried to the next step.
    pub short: f64,
}

/// Scales `toll` for a body in `state`. `carried` [J] is what earlier steps were short of.
///
/// With impulse J and torque T: the kinetic energy changes by b l + a l^2 for the scale l, where
/// a = (J.M^-1 J + T.I^-1 T)/2 and b = J.v + T.w. Rigid: b l + a l^2 = -Q is solved exactly; where
/// it has no solution the body gives all that the direction has, and takes that share.
pub(crate) fn project(
    toll: &Toll,
    state: &State,
    dynamics: &Dynamics,
    springs: bool,
    carried: f64,
) -> Projection {
    let turn = dynamics.turn(&state.rotation, &toll.torque);
    let a = 0.5 * (toll.impulse.norm_squared() * dynamics.inverse_mass + toll.torque.dot(&turn));
    let b = toll.impulse.dot(&state.velocity) + dynamics.work(&toll.torque, &state.spin);
    let cost = toll.wear + toll.friction + toll.elastic + toll.lost;
    if springs {
        return near_one(a, b, cost, carried);
    }
    if cost <= 0.0 || a <= 0.0 {
        return Projection { scale: 0.0, share: 1.0, short: 0.0 };
    }
    let discriminant = b * b - 4.0 * a * cost;
    if b < 0.0 && discriminant >= 0.0 {
        return Projection {
            scale: 2.0 * cost / (discriminant.sqrt() - b),
            share: 1.0,
            short: 0.0,
        };
    }
    // Blocked. An impulse that would speed the body up pays nothing.
    let available = (-b).max(0.0).powi(2) / (4.0 * a);
    Projection { scale: (-b).max(0.0) / (2.0 * a), share: available / cost, short: 0.0 }
}

/// With springs: the root next to 1, or 1 with the rest carried on.
fn near_one(a: f64, b: f64, cost: f64, carried: f64) -> Projection {
    let target = -(cost + carried);
    let discriminant = b * b + 4.0 * a * target;
    let mut scale = 1.0;
    if a > 0.0 && discriminant >= 0.0 {
        let root = discriminant.sqrt();
        // Both roots in their stable forms.
        let q = -0.5 * (b + root.copysign(b));
        let roots = [q / a, -target / q];
        let near = |l: &f64| (l - 1.0).abs() <= NEAR_ONE;
        if let Some(best) = roots
            .into_iter()
            .filter(near)
            .min_by(|x, y| (x - 1.0).abs().total_cmp(&(y - 1.0).abs()))
        {
            scale = best;
        }
    }
    let change = (a * scale + b) * scale;
    Projection { scale, share: 1.0, short: change - target }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Inertia;
    use nalgebra::{Point3, Vector3};

    fn toll(impulse: f64, wear: f64) -> Toll {
        Toll { impulse: Vector3::new(0.0, 0.0, impulse), wear, ..Toll::default() }
    }

    /// Fails for a projection that is right only to first order, or that lets a blocked body pay
    /// more than it has.
    #[test]
    fn the_body_loses_the_price_or_all_it_has() {
        let inertia = Inertia::of_ball(1.0, 1.0);
        let dynamics = Dynamics::new(&inertia, false).expect("a ball");
        let mut state = State::at(Point3::origin());
        state.velocity.z = -1.0;
        let energy = 0.5 * inertia.mass;
        for (impulse, cost) in [(0.3, 0.9 * energy), (10.0, 0.1 * energy), (0.3, 2.0 * energy)] {
            let p = project(&toll(impulse, cost), &state, &dynamics, false, 0.0);
            let v = -1.0 + p.scale * impulse / inertia.mass;
            let lost = energy - 0.5 * inertia.mass * v * v;
            assert!((lost - p.share * cost).abs() < 1e-15 * energy, "{impulse} {cost}");
            assert_eq!(p.share, if cost > energy { 0.5 } else { 1.0 });
        }
    }
}

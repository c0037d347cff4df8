//! The exact energy balance of a swept step: impulses along the faces are scaled by one scalar so
//! that the body loses what the removed volume costs, to round-off.
//!
//! With impulse J and torque T the kinetic energy changes by b l + a l^2 for the scale l, where
//! a = (J.M^-1 J + T.I^-1 T)/2 and b = J.v + T.w, summed over the bodies that they act on.

use std::ops::AddAssign;

use crate::body::State;
use crate::rotation::Dynamics;
use crate::toll::Push;

/// Range of the scale for springs: near a turning point their impulse does no work, and no scale
/// could balance it.
const SPRING_SCALES: [f64; 2] = [0.8, 1.2];

/// Scale of an impulse, and the share of the removal that the body can pay: below 1 when it is
/// blocked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Payment {
    pub scale: f64,
    pub share: f64,
}

/// What a body pays of a step's toll.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Paid {
    /// Scale of the impulses of the springs.
    pub spring: f64,
    /// Of what flows.
    pub flow: Payment,
}

impl Paid {
    /// All of it, as of a body that something else leads.
    pub(crate) const ALL: Self = Self { spring: 1.0, flow: Payment { scale: 1.0, share: 1.0 } };
}

impl Default for Paid {
    fn default() -> Self {
        Self::ALL
    }
}

/// Change of the kinetic energy by impulses scaled by l: b l + a l^2 [J].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Change {
    a: f64,
    b: f64,
}

impl AddAssign for Change {
    fn add_assign(&mut self, other: Self) {
        self.a += other.a;
        self.b += other.b;
    }
}

impl Change {
    /// That of a body in `state` by `push`.
    pub(crate) fn of(push: &Push, state: &State, dynamics: &Dynamics) -> Self {
        let turn = dynamics.turn(&state.rotation, &push.torque);
        let straight = push.impulse.norm_squared() * dynamics.inverse_mass;
        let b = push.impulse.dot(&state.velocity) + dynamics.work(&push.torque, &state.spin);
        Self { a: 0.5 * (straight + push.torque.dot(&turn)), b }
    }
}

/// Scales the impulse of sweeping faces so that the bodies lose `cost` [J]: b l + a l^2 = -cost.
/// Where that has no solution they give all that the direction has.
pub(crate) fn pay(Change { a, b }: Change, cost: f64) -> Payment {
    if cost <= 0.0 {
        return Payment { scale: 0.0, share: 1.0 };
    }
    if a <= 0.0 {
        // Nothing gives way: what leads the bodies pays.
        return Payment { scale: 1.0, share: 1.0 };
    }
    let discriminant = b * b - 4.0 * a * cost;
    if b < 0.0 && discriminant >= 0.0 {
        return Payment { scale: 2.0 * cost / (discriminant.sqrt() - b), share: 1.0 };
    }
    // An impulse that would speed the body up pays nothing.
    let brake = (-b).max(0.0);
    Payment { scale: brake / (2.0 * a), share: brake * brake / (4.0 * a * cost) }
}

/// As [`balance`], for springs that take back what loads gave `ahead` [J] as well, as far as they
/// can: the rest of that is nobody's debt.
pub(crate) fn balance_ahead(change: Change, cost: f64, ahead: f64) -> (f64, f64) {
    let (scale, short) = balance(change, cost + ahead);
    (scale, short - ahead.clamp(short.min(0.0), short.max(0.0)))
}

/// Scale of the springs' impulse that brings the kinetic energy nearest to losing `cost` [J], and
/// by how much it falls short of that [J].
fn balance(Change { a, b }: Change, cost: f64) -> (f64, f64) {
    let short = |l: f64| (a * l + b) * l + cost;
    let [low, high] = SPRING_SCALES;
    let discriminant = b * b - 4.0 * a * cost;
    let q = -0.5 * (b + discriminant.max(0.0).sqrt().copysign(b));
    // Both roots in their stable forms; NaN where there is none.
    let roots = if discriminant >= 0.0 { [q / a, cost / q] } else { [f64::NAN; 2] };
    let root = roots
        .into_iter()
        .filter(|l| (low..=high).contains(l))
        .min_by(|x, y| (x - 1.0).abs().total_cmp(&(y - 1.0).abs()));
    let nearest = |x: f64, y: f64| if short(y).abs() < short(x).abs() { y } else { x };
    let scale = root.unwrap_or_else(|| nearest(nearest(1.0, low), high));
    (scale, short(scale))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Inertia;
    use nalgebra::{Point3, Vector3};

    fn push(impulse: f64) -> Push {
        Push { impulse: Vector3::new(0.0, 0.0, impulse), ..Push::default() }
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
            let Payment { scale, share } = pay(Change::of(&push(impulse), &state, &dynamics), cost);
            let v = -1.0 + scale * impulse / inertia.mass;
            let lost = energy - 0.5 * inertia.mass * v * v;
            assert!((lost - share * cost).abs() < 1e-15 * energy, "{impulse} {cost}");
            assert_eq!(share, if cost > energy { 0.5 } else { 1.0 });
        }
    }

    /// Fails for springs that lose energy where a scale near 1 can keep it.
    #[test]
    fn springs_keep_the_energy_where_they_can() {
        let inertia = Inertia::of_ball(1.0, 1.0);
        let dynamics = Dynamics::new(&inertia, false).expect("a ball");
        let mut state = State::at(Point3::origin());
        state.velocity.z = -1.0;
        let cost = 0.1 - 0.5 * 0.01 / inertia.mass;
        let change = Change::of(&push(0.1), &state, &dynamics);
        let (scale, short) = balance(change, 1.05 * cost);
        assert!((1.0..1.1).contains(&scale) && short.abs() < 1e-15, "{scale} {short:e}");
        let (scale, short) = balance(change, 3.0 * cost);
        assert!(scale == 1.2 && short > 0.0, "{scale} {short:e}");
    }
}

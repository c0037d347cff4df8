//! Dashpots beside the springs of a contact: the coefficient of restitution of an impact below
//! yield, whatever the elastic law and the speed.
//!
//! Tsuji, Tanaka & Ishida (1992) damp a Hertz contact by 2 zeta sqrt(m K) so that its restitution
//! does not depend on the speed. For springs of any law with the stored energy U and the force
//! F = dU/dd, let q = sqrt(2 U / m). Then q' = W v and v' = -W q - (damping force)/m, where
//! W = F / (m q): with a damping force 2 zeta m W v = F 2 zeta v / q these are the equations of a
//! linear spring in the time that W counts (Antypov & Elliott 2011 for Hertz). A node's dashpot is
//! therefore its elastic force times 2 zeta d' / q, a relaxation time 2 zeta F / (K q).
//!
//! The total force of a node lies between zero and its cap. A node that flows keeps its overlap,
//! so its dashpot is at rest and the flow law does not see it; before that the dashpot brings the
//! load up to the cap early, which costs wear. Tangential springs that stick have the same
//! relaxation time; friction is limited by the elastic force.

use nalgebra::{Isometry3, UnitQuaternion, Vector3};

use crate::carried::Grip;
use crate::encounter::Placed;
use crate::integrate::Integrator;
use crate::ride::reaction;
use crate::rotation::Dynamics;
use crate::toll::Push;
use crate::trial::Trial;

/// Halvings in which an angle is known to round-off.
const HALVINGS: usize = 60;

/// A spring over a step, for its dashpot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sprung {
    /// m: unit, from the body into the surface, and the lever of the force [m].
    pub normal: Vector3<f64>,
    pub arm: Vector3<f64>,
    /// c = -m . n.
    pub cosine: f64,
    /// Mean elastic force of the step along m [N], and how far it was pressed in [m].
    pub force: f64,
    pub advance: f64,
    /// Largest force along m that the flow law allows [N].
    pub cap: f64,
    /// Its energy before and after [J].
    pub stored: [f64; 2],
    /// dF/dd at the end of the step [N/m].
    pub stiffness: f64,
    pub shear: Shear,
}

/// The tangential spring beside it; nothing for columns.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Shear {
    /// Mean force [N], its limit by friction [N], and the spring's stiffness [N/m].
    pub force: Vector3<f64>,
    pub limit: f64,
    pub stiffness: f64,
    /// Change of the stretch, slip left out [m].
    pub advance: Vector3<f64>,
}

/// The springs of one contact in one step; kept for its buffer.
#[derive(Clone, Debug, Default)]
pub(crate) struct Dashpots {
    springs: Vec<Sprung>,
}

/// What the dashpots do to a body over a step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Damping {
    /// Impulse [N s] and impulsive torque about the centre of mass [N m s].
    pub impulse: Vector3<f64>,
    pub torque: Vector3<f64>,
    /// Dissipated energy [J], >= 0.
    pub dissipated: f64,
    /// Rate at which they slow the body down [1/s].
    pub rate: f64,
    /// Mean force along minus the nodes' normals [N].
    pub normal_load: f64,
}

/// zeta of a contact that ends when its force is zero: with zeta = sin(phi) the restitution is
/// e = exp(-(pi - 2 phi) tan(phi)), beyond e = exp(-2) with zeta = cosh(theta)
/// e = exp(-2 theta / tanh(theta)); the same as Schwager & Poeschel (2007), Eqs. 21 and 22.
pub(crate) fn damping_ratio(restitution: f64) -> f64 {
    let wanted = -restitution.ln();
    if wanted <= 0.0 {
        return 0.0;
    }
    let pi = std::f64::consts::PI;
    match wanted < 2.0 {
        true => root(0.5 * pi, |phi| (pi - 2.0 * phi) * phi.tan() - wanted).sin(),
        false => root(wanted, |theta| 2.0 * theta / theta.tanh() - wanted).cosh(),
    }
}

/// Where a rising function is zero between zero and `high`.
fn root(high: f64, excess: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, high);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if excess(middle) < 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

impl Dashpots {
    pub(crate) fn clear(&mut self) {
        self.springs.clear();
    }

    pub(crate) fn add(&mut self, spring: Sprung) {
        self.springs.push(spring);
    }

    /// What the dashpots of damping ratio `ratio` do over `dt` [s] to a body that a force and its
    /// torque move with 1/m = `inverse_mass`.
    fn act(
        &self,
        ratio: f64,
        dt: f64,
        inverse_mass: impl Fn(&Vector3<f64>, &Vector3<f64>) -> f64,
    ) -> Damping {
        let (mut force, mut torque) = (Vector3::zeros(), Vector3::zeros());
        let (mut stiffness, mut stored) = (0.0, [0.0; 2]);
        for spring in &self.springs {
            let push = spring.normal * spring.force;
            force += push;
            torque += spring.arm.cross(&push);
            stiffness += spring.stiffness;
            stored = std::array::from_fn(|i| stored[i] + spring.stored[i]);
        }
        let inverse_mass = inverse_mass(&force, &torque);
        let [before, after] = stored.map(|energy| (2.0 * energy * inverse_mass).sqrt());
        // The rise of q times its mean is the work of the mean force over m.
        let per_advance = 2.0 * ratio / (0.5 * (before + after) * dt);
        let mut damping = Damping::default();
        if !per_advance.is_finite() {
            return damping;
        }
        damping.rate = per_advance * dt * force.norm() * inverse_mass;
        // tau / dt: all springs of the contact, tangential ones too, have one relaxation time.
        let relaxation = if stiffness > 0.0 { per_advance * force.norm() / stiffness } else { 0.0 };
        for spring in &self.springs {
            let room = (spring.cap - spring.force).max(0.0);
            let force = (spring.force * per_advance * spring.advance).max(-spring.force).min(room);
            let shear = spring.shear.dashpot(relaxation);
            let impulse = (spring.normal * force + shear) * -dt;
            damping.impulse += impulse;
            damping.torque += spring.arm.cross(&impulse);
            damping.dissipated += force * spring.advance + shear.dot(&spring.shear.advance);
            damping.normal_load += force * spring.cosine;
        }
        damping
    }
}

impl Shear {
    /// Force of the dashpot [N]: with the spring's it stays within friction's limit, a convex set,
    /// so that it never drives the motion.
    fn dashpot(&self, relaxation: f64) -> Vector3<f64> {
        let added = self.advance * (self.stiffness * relaxation);
        let total = self.force + added;
        let (length, limit) = (total.norm(), self.limit.max(self.force.norm()));
        if length > limit { total * (limit / length) - self.force } else { added }
    }
}

impl Damping {
    /// Adds what another surface, whose frame is `pose`, does.
    fn add(&mut self, other: &Self, pose: &Isometry3<f64>) {
        self.impulse += pose * other.impulse;
        self.torque += pose * other.torque;
        self.dissipated += other.dissipated;
        self.rate += other.rate;
        self.normal_load += other.normal_load;
    }

    /// As impulses.
    pub(crate) fn push(&self) -> Push {
        Push { impulse: self.impulse, torque: self.torque, ..Push::default() }
    }

    /// Half of it, as impulses.
    pub(crate) fn half(&self) -> Push {
        self.push().scaled(0.5)
    }
}

impl Integrator {
    /// Finds what the dashpots of every contact do over the step of a trial.
    pub(crate) fn damp(&mut self, surfaces: &[Placed<'_>], trial: &Trial) {
        self.damping = Damping::default();
        let (dynamics, rotation) = (&self.dynamics, &trial.state.rotation);
        for (i, (contact, placed)) in self.contacts.iter_mut().zip(surfaces).enumerate() {
            if contact.damping_ratio() == 0.0 {
                continue;
            }
            self.dashpots.clear();
            contact.press(placed.surface.laws(), &mut self.dashpots);
            let ride = self.rides.get(i).and_then(Option::as_ref);
            let pose = ride.map_or(placed.pose, |ride| ride.pose);
            let inverse_mass = |force: &Vector3<f64>, torque: &Vector3<f64>| {
                let grip = Grip { force: pose * force, torque: pose * torque };
                let below = ride.map_or(0.0, |ride| {
                    let back = reaction(&grip, &trial.state, &ride.end);
                    answer(&ride.dynamics, &ride.end.rotation, &back)
                });
                answer(dynamics, rotation, &grip) + below
            };
            let damping = self.dashpots.act(contact.damping_ratio(), trial.dt, inverse_mass);
            contact.take_damping(&damping);
            self.damping.add(&damping, &pose);
            if ride.is_some() {
                let answer = &mut self.answers[i].damping;
                *answer = Push::default();
                answer.add(&damping.push(), &pose);
            }
        }
    }
}

/// Reciprocal of the mass that a force with its torque finds at its point of attack [1/kg].
fn answer(dynamics: &Dynamics, rotation: &UnitQuaternion<f64>, grip: &Grip) -> f64 {
    let Grip { force, torque } = grip;
    let turning = dynamics.turn(rotation, torque);
    let moved = force.dot(&dynamics.accelerate(force)) + torque.dot(&turning);
    moved / force.norm_squared()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a wrong branch of the relation: the linear dashpot integrated until its force is
    /// zero.
    #[test]
    fn the_ratio_belongs_to_a_contact_that_ends_without_force() {
        for restitution in [0.05, 0.13, 0.14, 0.3, 0.5, 0.9, 0.99] {
            let zeta = damping_ratio(restitution);
            let (mut q, mut v) = (0.0f64, 1.0f64);
            let dt = 1e-4 / (1.0 + zeta);
            while q + 2.0 * zeta * v > 0.0 {
                // Midpoint rule.
                let rate = |q: f64, v: f64| (v, -q - 2.0 * zeta * v);
                let (dq, dv) = rate(q, v);
                let (dq, dv) = rate(q + 0.5 * dt * dq, v + 0.5 * dt * dv);
                (q, v) = (q + dt * dq, v + dt * dv);
            }
            assert!((-v / restitution - 1.0).abs() < 1e-3, "{restitution} {v}");
        }
        assert_eq!(damping_ratio(1.0), 0.0);
    }
}

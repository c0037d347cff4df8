//! What Rapier's contact of two colliders amounts to: its impulse, where it acted, and the mass and
//! the speed of a body that would have had it.

use abrade::State;
use nalgebra::{Point3, Vector3};
use rapier::dynamics::{CoefficientCombineRule, RigidBody, RigidBodyHandle};
use rapier::geometry::{Collider, ContactManifold, ContactPair};

use crate::held::Before;
use crate::view::WorldView;
use crate::{derive, scalar, shadow};

/// Clearance at the start of a contact in the core, in pitches.
const CLEAR: f64 = 0.02;

/// The contact of a pair in a step.
pub(crate) struct Blow {
    /// Impulse on the second collider along the normal [N s], and the energy of a blow [J].
    pub impulse: f64,
    pub energy: f64,
    /// Unit normal from the first collider to the second, in the world.
    pub normal: Vector3<f64>,
    /// Mass of the pair for impulses along the normal where it acted [kg].
    pub mass: f64,
    /// Restitution that Rapier gave it [-].
    pub restitution: f64,
    /// Velocity of the second collider over the first before the step, along the contact [m/s].
    pub sliding: Vector3<f64>,
    /// Speed at which they approached each other before the step, and still do after it [m/s].
    pub approach: f64,
    pub closing: f64,
    /// Where it acted, in the world.
    pub place: Point3<f64>,
    /// Their dynamic bodies.
    pub bodies: [Option<RigidBodyHandle>; 2],
    /// How deep Rapier lets them overlap [m].
    pub overlap: f64,
}

impl Blow {
    /// Speed of a body of the pair's mass that has the energy of the blow [m/s].
    pub fn speed(&self) -> f64 {
        (2.0 * self.energy / self.mass).sqrt()
    }

    /// Energy of a body of the pair's mass that has an impulse in a collision [J].
    pub fn energy_of(&self, impulse: f64) -> f64 {
        0.5 * (impulse / (1.0 + self.restitution)).powi(2) / self.mass
    }

    /// Energy that an impulse of the contact took from its bodies in the step, before it gave any back
    /// [J].
    pub fn taken(&self, impulse: f64) -> f64 {
        0.5 * impulse * (self.approach + self.closing.max(0.0)) / (1.0 + self.restitution)
    }

    /// The contact of `pair` in the last step; None for one without rigid contacts or whose colliders
    /// are gone.
    pub fn of(pair: &ContactPair, world: &WorldView<'_>, before: &Before) -> Option<Self> {
        let [first, second] = colliders(pair, world)?;
        let Mean { impulse, normal, place, overlap } = Mean::of(pair, first)?;
        let sides = [first, second].map(|collider| Side::of(collider, world, before));
        let ease: f64 = sides.iter().map(|side| side.ease(&place, &normal)).sum();
        let apart = |at: usize| {
            let [a, b] = [&sides[0], &sides[1]].map(|side| side.velocity(&place, at));
            b - a
        };
        let (came, left) = (apart(0), apart(1));
        Some(Self {
            impulse,
            energy: 0.0,
            normal,
            mass: 1.0 / ease,
            restitution: restitution(first, second),
            sliding: came - normal * normal.dot(&came),
            approach: -came.dot(&normal),
            closing: -left.dot(&normal),
            place,
            bodies: sides.map(|side| side.body),
            overlap,
        })
        .filter(|blow| blow.mass.is_finite() && blow.mass > 0.0)
    }

    /// Velocity of the centre of one of the pair, the second where the `first_stands`, over the material
    /// of the other before the step, along the contact; zero for what no dynamic body is [m/s].
    pub fn drift(
        &self,
        pair: &ContactPair,
        first_stands: bool,
        world: &WorldView<'_>,
        before: &Before,
    ) -> Vector3<f64> {
        let Some([first, second]) = colliders(pair, world) else { return Vector3::zeros() };
        let [stands, moves] = if first_stands { [first, second] } else { [second, first] }
            .map(|collider| Side::of(collider, world, before));
        if moves.body.is_none() {
            return Vector3::zeros();
        }
        let drift = moves.drift(&stands);
        drift - self.normal * self.normal.dot(&drift)
    }

    /// How far back from where Rapier has left it one of the pair is clear of a surface of this `pitch`
    /// [m].
    pub fn back(&self, pitch: f64) -> f64 {
        self.overlap.max(0.0) + CLEAR * pitch
    }
}

/// The two colliders of a pair; None where one is gone.
fn colliders<'a>(pair: &ContactPair, world: &'a WorldView<'_>) -> Option<[&'a Collider; 2]> {
    Some([world.colliders.get(pair.collider1)?, world.colliders.get(pair.collider2)?])
}

/// Restitution of Rapier's contact of two colliders.
fn restitution(first: &Collider, second: &Collider) -> f64 {
    let rules = [first, second].map(|c| c.restitution_combine_rule());
    let [one, other] = [first, second].map(|c| c.restitution());
    scalar::wide(CoefficientCombineRule::combine(one, other, rules[0], rules[1])).clamp(0.0, 1.0)
}

/// Means over the points of a contact, by their impulses.
struct Mean {
    impulse: f64,
    normal: Vector3<f64>,
    place: Point3<f64>,
    overlap: f64,
}

impl Mean {
    fn of(pair: &ContactPair, first: &Collider) -> Option<Self> {
        let pose = scalar::pose(first.position());
        let mut vector = Vector3::zeros();
        let (mut place, mut whole, mut overlap) = (Vector3::zeros(), 0.0, 0.0f64);
        for manifold in pair.solver_manifolds() {
            let normal = scalar::vector(manifold.data.normal);
            let local = part(manifold);
            for point in &manifold.points {
                let impulse = scalar::wide(point.data.impulse);
                vector += normal * impulse;
                place +=
                    (pose * local * Point3::from(scalar::vector(point.local_p1))).coords * impulse;
                whole += impulse;
                if impulse > 0.0 {
                    overlap = overlap.max(-scalar::wide(point.dist));
                }
            }
        }
        let impulse = vector.norm();
        let sound = impulse > 0.0 && impulse.is_finite() && whole > 0.0;
        let place = Point3::from(place / whole);
        sound.then(|| Self { impulse, normal: vector / impulse, place, overlap })
    }
}

/// Where the touching part of the first collider lies in it.
fn part(manifold: &ContactManifold) -> nalgebra::Isometry3<f64> {
    manifold.subshape_pos1().map_or_else(nalgebra::Isometry3::identity, scalar::pose)
}

/// One of two that collide: its motion before and after the step, and how it gives way.
struct Side<'a> {
    states: [State; 2],
    body: Option<RigidBodyHandle>,
    rb: Option<&'a RigidBody>,
}

impl<'a> Side<'a> {
    fn of(collider: &Collider, world: &'a WorldView<'_>, before: &Before) -> Self {
        let at = State::at(scalar::vector(collider.position().translation).into());
        let parent = collider.parent().and_then(|h| Some((h, world.bodies.get(h)?)));
        let Some((handle, rb)) = parent.filter(|(_, rb)| !rb.is_fixed()) else {
            return Self { states: [at; 2], body: None, rb: None };
        };
        let after = shadow::held(rb);
        let before = before.of(handle).copied().unwrap_or(after);
        let rb = rb.is_dynamic().then_some(rb);
        Self { states: [before, after], body: rb.map(|_| handle), rb }
    }

    /// Velocity of its material at `place`, before (0) or after (1) the step [m/s].
    fn velocity(&self, place: &Point3<f64>, at: usize) -> Vector3<f64> {
        let state = &self.states[at];
        state.velocity + state.spin.cross(&(place - state.position))
    }

    /// Velocity of its centre over the material of `other` there, before the step [m/s].
    fn drift(&self, other: &Self) -> Vector3<f64> {
        self.states[0].velocity - other.velocity(&self.states[0].position, 0)
    }

    /// Velocity of its material at `place` along `normal` per impulse along it [1/kg].
    fn ease(&self, place: &Point3<f64>, normal: &Vector3<f64>) -> f64 {
        let Some(inertia) = self.rb.and_then(|rb| derive::inertia(rb).ok()) else { return 0.0 };
        let state = &self.states[1];
        let arm = (place - state.position).cross(normal);
        let local = state.rotation.inverse_transform_vector(&arm);
        let turn =
            inertia.tensor.try_inverse().map_or(0.0, |inverse| local.dot(&(inverse * local)));
        1.0 / inertia.mass + turn
    }
}

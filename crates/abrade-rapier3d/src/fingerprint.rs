//! What the colliders of a body looked like when the core's body was derived from them, to see
//! when it has to be derived anew.
//!
//! A print keeps the shape, so that no other one can come to lie where it lies in memory, nor be made
//! of it in place. One that lies elsewhere, as after a world was read from bytes, is the same when
//! every number that is derived from is.

use std::sync::Arc;

use rapier::dynamics::RigidBody;
use rapier::geometry::{Collider, ColliderHandle, ColliderSet, SharedShape};
use rapier::math::{Pose, Vector};
use rapier::parry::shape::{Shape, TypedShape};

use crate::derive::{is_solid, solids};
use crate::obstacle::extent;
use crate::scalar;

/// What a collider looked like.
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Print {
    glimpse: Glimpse,
    /// Every number of the shape, folded into one.
    content: u64,
    /// The shape itself; none when the glimpse has all of its numbers.
    #[cfg_attr(feature = "serde-serialize", serde(skip))]
    shape: Option<SharedShape>,
}

/// What is cheapest to read of it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
struct Glimpse {
    collider: ColliderHandle,
    pose: Pose,
    solid: bool,
    numbers: [f64; 3],
}

/// Prints the colliders of a body, in their order.
pub(crate) fn take(prints: &mut Vec<Print>, body: &RigidBody, colliders: &ColliderSet) {
    prints.clear();
    let of = |(handle, collider): (ColliderHandle, &Collider)| {
        let (content, shape) = (content(collider.shape()), kept(collider));
        Print { glimpse: Glimpse::of(handle, collider), content, shape }
    };
    prints.extend(solids(body, colliders, false).map(of));
}

/// True when the colliders of a body are those of the prints.
pub(crate) fn hold(prints: &mut [Print], body: &RigidBody, colliders: &ColliderSet) -> bool {
    let mut prints = prints.iter_mut();
    let same = |(handle, collider): (ColliderHandle, &Collider)| {
        prints.next().is_some_and(|print| print.holds(handle, collider))
    };
    solids(body, colliders, false).all(same) && prints.next().is_none()
}

impl Print {
    fn holds(&mut self, handle: ColliderHandle, collider: &Collider) -> bool {
        if self.glimpse != Glimpse::of(handle, collider) {
            return false;
        }
        let seen = &collider.shared_shape().0;
        if self.shape.as_ref().is_some_and(|SharedShape(kept)| Arc::ptr_eq(kept, seen)) {
            return true;
        }
        let shape = kept(collider);
        let has_all = self.shape.is_none() && shape.is_none();
        self.shape = shape;
        has_all || content(collider.shape()) == self.content
    }
}

impl Glimpse {
    fn of(collider: ColliderHandle, seen: &Collider) -> Self {
        let numbers = match seen.shape().as_typed_shape() {
            TypedShape::Ball(ball) => [scalar::wide(ball.radius), 0.0, 0.0],
            TypedShape::Cuboid(cuboid) => scalar::vector(cuboid.half_extents).into(),
            TypedShape::ConvexPolyhedron(hull) => [hull.points().len() as f64, 0.0, 0.0],
            TypedShape::Compound(compound) => [compound.shapes().len() as f64, 0.0, 0.0],
            _ => [0.0; 3],
        };
        let pose = seen.position_wrt_parent().copied().unwrap_or(Pose::IDENTITY);
        Self { collider, pose, solid: is_solid(seen), numbers }
    }
}

/// The shape of a collider, but for balls and cuboids: a glimpse has all of their numbers.
fn kept(collider: &Collider) -> Option<SharedShape> {
    match collider.shape().as_typed_shape() {
        TypedShape::Ball(_) | TypedShape::Cuboid(_) => None,
        _ => Some(collider.shared_shape().clone()),
    }
}

/// The numbers of a shape that a body is derived from, its kind among them.
fn content(shape: &dyn Shape) -> u64 {
    let mut fold = Fold(OFFSET);
    fold.shape(shape);
    fold.0
}

/// The hash FNV-1a (Fowler, Noll & Vo), word by word.
struct Fold(u64);

const OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
const PRIME: u64 = 0x0100_0000_01b3;

impl Fold {
    fn word(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(PRIME);
        // A product passes nothing down to the lower bits.
        self.0 ^= self.0 >> 32;
    }

    fn numbers(&mut self, numbers: impl IntoIterator<Item = f64>) {
        numbers.into_iter().for_each(|x| self.word(x.to_bits()));
    }

    fn vector(&mut self, v: Vector) {
        self.numbers(scalar::vector(v).iter().copied());
    }

    fn shape(&mut self, shape: &dyn Shape) {
        match shape.as_typed_shape() {
            TypedShape::Ball(ball) => {
                self.word(1);
                self.numbers([scalar::wide(ball.radius)]);
            }
            TypedShape::Cuboid(cuboid) => {
                self.word(2);
                self.vector(cuboid.half_extents);
            }
            TypedShape::ConvexPolyhedron(hull) => {
                self.word(3);
                hull.points().iter().for_each(|point| self.vector(*point));
            }
            TypedShape::Compound(compound) => {
                self.word(4);
                for (pose, part) in compound.shapes() {
                    let part: &SharedShape = part;
                    let pose = scalar::pose(pose);
                    self.numbers(pose.translation.vector.iter().copied());
                    self.numbers(pose.rotation.coords.iter().copied());
                    self.shape(part.as_ref());
                }
            }
            _ => {
                self.word(5);
                let around = extent(&shape.compute_local_aabb());
                self.numbers(around.low.coords.iter().chain(around.high.coords.iter()).copied());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use rapier::dynamics::RigidBodyBuilder;
    use rapier::geometry::ColliderBuilder;
    use rapier::pipeline::PhysicsWorld;

    use super::*;

    fn hull(edge: f64) -> SharedShape {
        let corner = |x: f64, y: f64, z: f64| {
            scalar::to_vector(&nalgebra::Vector3::new(edge * x, edge * y, edge * z))
        };
        let corners = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)];
        SharedShape::convex_hull(&corners.map(|(x, y, z)| corner(x, y, z))).expect("a hull")
    }

    /// Fails for a print that goes by the place in memory: the second shape comes to lie where the first
    /// lay.
    #[test]
    fn other_numbers_at_the_same_place_are_another_shape() {
        let mut world = PhysicsWorld::default();
        let collider = ColliderBuilder::new(hull(1.0));
        let (body, collider) = world.insert(RigidBodyBuilder::dynamic(), collider);
        let mut prints = Vec::new();
        take(&mut prints, &world.bodies[body], &world.colliders);
        world.colliders[collider].set_shape(SharedShape::ball(scalar::narrow(1.0)));
        world.colliders[collider].set_shape(hull(1.5));
        assert!(!hold(&mut prints, &world.bodies[body], &world.colliders));
    }

    /// Fails for a print that goes by the place in memory, as another process has another one, and
    /// for one that sees no change behind it.
    #[test]
    fn the_same_numbers_at_another_place_are_the_same_shape() {
        let compound = |edge| SharedShape::compound(vec![(Pose::IDENTITY, hull(edge))]);
        for make in [hull, compound] {
            let mut world = PhysicsWorld::default();
            let collider = ColliderBuilder::new(make(1.0));
            let (body, collider) = world.insert(RigidBodyBuilder::dynamic(), collider);
            let mut prints = Vec::new();
            take(&mut prints, &world.bodies[body], &world.colliders);
            for (edge, same) in [(1.0, true), (1.5, false), (1.0, true)] {
                world.colliders[collider].set_shape(make(edge));
                assert_eq!(hold(&mut prints, &world.bodies[body], &world.colliders), same);
            }
        }
    }
}

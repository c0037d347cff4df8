//! What the colliders of a body looked like when the core's body was derived from them, to see
//! when it has to be derived anew.
//!
//! A shape that lies where it lay in memory is the same one. Elsewhere, as after a world was read
//! from bytes, it is the same when every number that is derived from is.

use rapier::dynamics::RigidBody;
use rapier::geometry::{Collider, ColliderHandle, ColliderSet, SharedShape};
use rapier::math::{Pose, Vector};
use rapier::parry::shape::{Shape, TypedShape};

use crate::derive::{is_solid, solids};
use crate::obstacle::extent;
use crate::scalar;

/// What a collider looked like.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Print {
    collider: ColliderHandle,
    pose: Pose,
    solid: bool,
    numbers: [f64; 3],
    /// Every number of the shape, folded into one.
    content: u64,
    /// Where the rest of its numbers lie; nowhere when `numbers` has them all.
    #[cfg_attr(feature = "serde-serialize", serde(skip))]
    address: Option<usize>,
}

/// Prints the colliders of a body, in their order.
pub(crate) fn take(prints: &mut Vec<Print>, body: &RigidBody, colliders: &ColliderSet) {
    prints.clear();
    let of = |(handle, collider): (ColliderHandle, &Collider)| {
        let print = glimpse(handle, collider);
        Print { content: content(collider.shape()), ..print }
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
        let seen = glimpse(handle, collider);
        let kept = Self { content: 0, address: seen.address, ..*self };
        if kept != seen {
            return false;
        }
        if self.address != seen.address {
            if content(collider.shape()) != self.content {
                return false;
            }
            self.address = seen.address;
        }
        true
    }
}

/// The print of a collider, but for the content of its shape.
fn glimpse(handle: ColliderHandle, collider: &Collider) -> Print {
    let (numbers, address) = match collider.shape().as_typed_shape() {
        TypedShape::Ball(ball) => ([scalar::wide(ball.radius), 0.0, 0.0], None),
        TypedShape::Cuboid(cuboid) => (scalar::vector(cuboid.half_extents).into(), None),
        TypedShape::ConvexPolyhedron(hull) => {
            ([hull.points().len() as f64, 0.0, 0.0], Some(hull.points().as_ptr().addr()))
        }
        TypedShape::Compound(compound) => {
            ([compound.shapes().len() as f64, 0.0, 0.0], Some(compound.shapes().as_ptr().addr()))
        }
        _ => ([0.0; 3], Some(std::ptr::from_ref(collider.shape()).cast::<u8>().addr())),
    };
    let pose = collider.position_wrt_parent().copied().unwrap_or(Pose::IDENTITY);
    let solid = is_solid(collider);
    Print { collider: handle, pose, solid, numbers, content: 0, address }
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

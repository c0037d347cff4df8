//! Everything solid that is no wear surface, as it may stand in a body's way over a step.
//! Collected only when a body comes near a wear surface.

use nalgebra::{Isometry3, Vector3};
use rapier::dynamics::{RigidBody, RigidBodyHandle};
use rapier::geometry::{Aabb, Collider, ColliderHandle, ColliderSet};
use rapier::parry::query::intersection_test;
use rapier::parry::shape::Cuboid;

use crate::path::Extent;
use crate::scalar;
use crate::view::WorldView;

/// A collider and how far it can get over the step.
struct Obstacle {
    collider: ColliderHandle,
    body: Option<RigidBodyHandle>,
    extent: Extent,
    /// Travel over the step [m].
    travel: f64,
}

/// The colliders of a step that bodies may run into.
#[derive(Default)]
pub(crate) struct Obstacles {
    list: Vec<Obstacle>,
    collected: bool,
}

impl Obstacles {
    /// Forgets the last step's.
    pub fn clear(&mut self) {
        self.list.clear();
        self.collected = false;
    }

    /// Collects the solid colliders, `is_proxy` ones apart, unless that was done for this step.
    pub fn collect(
        &mut self,
        world: &WorldView<'_>,
        dt: f64,
        is_proxy: impl Fn(ColliderHandle) -> bool,
    ) {
        if self.collected {
            return;
        }
        self.collected = true;
        for (handle, collider) in world.colliders.iter_enabled() {
            if collider.is_sensor() || is_proxy(handle) {
                continue;
            }
            let body = collider.parent();
            let parent = body.and_then(|handle| world.bodies.get(handle));
            let travel = parent.map_or(0.0, |rb| travel(rb, collider, world, dt));
            let extent = extent(&collider.compute_aabb()).grown(travel);
            self.list.push(Obstacle { collider: handle, body, extent, travel });
        }
    }

    /// The first collider that `body` could run into within `region`, a box in `frame`.
    pub fn in_way(
        &self,
        body: RigidBodyHandle,
        own: &[ColliderHandle],
        region: &Extent,
        frame: &Isometry3<f64>,
        colliders: &ColliderSet,
    ) -> Option<ColliderHandle> {
        let world_box = region.placed_by(frame);
        let near = self.list.iter().filter(|o| o.body != Some(body) && o.extent.meets(&world_box));
        let mut solid = near.filter(|o| {
            colliders.get(o.collider).is_some_and(|other| {
                let own = own.iter().filter_map(|&handle| colliders.get(handle));
                let mut felt = own.filter(|mine| interact(mine, other));
                felt.next().is_some() && overlaps(region, frame, o.travel, other)
            })
        });
        solid.next().map(|o| o.collider)
    }
}

/// Would Rapier solve a contact between the two?
pub(crate) fn interact(a: &Collider, b: &Collider) -> bool {
    a.is_enabled()
        && !a.is_sensor()
        && a.collision_groups().test(b.collision_groups())
        && a.solver_groups().test(b.solver_groups())
}

/// Does the box touch the collider itself, grown by its travel? Shapes that Rapier cannot test
/// count as touched.
fn overlaps(region: &Extent, frame: &Isometry3<f64>, travel: f64, other: &Collider) -> bool {
    let half = region.half() + Vector3::repeat(travel);
    let centre = Isometry3::from(nalgebra::center(&region.low, &region.high));
    let pose = scalar::to_pose(&(frame * centre));
    let cuboid = Cuboid::new(scalar::to_vector(&half));
    let test = intersection_test(&pose, &cuboid, other.position(), other.shape());
    test.map_or(true, |found| found.intersecting)
}

/// Farthest that a point of the collider can move over the step [m].
fn travel(body: &RigidBody, collider: &Collider, world: &WorldView<'_>, dt: f64) -> f64 {
    let extent = extent(&collider.compute_aabb());
    let centre = scalar::vector(body.center_of_mass());
    let arm = (extent.low.coords - centre).abs().sup(&(extent.high.coords - centre).abs()).norm();
    let turn = |angle: f64| arm * angle.min(2.0);
    if body.is_dynamic() && !body.is_sleeping() {
        let mass = scalar::wide(body.mass()).max(f64::MIN_POSITIVE);
        let gravity = scalar::vector(world.gravity) * scalar::wide(body.gravity_scale());
        let pull = (gravity + scalar::vector(body.user_force()) / mass).norm();
        let speed = scalar::vector(body.linvel()).norm();
        let spin = scalar::vector(body.angvel()).norm();
        return speed * dt + 0.5 * pull * dt * dt + turn(spin * dt);
    }
    if body.is_kinematic() {
        let step = scalar::pose(body.position()).inverse() * scalar::pose(body.next_position());
        let speed = scalar::vector(body.linvel()).norm();
        let spin = scalar::vector(body.angvel()).norm();
        let set = step.translation.vector.norm() + turn(step.rotation.angle());
        return set.max(speed * dt + turn(spin * dt));
    }
    0.0
}

pub(crate) fn extent(aabb: &Aabb) -> Extent {
    Extent { low: scalar::vector(aabb.mins).into(), high: scalar::vector(aabb.maxs).into() }
}

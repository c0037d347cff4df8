//! Everything solid that is no wear surface, as it may stand in a body's way over a step.
//! Collected only when a body comes near a wear surface.

use nalgebra::{Isometry3, Point3};
use rapier::dynamics::{RigidBody, RigidBodyHandle};
use rapier::geometry::{Aabb, Collider, ColliderHandle, ColliderSet};
use rapier::math::{Pose, Vector};
use rapier::parry::query::{ShapeCastOptions, cast_shapes, intersection_test};
use rapier::parry::shape::Cuboid;

use crate::path::Extent;
use crate::scalar;
use crate::view::WorldView;

/// A collider, and the box within which it stays over the step.
struct Obstacle {
    collider: ColliderHandle,
    body: Option<RigidBodyHandle>,
    extent: Extent,
    moves: bool,
}

/// The colliders of a step that bodies may run into.
#[derive(Default)]
pub(crate) struct Obstacles {
    list: Vec<Obstacle>,
}

impl Obstacles {
    /// Forgets the last step's.
    pub fn clear(&mut self) {
        self.list.clear();
    }

    /// Collects the solid colliders of a step, `is_proxy` ones apart.
    /// `course` gives the box of bodies that are themselves on their way to a wear surface.
    pub fn collect(
        &mut self,
        world: &WorldView<'_>,
        dt: f64,
        is_proxy: impl Fn(ColliderHandle) -> bool,
        course: impl Fn(RigidBodyHandle) -> Option<Extent>,
    ) {
        for (handle, collider) in world.colliders.iter_enabled() {
            if collider.is_sensor() || is_proxy(handle) {
                continue;
            }
            let body = collider.parent();
            let parent = body.and_then(|handle| world.bodies.get(handle));
            let parent =
                parent.filter(|rb| rb.is_dynamic() && !rb.is_sleeping() || rb.is_kinematic());
            let standing = extent(&collider.compute_aabb());
            let swept = || parent.map(|rb| swept(rb, &standing, world, dt));
            let swept = body.and_then(&course).or_else(swept);
            let (moves, extent) = (swept.is_some(), swept.unwrap_or(standing));
            self.list.push(Obstacle { collider: handle, body, extent, moves });
        }
    }

    /// Puts the box within which a body really stayed in place of the one it might have.
    pub fn settle(&mut self, body: RigidBodyHandle, extent: Extent) {
        for obstacle in self.list.iter_mut().filter(|o| o.body == Some(body)) {
            obstacle.extent = extent;
        }
    }

    /// True when another moving body comes to meet `body` in this step, faster than `limit` [m/s].
    pub fn blow(&self, body: RigidBodyHandle, world: &WorldView<'_>, dt: f64, limit: f64) -> bool {
        self.list.iter().filter(|o| o.body == Some(body)).any(|own| {
            let Some(mine) = world.colliders.get(own.collider) else { return false };
            let mut others = self.list.iter().filter(|o| o.moves && o.body != Some(body));
            others.any(|other| {
                other.extent.meets(&own.extent)
                    && world.colliders.get(other.collider).is_some_and(|theirs| {
                        interact(mine, theirs) && closes([mine, theirs], world, dt, limit)
                    })
            })
        })
    }

    /// Shows everything but `body` itself that could meet one of its colliders in this step: the
    /// colliders, and the bodies they are on.
    pub fn show_near(
        &self,
        body: RigidBodyHandle,
        colliders: &ColliderSet,
        mut show: impl FnMut(ColliderHandle, Option<RigidBodyHandle>),
    ) {
        for own in self.list.iter().filter(|o| o.body == Some(body)) {
            let Some(mine) = colliders.get(own.collider) else { continue };
            let others = self.list.iter().filter(|o| o.body != Some(body));
            for other in others.filter(|o| o.extent.meets(&own.extent)) {
                if colliders.get(other.collider).is_some_and(|theirs| interact(mine, theirs)) {
                    show(other.collider, other.body);
                }
            }
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
                let mut own = own.iter().filter_map(|&handle| colliders.get(handle));
                own.any(|mine| interact(mine, other)) && o.meets(region, frame, other)
            })
        });
        solid.next().map(|o| o.collider)
    }
}

impl Obstacle {
    /// Does the box `region` in `frame` touch the collider itself, or the box it stays in if it
    /// moves? Shapes that Rapier cannot test count as touched.
    fn meets(&self, region: &Extent, frame: &Isometry3<f64>, collider: &Collider) -> bool {
        let (pose, cuboid) = cuboid(region, frame);
        let test = match self.moves {
            true => {
                let (own_pose, own) = self::cuboid(&self.extent, &Isometry3::identity());
                intersection_test(&pose, &cuboid, &own_pose, &own)
            }
            false => intersection_test(&pose, &cuboid, collider.position(), collider.shape()),
        };
        test.map_or(true, |found| found.intersecting)
    }
}

fn cuboid(region: &Extent, frame: &Isometry3<f64>) -> (Pose, Cuboid) {
    let centre = Isometry3::from(nalgebra::center(&region.low, &region.high));
    (scalar::to_pose(&(frame * centre)), Cuboid::new(scalar::to_vector(&region.half())))
}

/// Do two colliders that are apart meet within `dt` [s], as their bodies move now, faster than
/// `limit` [m/s]?
fn closes(pair: [&Collider; 2], world: &WorldView<'_>, dt: f64, limit: f64) -> bool {
    let velocity = |collider: &Collider| {
        let body = collider.parent().and_then(|handle| world.bodies.get(handle));
        body.map_or(Vector::ZERO, RigidBody::linvel)
    };
    let [a, b] = pair;
    let (va, vb) = (velocity(a), velocity(b));
    let relative = scalar::vector(va) - scalar::vector(vb);
    if relative.norm() <= limit {
        return false;
    }
    let options = ShapeCastOptions {
        stop_at_penetration: false,
        ..ShapeCastOptions::with_max_time_of_impact(scalar::narrow(dt))
    };
    let (place_a, place_b) = (a.position(), b.position());
    let hit = cast_shapes(place_a, va, a.shape(), place_b, vb, b.shape(), options);
    hit.ok().flatten().is_some_and(|hit| {
        let normal = scalar::vector(place_a.rotation * hit.normal1);
        hit.time_of_impact > scalar::narrow(0.0) && relative.dot(&normal) > limit
    })
}

/// Would Rapier solve a contact between the two?
pub(crate) fn interact(a: &Collider, b: &Collider) -> bool {
    a.is_enabled()
        && !a.is_sensor()
        && a.collision_groups().test(b.collision_groups())
        && a.solver_groups().test(b.solver_groups())
}

/// The box within which a collider that now fills `standing` stays over the step, as long as its
/// body meets nothing.
fn swept(body: &RigidBody, standing: &Extent, world: &WorldView<'_>, dt: f64) -> Extent {
    let centre = scalar::vector(body.center_of_mass());
    let arm = (standing.low.coords - centre).abs().sup(&(standing.high.coords - centre).abs());
    let turn = |angle: f64| arm.norm() * angle.min(2.0);
    let angle = scalar::vector(body.angvel()).norm() * dt;
    let velocity = scalar::vector(body.linvel());
    if body.is_kinematic() {
        let step = scalar::pose(body.position()).inverse() * scalar::pose(body.next_position());
        let set = step.translation.vector.norm() + turn(step.rotation.angle());
        return standing.grown(set.max(velocity.norm() * dt + turn(angle)));
    }
    let mass = scalar::wide(body.mass()).max(f64::MIN_POSITIVE);
    let pull = scalar::vector(world.gravity) * scalar::wide(body.gravity_scale())
        + scalar::vector(body.user_force()) / mass;
    let path = Extent::of_path(&Point3::origin(), &velocity, &pull, dt);
    let low = standing.low + path.low.coords;
    let high = standing.high + path.high.coords;
    Extent { low, high }.grown(turn(angle))
}

pub(crate) fn extent(aabb: &Aabb) -> Extent {
    Extent { low: scalar::vector(aabb.mins).into(), high: scalar::vector(aabb.maxs).into() }
}

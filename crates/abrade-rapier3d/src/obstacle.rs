//! Everything solid that is no wear surface, as it may stand in a body's way over a step.
//! Collected only when a body comes near a wear surface.

use std::collections::BTreeMap;

use nalgebra::{Isometry3, Point3};
use rapier::dynamics::{RigidBody, RigidBodyHandle};
use rapier::geometry::{Aabb, Collider, ColliderHandle, ColliderSet};
use rapier::math::Pose;
use rapier::parry::query::intersection_test;
use rapier::parry::shape::{Cuboid, Shape};

use crate::bins::Bins;
use crate::path::Extent;
use crate::scalar;
use crate::track::Track;
use crate::view::WorldView;

/// A collider, and where it is over the step.
struct Obstacle {
    collider: ColliderHandle,
    body: Option<RigidBodyHandle>,
    /// Box around all of it.
    extent: Extent,
    /// Where it is slice by slice, by its place among the tracks, if it moves.
    track: Option<usize>,
}

/// The colliders of a step that bodies may run into.
#[derive(Default)]
pub(crate) struct Obstacles {
    list: Vec<Obstacle>,
    tracks: Vec<Track>,
    bins: Bins,
    /// The places in the list of bodies that may be given another track.
    of_body: BTreeMap<(u32, u32), Vec<u32>>,
}

impl Obstacles {
    /// Forgets the last step's.
    pub fn clear(&mut self) {
        self.list.clear();
        self.tracks.clear();
        self.of_body.clear();
    }

    /// Collects the solid colliders of a step, `is_proxy` ones apart.
    /// `course` gives the track of bodies that are themselves on their way to a wear surface.
    pub fn collect<'a>(
        &mut self,
        world: &WorldView<'_>,
        dt: f64,
        is_proxy: impl Fn(ColliderHandle) -> bool,
        course: impl Fn(RigidBodyHandle) -> Option<&'a Track>,
    ) {
        let mut region: Option<Extent> = None;
        for (handle, collider) in world.colliders.iter_enabled() {
            if collider.is_sensor() || is_proxy(handle) {
                continue;
            }
            let body = collider.parent();
            let own_course = body.and_then(&course);
            let (track, extent) = match own_course.and_then(|track| Some((track, track.whole()?))) {
                Some((track, whole)) => {
                    region = Some(region.map_or(whole, |region| region.joined(&whole)));
                    (Some(track.clone()), whole)
                }
                None => {
                    let standing = extent(&collider.compute_aabb());
                    let parent = body.and_then(|handle| world.bodies.get(handle));
                    let track = parent.and_then(|rb| swept(rb, &standing, world, dt));
                    let whole = track.as_ref().and_then(Track::whole).unwrap_or(standing);
                    (track, whole)
                }
            };
            if let (Some(body), true) = (body, own_course.is_some()) {
                let places = self.of_body.entry(body.into_raw_parts()).or_default();
                places.push(self.list.len() as u32);
            }
            let track = track.map(|track| {
                self.tracks.push(track);
                self.tracks.len() - 1
            });
            self.list.push(Obstacle { collider: handle, body, extent, track });
        }
        if let Some(region) = region {
            self.bins.lay(&region, self.list.len());
        }
        for (place, obstacle) in self.list.iter().enumerate() {
            self.bins.insert(&obstacle.extent, place as u32);
        }
    }

    /// Puts the track on which a body really was in place of the one it might have.
    pub fn settle(&mut self, body: RigidBodyHandle, track: &Track) {
        let Some(whole) = track.whole() else { return };
        for &place in self.of_body.get(&body.into_raw_parts()).into_iter().flatten() {
            let obstacle = &mut self.list[place as usize];
            obstacle.extent = whole;
            if let Some(own) = obstacle.track {
                self.tracks[own].clone_from(track);
            }
            self.bins.insert(&whole, place);
        }
    }

    /// Takes a body that is left to Rapier for being anywhere on its course all the time.
    pub fn blur(&mut self, body: RigidBodyHandle) {
        let places = self.of_body.get(&body.into_raw_parts());
        if let Some(&place) = places.and_then(|places| places.first()) {
            self.settle(body, &Track::still(self.list[place as usize].extent));
        }
    }

    /// Forgets when anything is where: the step has become shorter than its slices were for.
    pub fn forget_times(&mut self) {
        for track in &mut self.tracks {
            *track = track.whole().map_or_else(Track::nowhere, Track::still);
        }
    }

    /// A collider that `body` could run into on `track`, given in `frame`.
    pub fn in_way(
        &self,
        body: RigidBodyHandle,
        own: &[ColliderHandle],
        track: &Track,
        frame: &Isometry3<f64>,
        colliders: &ColliderSet,
    ) -> Option<ColliderHandle> {
        let world_box = track.whole()?.placed_by(frame);
        let near = self.bins.find(&world_box).map(|place| &self.list[place as usize]);
        let near = near.filter(|o| o.body != Some(body) && o.extent.meets(&world_box));
        let mut solid = near.filter(|o| {
            colliders.get(o.collider).is_some_and(|other| {
                let mut own = own.iter().filter_map(|&handle| colliders.get(handle));
                own.any(|mine| interact(mine, other)) && self.meets(o, track, frame, other)
            })
        });
        solid.next().map(|o| o.collider)
    }

    /// Does a body on `track` in `frame` touch the obstacle's collider itself, or in the same
    /// slice of time the box it is in if it moves?
    fn meets(
        &self,
        obstacle: &Obstacle,
        track: &Track,
        frame: &Isometry3<f64>,
        collider: &Collider,
    ) -> bool {
        let Some(own) = obstacle.track else {
            let mut regions = track.slices().iter().flatten();
            return regions.any(|region| {
                obstacle.extent.meets(&region.placed_by(frame))
                    && touches(region, frame, collider.position(), collider.shape())
            });
        };
        let mut pairs = track.slices().iter().zip(self.tracks[own].slices());
        pairs.any(|pair| {
            let (Some(region), Some(other)) = pair else { return false };
            let (pose, cuboid) = cuboid(other, &Isometry3::identity());
            other.meets(&region.placed_by(frame)) && touches(region, frame, &pose, &cuboid)
        })
    }
}

/// Does the box `region` in `frame` touch the shape? Shapes that Rapier cannot test do.
fn touches(region: &Extent, frame: &Isometry3<f64>, pose: &Pose, shape: &dyn Shape) -> bool {
    let (own_pose, own) = cuboid(region, frame);
    intersection_test(&own_pose, &own, pose, shape).map_or(true, |found| found.intersecting)
}

fn cuboid(region: &Extent, frame: &Isometry3<f64>) -> (Pose, Cuboid) {
    let centre = Isometry3::from(nalgebra::center(&region.low, &region.high));
    (scalar::to_pose(&(frame * centre)), Cuboid::new(scalar::to_vector(&region.half())))
}

/// Would Rapier solve a contact between the two?
pub(crate) fn interact(a: &Collider, b: &Collider) -> bool {
    a.is_enabled()
        && !a.is_sensor()
        && a.collision_groups().test(b.collision_groups())
        && a.solver_groups().test(b.solver_groups())
}

/// Where a collider that now fills `standing` is over the step, as long as its body meets
/// nothing; none for one that does not move.
fn swept(body: &RigidBody, standing: &Extent, world: &WorldView<'_>, dt: f64) -> Option<Track> {
    if !(body.is_dynamic() && !body.is_sleeping() || body.is_kinematic()) {
        return None;
    }
    let centre = scalar::vector(body.center_of_mass());
    let arm = (standing.low.coords - centre).abs().sup(&(standing.high.coords - centre).abs());
    let turn = |angle: f64| arm.norm() * angle.min(2.0);
    let angle = scalar::vector(body.angvel()).norm() * dt;
    let velocity = scalar::vector(body.linvel());
    if body.is_kinematic() {
        let step = scalar::pose(body.position()).inverse() * scalar::pose(body.next_position());
        let set = step.translation.vector.norm() + turn(step.rotation.angle());
        let grown = standing.grown(set.max(velocity.norm() * dt + turn(angle)));
        return Some(Track::still(grown));
    }
    let mass = scalar::wide(body.mass()).max(f64::MIN_POSITIVE);
    let pull = scalar::vector(world.gravity) * scalar::wide(body.gravity_scale())
        + scalar::vector(body.user_force()) / mass;
    Some(Track::over(dt, |from, to| {
        let path = Extent::of_part(&Point3::origin(), &velocity, &pull, [from, to]);
        let (low, high) = (standing.low + path.low.coords, standing.high + path.high.coords);
        Some(Extent { low, high }.grown(turn(angle)))
    }))
}

pub(crate) fn extent(aabb: &Aabb) -> Extent {
    Extent { low: scalar::vector(aabb.mins).into(), high: scalar::vector(aabb.maxs).into() }
}

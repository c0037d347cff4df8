//! Everything solid that is no wear surface, as it may stand in a body's way over a step.
//! Collected only when a body comes near a wear surface.

use std::collections::BTreeMap;

use nalgebra::{Isometry3, Point3, Vector3};
use rapier::dynamics::{RigidBody, RigidBodyHandle};
use rapier::geometry::{Aabb, Collider, ColliderHandle, ColliderSet};
use rapier::math::Pose;
use rapier::parry::query::intersection_test;
use rapier::parry::shape::{Cuboid, Shape};

use crate::bins::Bins;
use crate::extent::Extent;
use crate::pull::pull;
use crate::query_collider::is_of_queries;
use crate::scalar;
use crate::track::{SLICES, Track};
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

/// What is asked of the obstacles: which collider could `own` ones run into?
pub(crate) struct Search<'a> {
    /// Bodies whose colliders do not count.
    pub bodies: &'a [RigidBodyHandle],
    pub own: &'a [ColliderHandle],
    /// Where they may be over the step, in `frame`.
    pub track: &'a Track,
    pub frame: &'a Isometry3<f64>,
    pub colliders: &'a ColliderSet,
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

    /// Collects the solid colliders of a step that come into `reach`, `is_proxy` ones apart.
    /// `course` gives the track of bodies that are themselves on their way to a wear surface.
    pub fn collect<'a>(
        &mut self,
        world: &WorldView<'_>,
        dt: f64,
        reach: &Extent,
        is_proxy: impl Fn(ColliderHandle) -> bool,
        course: impl Fn(RigidBodyHandle) -> Option<&'a Track>,
    ) {
        for (handle, collider) in world.colliders.iter_enabled() {
            if collider.is_sensor() || is_of_queries(collider) || is_proxy(handle) {
                continue;
            }
            let body = collider.parent();
            let own_course = body.and_then(&course);
            let (track, extent) = match own_course.and_then(|track| Some((track, track.whole()?))) {
                Some((track, whole)) => (Some(track.clone()), whole),
                None => {
                    let standing = extent(&collider.compute_aabb());
                    let parent = body.and_then(|handle| world.bodies.get(handle));
                    match parent.and_then(|rb| Sweep::of(rb, standing, world, dt)) {
                        // Most bodies of a crowd are far: they need no track.
                        Some(sweep) if !sweep.part([0.0, dt]).meets(reach) => continue,
                        Some(sweep) => {
                            let track = Track::over(dt, |from, to| Some(sweep.part([from, to])));
                            (Some(track), sweep.part([0.0, dt]))
                        }
                        None => (None, standing),
                    }
                }
            };
            if !extent.meets(reach) {
                continue;
            }
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
        self.bins.lay(reach, SLICES, self.list.len());
        for place in 0..self.list.len() {
            self.sort_in(place);
        }
    }

    fn sort_in(&mut self, place: usize) {
        let obstacle = &self.list[place];
        for number in 0..SLICES {
            let extent = match obstacle.track {
                Some(track) => self.tracks[track].slices()[number],
                None => Some(obstacle.extent),
            };
            if let Some(extent) = extent {
                self.bins.insert(number, &extent, place as u32);
            }
        }
    }

    /// Puts the track on which a body really was in place of the one it might have.
    pub fn settle(&mut self, body: RigidBodyHandle, track: &Track) {
        let Some(whole) = track.whole() else { return };
        let places = self.of_body.get(&body.into_raw_parts()).cloned().unwrap_or_default();
        for place in places.into_iter().map(|place| place as usize) {
            let obstacle = &mut self.list[place];
            obstacle.extent = whole;
            if let Some(own) = obstacle.track {
                self.tracks[own].clone_from(track);
            }
            self.sort_in(place);
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
        for place in 0..self.list.len() {
            self.sort_in(place);
        }
    }

    /// True for a candidate that no other collider could meet in this step.
    pub fn is_alone(&self, body: RigidBodyHandle) -> bool {
        let own = self.of_body.get(&body.into_raw_parts());
        let own = own.map_or(&[][..], Vec::as_slice).iter().map(|&at| &self.list[at as usize]);
        let meets = |own: &Obstacle| {
            let others = self.list.iter().filter(|o| o.body != Some(body));
            others.into_iter().any(|other| other.extent.meets(&own.extent))
        };
        !own.into_iter().any(meets)
    }

    /// A collider that is in the way.
    pub fn in_way(&self, search: &Search<'_>) -> Option<ColliderHandle> {
        let mut first = None;
        self.visit(search, |found| {
            first = Some(found);
            false
        });
        first
    }

    /// All of them, in the order of their handles.
    pub fn all_in_way(&self, search: &Search<'_>) -> Vec<ColliderHandle> {
        let mut all = Vec::new();
        self.visit(search, |found| {
            all.push(found);
            true
        });
        all.sort_unstable_by_key(|handle| handle.into_raw_parts());
        all.dedup();
        all
    }

    /// Shows them, slice of time by slice, for as long as `go_on` says so.
    fn visit(&self, search: &Search<'_>, mut go_on: impl FnMut(ColliderHandle) -> bool) {
        let Search { bodies, own, track, frame, colliders } = *search;
        let regions = track.slices().iter().enumerate();
        for (number, region) in regions.filter_map(|(i, region)| Some((i, region.as_ref()?))) {
            let world_box = region.placed_by(frame);
            for place in self.bins.find(number, &world_box) {
                let o = &self.list[place as usize];
                let other = o.body.is_none_or(|body| !bodies.contains(&body));
                let Some(collider) = colliders.get(o.collider).filter(|_| other) else { continue };
                let mut own = own.iter().filter_map(|&handle| colliders.get(handle));
                let meets = o.extent.meets(&world_box)
                    && own.any(|mine| interact(mine, collider))
                    && self.meets(o, number, (region, &world_box), frame, collider);
                if meets && !go_on(o.collider) {
                    return;
                }
            }
        }
    }

    /// Does `region` in `frame`, inside the box of the world, touch the obstacle's collider
    /// itself, or the box it is in over the slice of time if it moves?
    fn meets(
        &self,
        obstacle: &Obstacle,
        slice: usize,
        (region, world_box): (&Extent, &Extent),
        frame: &Isometry3<f64>,
        collider: &Collider,
    ) -> bool {
        let Some(own) = obstacle.track else {
            return touches(region, frame, collider.position(), collider.shape());
        };
        self.tracks[own].slices()[slice].is_some_and(|other| {
            let (pose, cuboid) = cuboid(&other, &Isometry3::identity());
            other.meets(world_box) && touches(region, frame, &pose, &cuboid)
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
    [a, b].iter().all(|collider| collider.is_enabled() && !collider.is_sensor())
        && a.collision_groups().test(b.collision_groups())
        && a.solver_groups().test(b.solver_groups())
}

/// A collider on its way over the step, as long as its body meets nothing.
pub(crate) struct Sweep {
    /// The box that it fills at the start, grown by what turns may add.
    start: Extent,
    velocity: Vector3<f64>,
    pull: Vector3<f64>,
}

impl Sweep {
    /// Of a collider that now fills `standing`; none if it does not move.
    pub fn of(body: &RigidBody, standing: Extent, world: &WorldView<'_>, dt: f64) -> Option<Self> {
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
            let start = standing.grown(set.max(velocity.norm() * dt + turn(angle)));
            return Some(Self { start, velocity: Vector3::zeros(), pull: Vector3::zeros() });
        }
        // What is in the way goes as Rapier takes it.
        let pull = pull(body, None, &scalar::vector(world.gravity));
        Some(Self { start: standing.grown(turn(angle)), velocity, pull })
    }

    /// The box within which it stays from one time to another [s].
    pub fn part(&self, times: [f64; 2]) -> Extent {
        let path = Extent::of_part(&Point3::origin(), &self.velocity, &self.pull, times);
        let (low, high) = (path.low.coords, path.high.coords);
        Extent { low: self.start.low + low, high: self.start.high + high }
    }
}

pub(crate) fn extent(aabb: &Aabb) -> Extent {
    Extent { low: scalar::vector(aabb.mins).into(), high: scalar::vector(aabb.maxs).into() }
}

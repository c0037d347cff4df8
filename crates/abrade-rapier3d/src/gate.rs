//! Which bodies come near a wear surface, and which of them may be carried through the step on
//! their own: Micro without this gate is catastrophic, because nothing else pushes back.

use abrade::{Loads, State};
use nalgebra::{Isometry3, Point3, Vector3};
use rapier::dynamics::{LockedAxes, RigidBody, RigidBodyHandle, RigidBodyType};
use rapier::geometry::{Collider, ColliderSet};

use crate::event::Refusal;
use crate::extent::Extent;
use crate::free::Free;
use crate::obstacle::{Obstacles, Search, interact};
use crate::pull::pull;
use crate::surface::{SurfaceId, WornCollider};
use crate::track::Track;
use crate::tracked::Tracked;
use crate::view::WorldView;
use crate::{derive, scalar, shadow};

/// Share of its radius by which a body is taken for larger than it is.
const MARGIN: f64 = 1e-3;
/// Roundings of its place by which a surface must move in a step to count as moving.
const ROUNDINGS: f64 = 8.0;

/// A surface where it lies in this step.
pub(crate) struct Lie {
    pub id: SurfaceId,
    /// Its frame in the world, at the beginning of the step.
    pub pose: Isometry3<f64>,
    /// Box around its nodes in the step, in the world.
    pub extent: Extent,
    /// What leads it, if it moves in the step.
    pub lead: Option<Lead>,
}

/// The motion of a surface that a kinematic or a dynamic body takes along.
#[derive(Clone, Copy)]
pub(crate) struct Lead {
    /// That of the body, in the world.
    pub state: State,
    /// The body, if it is dynamic, and what acts on it beside the contact, in the world.
    pub free: Option<Free>,
    pub loads: Loads,
    /// Bound of the speed of a node [m/s].
    pub speed: f64,
    /// It moves by itself: what sleeps in its way must be woken.
    pub awake: bool,
}

impl Lie {
    /// True when something leads it through the step.
    pub fn moves(&self) -> bool {
        self.lead.is_some()
    }

    /// Where the surface `id` lies, unless its proxy is gone.
    pub fn find(lies: &[Self], id: SurfaceId) -> Option<&Self> {
        lies.iter().find(|lie| lie.id == id)
    }
}

/// Where the surfaces lie; those whose proxy is gone, disabled or a sensor are left out.
pub(crate) fn lie(
    surfaces: &[WornCollider],
    world: &WorldView<'_>,
    tracked: &[Option<Tracked>],
    [dt, sight]: [f64; 2],
    lies: &mut Vec<Lie>,
) {
    lies.clear();
    for (id, worn) in surfaces.iter().enumerate() {
        let Some(proxy) = worn.live_proxy(world.colliders) else { continue };
        let mut pose = worn.pose(proxy);
        let extent = worn.bounds.grown(worn.inflation).placed_by(&pose);
        let lead = lead(proxy, world, tracked, &extent, dt);
        if let Some(Lead { state, free: Some(free), .. }) = &lead
            && let Some(rb) = world.bodies.get(free.body)
        {
            pose = carried_pose(state, rb, proxy) * worn.offset;
        }
        let extent = extent.grown(lead.map_or(0.0, |lead| lead.speed * sight));
        lies.push(Lie { id: SurfaceId(id), pose, extent, lead });
    }
}

/// Pose of the collider `proxy` of a body that is exactly in `state`.
fn carried_pose(state: &State, rb: &RigidBody, proxy: &Collider) -> Isometry3<f64> {
    let origin = Isometry3::from(-scalar::vector(rb.local_center_of_mass()));
    let place = proxy.position_wrt_parent().map_or_else(Isometry3::identity, scalar::pose);
    state.pose() * origin * place
}

/// How the body of `proxy`, whose nodes lie in `extent`, moves over `dt` [s].
fn lead(
    proxy: &Collider,
    world: &WorldView<'_>,
    tracked: &[Option<Tracked>],
    extent: &Extent,
    dt: f64,
) -> Option<Lead> {
    let handle = proxy.parent()?;
    let rb = world.bodies.get(handle)?;
    let mut state = shadow::held(rb);
    let (mut free, mut loads) = (None, Loads::default());
    let mut gain = 0.0;
    if rb.is_dynamic() {
        let gravity = scalar::vector(world.gravity);
        let tracked = Tracked::find(tracked, handle);
        let registered = tracked.and_then(Tracked::registered).map(|body| body.inertia);
        state = tracked.map_or(state, |tracked| tracked.state(rb));
        // A body without a mass goes on as it moves.
        if let Some(inertia) = registered.or_else(|| derive::inertia(rb).ok()) {
            free = Some(Free { body: handle, inertia });
            loads = self::loads(rb, &gravity, &Isometry3::identity());
            gain = (loads.gravity.norm() + loads.force.norm() / inertia.mass) * dt;
        }
    } else if !rb.is_kinematic() {
        return None;
    }
    if rb.is_kinematic() {
        state = led(rb, state, dt);
    }
    let reach = (nalgebra::center(&extent.low, &extent.high) - state.position).norm()
        + extent.half().norm();
    let speed = state.velocity.norm() + state.spin.norm() * reach + gain;
    let moves = moves(speed * dt, state.position.coords.norm() + reach);
    let awake = !rb.is_sleeping() && moves;
    (free.is_some() || moves).then_some(Lead { state, free, loads, speed, awake })
}

/// True for a `way` [m] of something that reaches as far as `place` [m] from the origin: what moves by
/// less than its place is rounded by stands still.
pub(crate) fn moves(way: f64, place: f64) -> bool {
    way > ROUNDINGS * scalar::ROUNDING * place
}

/// The motion over `dt` [s] of a kinematic body that is in `state`: by its velocity, or to its next
/// position.
pub(crate) fn led(rb: &RigidBody, state: State, dt: f64) -> State {
    let (mut velocity, mut spin) = (scalar::vector(rb.linvel()), scalar::vector(rb.angvel()));
    if rb.body_type() == RigidBodyType::KinematicPositionBased {
        let to = scalar::pose(rb.next_position());
        let com = Point3::from(scalar::vector(rb.local_center_of_mass()));
        velocity = (to * com - state.position) / dt;
        spin = (to.rotation * state.rotation.inverse()).scaled_axis() / dt;
    }
    State { velocity, spin, ..state }
}

/// The plane below which a body has met the surface for certain: only flat ones at rest have one.
pub(crate) fn floor(lie: &Lie, worn: &WornCollider) -> Extent {
    match worn.surface.is_flat() && lie.lead.is_none() {
        true => worn.bounds,
        false => Extent::NO_FLOOR,
    }
}

/// True for a surface on which Rapier can hold a body and the resolvers beside Micro know their
/// way: flat, and at rest.
pub(crate) fn can_hold(lies: &[Lie], surfaces: &[WornCollider], id: SurfaceId) -> bool {
    let still = Lie::find(lies, id).is_none_or(|lie| lie.lead.is_none());
    still && surfaces[id.0].surface.is_flat()
}

/// Bound of the speed of the surfaces `ids` [m/s].
pub(crate) fn top_speed(lies: &[Lie], ids: &[SurfaceId]) -> f64 {
    let leads = ids.iter().filter_map(|id| Lie::find(lies, *id)?.lead);
    leads.map(|lead| lead.speed).fold(0.0, f64::max)
}

/// A body's path over a step, before any contact.
#[derive(Clone, Copy)]
pub(crate) struct Course {
    pub state: State,
    /// Acceleration by gravity and forces [m/s2].
    pub acceleration: Vector3<f64>,
    /// Radius with its margin [m].
    radius: f64,
    /// Bound of the speed of the surfaces that it may meet [m/s].
    pub surfaces_speed: f64,
}

impl Course {
    /// The course of `rb` in the world.
    pub fn of(rb: &RigidBody, tracked: &Tracked, gravity: &Vector3<f64>) -> Self {
        let state = tracked.state(rb);
        let acceleration = pull(rb, Some(tracked), gravity);
        let rounding = scalar::ROUNDING * state.position.coords.norm();
        let radius = tracked.radius * (1.0 + MARGIN) + rounding;
        Self { state, acceleration, radius, surfaces_speed: 0.0 }
    }

    /// Radius with its margin [m].
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The course of a point at rest where `state` is.
    pub fn still(state: &State) -> Self {
        Self::from_state(State::at(state.position), Vector3::zeros(), 0.0)
    }

    /// The course of a body of `radius` [m] from `state`, in the world.
    pub fn from_state(state: State, acceleration: Vector3<f64>, radius: f64) -> Self {
        Self { state, acceleration, radius: radius * (1.0 + MARGIN), surfaces_speed: 0.0 }
    }

    fn seen_from(&self, frame: &Isometry3<f64>) -> Self {
        let acceleration = frame.inverse_transform_vector(&self.acceleration);
        Self { state: self.state.seen_from(frame), acceleration, ..*self }
    }

    /// Box around the body from one time to another [s].
    fn part(&self, times: [f64; 2]) -> Extent {
        let State { position, velocity, .. } = &self.state;
        Extent::of_part(position, velocity, &self.acceleration, times).grown(self.radius)
    }

    /// The track of the body over `dt` [s] in the frame of a surface with the given bounds, as
    /// far as it can get before it must have met the surface: no centre of mass gets below its
    /// lowest plane. A body that may go over the surface's border is followed to the end.
    pub fn track_before(&self, frame: &Isometry3<f64>, bounds: &Extent, dt: f64) -> Track {
        let local = self.seen_from(frame);
        let fall = local.time_to_fall(bounds).min(dt);
        match local.part([0.0, fall]).is_over(bounds) {
            true => Track::over(dt, |from, to| {
                let part = || local.part([from, to.min(fall)]).above(bounds.low.z);
                (from <= fall).then(part)
            }),
            false => Track::over(dt, |from, to| Some(local.part([from, to]))),
        }
    }

    /// Box around [`Course::track_before`].
    fn region_before(&self, frame: &Isometry3<f64>, bounds: &Extent, dt: f64) -> Extent {
        let local = self.seen_from(frame);
        let cut = local.part([0.0, local.time_to_fall(bounds).min(dt)]);
        match cut.is_over(bounds) {
            true => cut.above(bounds.low.z),
            false => local.part([0.0, dt]),
        }
    }

    /// Time after which the centre of mass is at the lowest plane of the bounds [s].
    fn time_to_fall(&self, bounds: &Extent) -> f64 {
        let State { position, velocity, .. } = &self.state;
        time_to_fall(position.z - bounds.low.z, velocity.z, self.acceleration.z)
    }

    /// Box around wherever the body may be flung over `dt` [s], in `frame`: no contact with a
    /// surface makes it faster, as the surface sees it, than its energy allows.
    pub fn reach(&self, frame: &Isometry3<f64>, dt: f64) -> Extent {
        let spin = self.state.spin.norm() * self.radius;
        let own = self.state.velocity.norm() + self.surfaces_speed;
        let speed = own.hypot(spin) + self.surfaces_speed + self.acceleration.norm() * dt;
        let centre = frame.inverse_transform_point(&self.state.position);
        Extent { low: centre, high: centre }.grown(self.radius + speed * dt)
    }

    /// The surfaces that the body comes near in `sight` [s], or that Rapier, which makes contacts over
    /// gaps of `contacts` [m], may take it to come near.
    pub fn near(
        &self,
        lies: &[Lie],
        surfaces: &[WornCollider],
        [sight, contacts]: [f64; 2],
        near: &mut Vec<SurfaceId>,
    ) {
        near.clear();
        let world = self.part([0.0, sight]).grown(contacts);
        for lie in lies.iter().filter(|lie| lie.extent.meets(&world)) {
            let worn = &surfaces[lie.id.0];
            let moved = lie.lead.map_or(0.0, |lead| lead.speed * sight);
            let bounds = worn.bounds.grown(worn.inflation + moved);
            let local = self.seen_from(&lie.pose);
            let region = local.part([0.0, sight]);
            if region.meets(&bounds) || local.comes_askew(&bounds, [sight, contacts]) {
                near.push(lie.id);
            }
        }
    }

    /// True for a body that comes in over an edge of `bounds`. To Rapier its contact is a plane that
    /// stands askew there, through which it may come although it passes by.
    fn comes_askew(&self, bounds: &Extent, [sight, contacts]: [f64; 2]) -> bool {
        let State { position, velocity, .. } = &self.state;
        let off = position - position.sup(&bounds.low).inf(&bounds.high);
        let is_over_an_edge = off.iter().filter(|apart| **apart != 0.0).count() > 1;
        let way = velocity.norm() * sight + 0.5 * self.acceleration.norm() * sight * sight;
        let gap = off.norm() - self.radius;
        is_over_an_edge && gap <= way.min(contacts) && velocity.dot(&off) < 0.0
    }
}

/// Whether anything else lies in a body's way.
pub(crate) struct Way<'a> {
    pub body: RigidBodyHandle,
    pub rb: &'a RigidBody,
    pub colliders: &'a ColliderSet,
    pub obstacles: &'a Obstacles,
    /// The frame in which the body is carried, and the floor of its first surface.
    pub frame: Isometry3<f64>,
    pub bounds: Extent,
}

impl Way<'_> {
    /// The obstacle on the body's `course` over `dt` [s] before it meets the surface, if there
    /// is one.
    pub fn on_course(&self, course: &Course, dt: f64) -> Option<Refusal> {
        self.on(&course.track_before(&self.frame, &self.bounds, dt))
    }

    /// The obstacle on the body's `course` for `time` [s] from when it `began` [s], in a step of
    /// `dt` [s].
    pub fn ahead(&self, course: &Course, time: f64, began: f64, dt: f64) -> Option<Refusal> {
        let region = course.region_before(&self.frame, &self.bounds, time);
        self.on(&Track::during([began, began + time], dt, region))
    }

    /// The obstacle that the body could reach in `dt` [s] whatever the contact does to it.
    pub fn in_reach(&self, course: &Course, dt: f64) -> Option<Refusal> {
        let reach = course.reach(&self.frame, dt);
        self.on(&self.over(&Track::still(reach)))
    }

    /// The obstacle on the track of a body that has been there.
    pub fn on_track(&self, track: &Track) -> Option<Refusal> {
        self.on(&self.over(track))
    }

    /// The track without what lies below the surface, and so behind it.
    fn over(&self, track: &Track) -> Track {
        match track.whole().is_some_and(|whole| whole.is_over(&self.bounds)) {
            true => track.map(|extent| extent.above(self.bounds.low.z)),
            false => track.clone(),
        }
    }

    fn on(&self, track: &Track) -> Option<Refusal> {
        let (bodies, own) = (&[self.body][..], self.rb.colliders());
        let (frame, colliders) = (&self.frame, self.colliders);
        let found = self.obstacles.in_way(&Search { bodies, own, track, frame, colliders });
        found.map(|collider| Refusal::Obstructed { collider })
    }
}

/// Time in which a point at `height` [m] with upward `velocity` [m/s] under the upward
/// acceleration `pull` [m/s2] gets to zero height; infinite if it does not.
fn time_to_fall(height: f64, velocity: f64, pull: f64) -> f64 {
    let root = velocity * velocity - 2.0 * pull * height;
    // The stable form of the first positive root of height + velocity t + pull t^2 / 2.
    let time = if velocity <= 0.0 {
        2.0 * height / (-velocity + root.sqrt())
    } else {
        (-velocity - root.sqrt()) / pull
    };
    if time >= 0.0 { time } else { f64::INFINITY }
}

/// True when Rapier would let the body feel the proxy.
pub(crate) fn feels(rb: &RigidBody, worn: &WornCollider, colliders: &ColliderSet) -> bool {
    if rb.colliders().contains(&worn.proxy) {
        return false;
    }
    let Some(proxy) = colliders.get(worn.proxy) else { return false };
    let mut own = rb.colliders().iter().filter_map(|&handle| colliders.get(handle));
    own.any(|mine| interact(mine, proxy))
}

/// Why a body may not be carried on its own, obstacles apart.
pub(crate) fn bound(
    world: &WorldView<'_>,
    rb: &RigidBody,
    body: RigidBodyHandle,
) -> Option<Refusal> {
    if world.jointed(body) {
        return Some(Refusal::Jointed);
    }
    let locked = rb.locked_axes();
    let rotations = LockedAxes::ROTATION_LOCKED;
    let fine = (locked - rotations).is_empty() && (locked.is_empty() || locked.contains(rotations));
    (!fine).then_some(Refusal::LockedAxes)
}

/// What acts on the body beside the contact, in the frame that `frame` places.
pub(crate) fn loads(rb: &RigidBody, gravity: &Vector3<f64>, frame: &Isometry3<f64>) -> Loads {
    let local = |v: &Vector3<f64>| frame.inverse_transform_vector(v);
    Loads {
        gravity: local(&(gravity * scalar::wide(rb.gravity_scale()))),
        force: local(&scalar::vector(rb.user_force())),
        torque: local(&scalar::vector(rb.user_torque())),
        linear_damping: scalar::wide(rb.linear_damping()),
        angular_damping: scalar::wide(rb.angular_damping()),
    }
}

/// True for bodies that could wear something if something woke them.
pub(crate) fn may_wake(rb: &RigidBody) -> bool {
    rb.is_dynamic() && rb.is_enabled() && rb.is_sleeping() && !rb.is_soft_frame()
}

/// True for bodies that can wear anything: dynamic, enabled, awake, no proxy of a soft body.
pub(crate) fn takes_part(rb: &RigidBody) -> bool {
    rb.is_dynamic() && rb.is_enabled() && !rb.is_sleeping() && !rb.is_soft_frame()
}

//! A dynamic body that wears on what does not: one whose surface is a solid's strikes a fixed
//! collider, the wall, and its own nodes give way.
//!
//! The wall is the striker of the encounter, a body that nothing moves; the body is what carries
//! the surface. It goes through the step in Micro, whatever resolver the world asks for, if nothing else could
//! come near it.

use abrade::{Body, Encounter, Inertia, Ledger, Loads, PhysicsError, State, Until};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use rapier::dynamics::RigidBodyHandle;
use rapier::geometry::{Collider, ColliderHandle};
use rapier::parry::shape::TypedShape;

use crate::booking::Booking;
use crate::event::Refusal;
use crate::extent::Extent;
use crate::free;
use crate::gate::{Course, Lie};
use crate::micro::{self, Volumes};
use crate::obstacle::Search;
use crate::resolver::Resolve;
use crate::surface::{SurfaceId, WornCollider};
use crate::track::Track;
use crate::tracked::Tracked;
use crate::view::WorldView;
use crate::world::{Integrated, WearWorld};
use crate::{derive, scalar, shadow};

/// Reach of the part of a wall that an encounter is made with, in radii of the body.
const PART: f64 = 6.0;

/// A running encounter of a wearing body with a wall.
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Against {
    pub surface: SurfaceId,
    pub encounter: Encounter,
    wall: ColliderHandle,
    /// The part of the wall, in `frame`, and the box of the world that it is a part of.
    striker: Body,
    frame: Isometry3<f64>,
    part: Extent,
}

/// A wearing body in a step.
pub(crate) struct Walker {
    surface: SurfaceId,
    body: RigidBodyHandle,
    /// Box around wherever it may get.
    pub reach: Extent,
    radius: f64,
    pose: Isometry3<f64>,
}

impl Walker {
    /// The part of the world whose walls it may meet for a while.
    fn part(&self) -> Extent {
        self.reach.grown(PART * self.radius)
    }
}

/// What a solid does beside walls.
enum Beside {
    Nothing,
    Wall(ColliderHandle),
    Bound(Refusal),
}

impl WearWorld {
    /// Dynamic bodies, awake, whose only solid collider is the proxy of a closed surface.
    pub(crate) fn walkers(&self, world: &WorldView<'_>) -> Vec<Walker> {
        let dt = self.current.dt;
        let walker = |lie: &Lie| {
            let lead = lie.lead?;
            let free = lead.free?;
            let rb = world.bodies.get(free.body).filter(|rb| !rb.is_sleeping())?;
            let alone = derive::solids(rb, world.colliders, true).count() == 1;
            let closed = !self.surfaces[lie.id.0].surface.is_flat();
            let radius = derive::radius(rb, world.colliders);
            let reach = free::reach(&lead, radius, &Course::still(&lead.state), dt);
            let (surface, body, pose) = (lie.id, free.body, lie.pose);
            (alone && closed).then_some(Walker { surface, body, reach, radius, pose })
        };
        self.lies.iter().filter_map(walker).collect()
    }

    /// Takes dynamic bodies of solids through the step that strike nothing but one wall.
    pub(crate) fn strike_walls(&mut self, walkers: &[Walker], world: &WorldView<'_>) {
        for walker in walkers {
            let (surface, body) = (walker.surface, walker.body);
            match self.beside(walker, world) {
                Beside::Nothing => self.leave_wall(body),
                Beside::Bound(reason) => self.hand_on(body, surface, reason),
                Beside::Wall(wall) => match self.strike_wall(walker, wall, world) {
                    Ok(true) => {}
                    Ok(false) => {
                        self.leave_wall(body);
                        self.refuse(body, surface, Refusal::Shape { collider: wall });
                    }
                    Err(error) => match Refusal::of(&error, self.settings.resolve) {
                        Some(reason) => self.hand_on(body, surface, reason),
                        None => {
                            self.leave_wall(body);
                            self.fail(body, surface, error);
                        }
                    },
                },
            }
        }
    }

    /// Leaves a body to the impulses of its contacts, if the world lets it.
    fn hand_on(&mut self, body: RigidBodyHandle, surface: SurfaceId, reason: Refusal) {
        self.leave_wall(body);
        match self.settings.resolve == Resolve::Auto {
            true => self.crowd(body, [surface], reason),
            false => self.refuse(body, surface, reason),
        }
    }

    /// What the body of `walker` could meet.
    fn beside(&self, walker: &Walker, world: &WorldView<'_>) -> Beside {
        let Walker { body, reach, .. } = walker;
        let taken = self.current.carried.iter().any(|(carried, _)| carried == body)
            || self.candidates.contains(body);
        let Some(rb) = world.bodies.get(*body).filter(|_| !taken) else { return Beside::Nothing };
        let (track, frame) = (&Track::still(*reach), &Isometry3::identity());
        let (bodies, own, colliders) = (&[*body][..], rb.colliders(), &*world.colliders);
        let found = self.obstacles.all_in_way(&Search { bodies, own, track, frame, colliders });
        let fixed = |collider: &ColliderHandle| {
            let parent = world.colliders.get(*collider).and_then(Collider::parent);
            parent.and_then(|handle| world.bodies.get(handle)).is_none_or(|rb| rb.is_fixed())
        };
        // What moves strikes by itself.
        let (walls, others): (Vec<_>, Vec<_>) = found.into_iter().partition(fixed);
        match (&*walls, others.first()) {
            ([], _) => Beside::Nothing,
            _ if world.jointed(*body) => Beside::Bound(Refusal::Jointed),
            _ if !rb.locked_axes().is_empty() => Beside::Bound(Refusal::LockedAxes),
            ([wall], None) => Beside::Wall(*wall),
            ([.., collider], None) | (_, Some(collider)) => {
                Beside::Bound(Refusal::Obstructed { collider: *collider })
            }
        }
    }

    /// Ends the encounter of a body with its wall.
    fn leave_wall(&mut self, body: RigidBodyHandle) {
        let tracked = Tracked::slot(&mut self.bodies, body);
        tracked.end_against(&mut self.surfaces, &mut self.closed, &mut self.events);
    }

    /// Carries a body through the step against a wall; false for a wall of a shape without contact.
    fn strike_wall(
        &mut self,
        walker: &Walker,
        wall: ColliderHandle,
        world: &WorldView<'_>,
    ) -> Result<bool, PhysicsError> {
        let Walker { surface, body, reach, .. } = walker;
        let tracked = Tracked::slot(&mut self.bodies, *body);
        // A body that somebody has moved or pushed has lost the place of its springs.
        let still = world
            .bodies
            .get(*body)
            .is_some_and(|rb| tracked.shadow.is_some_and(|shadow| shadow.holds(rb)));
        let goes_on = tracked
            .against
            .as_ref()
            .is_some_and(|against| still && against.wall == wall && against.surface == *surface);
        if !goes_on {
            self.leave_wall(*body);
            let Some(against) = self.against(walker, wall, world)? else { return Ok(false) };
            Tracked::slot(&mut self.bodies, *body).against = Some(against);
        }
        let tracked = Tracked::slot(&mut self.bodies, *body);
        let Some(against) = &mut tracked.against else { return Ok(false) };
        let frame = against.frame;
        if !against.part.holds(reach) {
            // The body has come to another part of the same faces: its contact goes on.
            let part = walker.part();
            let collider = world.colliders.get(wall);
            let striker = collider.and_then(|collider| striker(collider, &part, &frame));
            let Some(striker) = striker else { return Ok(false) };
            (against.striker, against.part) = (striker, part);
        }
        let seat = micro::seat(*surface, &self.lies, &frame);
        let mut placed = micro::place(&mut self.surfaces, *surface, seat);
        let (loads, dt) = (Loads::default(), self.current.dt);
        let Against { striker, encounter, .. } = against;
        let done = encounter.advance(striker, &mut placed, &loads, dt, Until::Duration, &mut ());
        let end = micro::carrier(&placed);
        let touches = encounter.in_contact();
        let worn = [(*surface, self.surfaces[surface.0].owned().settle().displaced())];
        let advance = done.inspect_err(|_| tracked.book_failed(&worn, &mut self.events))?;
        let (impulse, contact_time) = (frame * -advance.impulse, advance.contact_time);
        tracked.book(&Booking { impulse, contact_time, touches }, &worn, &mut self.events);
        self.counters.add(&advance);
        if let Some(end) = end {
            shadow::check(&end, advance.time)?;
            self.integrated.push(Integrated { body: *body, end, frame });
            self.current.carried.push((*body, *reach));
            self.taken.add_wall(*body, wall);
        }
        Ok(true)
    }

    /// A new encounter of a body with the part of a wall around it.
    fn against(
        &self,
        walker: &Walker,
        wall: ColliderHandle,
        world: &WorldView<'_>,
    ) -> Result<Option<Against>, PhysicsError> {
        let frame = walker.pose;
        let part = walker.part();
        let collider = world.colliders.get(wall);
        let striker = collider.and_then(|collider| striker(collider, &part, &frame));
        let Some(striker) = striker else { return Ok(None) };
        let met = &*self.surfaces[walker.surface.0].surface;
        let encounter = Encounter::new(&striker, [met], self.settings.encounter())?;
        let surface = walker.surface;
        Ok(Some(Against { surface, encounter, wall, striker, frame, part }))
    }
}

/// The part of a wall in the box `part` of the world, as a body in `frame`; boxes and half-spaces
/// are cut to it.
pub(crate) fn striker(collider: &Collider, part: &Extent, frame: &Isometry3<f64>) -> Option<Body> {
    let pose = scalar::pose(collider.position());
    let (shape, place) = match collider.shape().as_typed_shape() {
        TypedShape::HalfSpace(half) => {
            let normal = scalar::vector(half.normal);
            let turn =
                UnitQuaternion::rotation_between(&Vector3::z(), &normal).unwrap_or_else(|| {
                    UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
                });
            let size = 2.0 * part.half().norm();
            let middle = nalgebra::center(&part.low, &part.high);
            let local = pose.inverse_transform_point(&middle);
            let below = local - normal * (local.coords.dot(&normal) + size);
            let place = pose * Isometry3::from_parts(Translation3::from(below.coords), turn);
            (derive::cuboid(&Vector3::repeat(size))?, place)
        }
        TypedShape::Cuboid(cuboid) => {
            let half = scalar::vector(cuboid.half_extents);
            let local = part.placed_by(&pose.inverse());
            let [low, high]: [Vector3<f64>; 2] =
                [(-half).sup(&local.low.coords), half.inf(&local.high.coords)];
            if (0..3).any(|a| low[a] >= high[a]) {
                return None;
            }
            let middle = Translation3::from((low + high) / 2.0);
            (derive::cuboid(&((high - low) / 2.0))?, pose * middle)
        }
        _ => (derive::standing(collider)?, pose),
    };
    let state = State { rotation: place.rotation, ..State::at(place.translation.vector.into()) };
    let state = state.seen_from(frame);
    Some(Body { shape, inertia: Inertia::immovable(), state, rotation_locked: false })
}

impl Against {
    /// Ends the encounter; returns its energies, and the volumes that broke off.
    pub fn end(mut self, surfaces: &mut [WornCollider]) -> (Ledger, Volumes) {
        let broken =
            micro::end(surfaces, &[self.surface], None, |placed| self.encounter.end(placed));
        (*self.encounter.ledger(), broken)
    }
}

#[cfg(feature = "serde-serialize")]
impl Against {
    /// True for a wall in a frame that Rapier's numbers can say.
    pub fn is_sound(&self) -> bool {
        crate::snapshot::is_state(&self.striker.state, &self.frame)
    }
}

//! A collision of two in the core: one of them stands, the other flies at it without turning.

use abrade::{
    Ball, Body, Encounter, EncounterSettings, Inertia, Ledger, Loads, PhysicsError, Piece, Placed,
    Shape, Skin, State, Surface, Until, can_meet,
};
use nalgebra::{Isometry3, Matrix3, Point3, Vector3};
use rapier::geometry::{Collider, ContactPair};

use crate::collision::blow::Blow;
use crate::micro;
use crate::path::Extent;
use crate::surface::{SurfaceId, WornCollider};
use crate::view::WorldView;
use crate::wall;

/// Parts of a pitch that a striker flies between two looks at whether it has touched, and parts of a
/// period of its springs, if that is shorter, between two looks at whether it has parted.
const FLIGHT: f64 = 0.25;
const PERIOD: f64 = 0.25;
/// Pitches beyond where it should have touched at which a striker has missed.
const MISS: f64 = 1.0;
/// Looks after which a collision is given up: a striker that slides on for long.
const LOOKS: u32 = 400;
/// Steps after which a collision is given up: a striker that is wedged in.
const STEPS: u64 = 2000;
/// Steps back of a striker that Rapier has left inside what it strikes.
const LIFTS: usize = 60;
/// Clearance of a striker at its start, in pitches.
const CLEAR: f64 = 0.02;

/// The surface that stands, and what flies at it.
pub(crate) struct Striker {
    stands: SurfaceId,
    /// The surface of the striker's own.
    skin: Option<(SurfaceId, Isometry3<f64>)>,
    body: Body,
    /// Unit normal along which it flies.
    down: Vector3<f64>,
    /// Where Rapier left it.
    left: Point3<f64>,
}

/// What a collision did.
#[derive(Default)]
pub(crate) struct Outcome {
    pub ledger: Ledger,
    pub steps: u64,
    pub node_evaluations: u64,
    pub contact_time: f64,
    /// Volumes displaced [m3].
    pub worn: Vec<(SurfaceId, f64)>,
}

impl Striker {
    /// Who of a pair strikes whom, in the frame of the surface that stands; None where neither has a
    /// shape that can strike. `own` are the places of their surfaces among all.
    pub fn of(
        pair: &ContactPair,
        own: [Option<usize>; 2],
        blow: &Blow,
        surfaces: &[WornCollider],
        world: &WorldView<'_>,
    ) -> Option<Self> {
        let handles = [pair.collider1, pair.collider2];
        let [first, second] = handles.map(|handle| world.colliders.get(handle));
        let colliders = [first?, second?];
        // The first stands where it can.
        [0, 1].into_iter().find_map(|stands| {
            let strikes = 1 - stands;
            let worn = &surfaces[own[stands]?];
            let pose = worn.pose(colliders[stands]);
            let towards = if stands == 0 { -1.0 } else { 1.0 };
            // Where their laws cannot meet, the one that stands wears alone.
            let skin = own[strikes].filter(|&at| can_meet(&surfaces[at].surface, &worn.surface));
            let skin = skin.map(|at| &surfaces[at]);
            let (mut body, skin) = Self::body(colliders[strikes], skin, worn, &pose)?;
            let down = pose.inverse_transform_vector(&(blow.normal * towards));
            let sliding = pose.inverse_transform_vector(&blow.sliding) * -towards;
            let left = body.state.position;
            let back = blow.overlap.max(0.0) + CLEAR * worn.surface.pitch();
            body.state.position -= down * back;
            body.state.velocity = down * blow.speed() + sliding;
            body.inertia = Inertia { mass: blow.mass, tensor: Matrix3::identity() };
            let skin = own[strikes].map(SurfaceId).zip(skin);
            Some(Self { stands: SurfaceId(own[stands]?), skin, body, down, left })
        })
    }

    /// The body of a striking collider, at rest in the frame at `pose` of the surface of `stands`, and
    /// where the surface of its own lies in it.
    fn body(
        collider: &Collider,
        skin: Option<&WornCollider>,
        stands: &WornCollider,
        pose: &Isometry3<f64>,
    ) -> Option<(Body, Option<Isometry3<f64>>)> {
        let Some(skin) = skin.filter(|skin| !skin.surface.is_flat()) else {
            let part = stands.bounds.placed_by(pose).grown(stands.bounds.half().norm());
            return wall::striker(collider, &part, pose).map(|body| (locked(body), None));
        };
        let Extent { low, high } = skin.bounds;
        let centre = nalgebra::center(&low, &high);
        let nodes = skin.surface.nodes();
        let places = (0..nodes.len()).map(|i| nodes.rest_position[i]);
        let radius = places.map(|x| (x - centre).norm()).fold(0.0, f64::max);
        // The ball around it, about whose centre it flies.
        let shape =
            Shape::union(vec![Piece::Ball(Ball { centre: Point3::origin(), radius })]).ok()?;
        let frame = pose.inverse() * skin.pose(collider);
        let state = State { rotation: frame.rotation, ..State::at(frame * centre) };
        let inertia = Inertia::immovable();
        let body = Body { shape, inertia, state, rotation_locked: true };
        Some((body, Some(Isometry3::from(-centre.coords))))
    }

    /// Lets the two collide; the surfaces keep what it did, also before an error.
    pub fn run(
        mut self,
        surfaces: &mut [WornCollider],
        blow: &Blow,
        settings: EncounterSettings,
    ) -> (Outcome, Result<(), PhysicsError>) {
        let mut ids = vec![self.stands];
        ids.extend(self.skin.map(|(id, _)| id));
        let mut outcome = Outcome::default();
        let mut owned = micro::owned(surfaces, &ids);
        let Some(surface) = owned.next() else { return (outcome, Ok(())) };
        let skin = owned.next().zip(self.skin).map(|(surface, (_, pose))| Skin { surface, pose });
        let encounter = match &skin {
            Some(skin) => Encounter::of_two(&self.body, skin, surface, settings),
            None => Encounter::new(&self.body, [&*surface], settings),
        };
        let mut encounter = match encounter {
            Ok(encounter) => encounter,
            Err(error) => return (outcome, Err(error)),
        };
        let (pose, carrier) = (Isometry3::identity(), None);
        let mut placed = [Placed { surface, pose, carrier, skin }];
        lift(&mut encounter, &mut self.body, &self.down, &placed);
        let done = self.fly(&mut encounter, &mut placed, blow, settings.step_limit, &mut outcome);
        encounter.end(&mut placed);
        let [Placed { surface, skin, .. }] = placed;
        let gained = |surface: &mut Surface| surface.settle().displaced();
        outcome.worn.push((self.stands, gained(surface)));
        if let (Some(skin), Some((id, _))) = (skin, self.skin) {
            outcome.worn.push((id, gained(skin.surface)));
        }
        outcome.ledger = *encounter.ledger();
        (outcome, done)
    }

    /// Flies on until the two have parted.
    fn fly(
        &mut self,
        encounter: &mut Encounter,
        placed: &mut [Placed<'_>],
        blow: &Blow,
        step_limit: u64,
        outcome: &mut Outcome,
    ) -> Result<(), PhysicsError> {
        let fly = FLIGHT * placed[0].surface.pitch() / blow.speed();
        // What misses, or is turned aside, would fly on into something else.
        let far = sunk(&placed[0]) + MISS * placed[0].surface.pitch();
        let mut touched = false;
        for _ in 0..LOOKS {
            let time = if touched { fly.min(PERIOD * encounter.period()) } else { fly };
            let (loads, until) = (Loads::default(), Until::FirstExit);
            let done = encounter.advance(&mut self.body, placed, &loads, time, until, &mut ())?;
            outcome.steps += done.steps;
            outcome.node_evaluations += done.node_evaluations;
            outcome.contact_time += done.contact_time;
            touched |= done.contact_time > 0.0;
            let beyond = (self.body.state.position - self.left).dot(&self.down) > far;
            let leaves = touched && self.body.state.velocity.dot(&self.down) <= 0.0;
            let apart = !encounter.in_contact() && (leaves || beyond);
            if done.exited || apart {
                break;
            }
            if outcome.steps > step_limit.min(STEPS) {
                return Err(PhysicsError::TooManySteps { steps: outcome.steps });
            }
        }
        Ok(())
    }
}

/// How much deeper than their colliders two surfaces that meet may lie [m].
fn sunk(placed: &Placed<'_>) -> f64 {
    let skin = placed.skin.as_ref().map_or(0.0, |skin| skin.surface.worn().max_depth);
    placed.surface.worn().max_depth + skin
}

/// Moves a striker back until it is clear of what it strikes.
fn lift(encounter: &mut Encounter, body: &mut Body, down: &Vector3<f64>, placed: &[Placed<'_>]) {
    for _ in 0..LIFTS {
        let depth = encounter.overlap(body, placed);
        if depth == 0.0 {
            break;
        }
        body.state.position -= down * depth;
    }
}

fn locked(body: Body) -> Body {
    Body { rotation_locked: true, ..body }
}

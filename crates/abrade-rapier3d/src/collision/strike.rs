//! A collision of two in the core: one of them stands, the other flies at it without turning.

use abrade::{
    Body, Encounter, EncounterSettings, Inertia, Ledger, Loads, PhysicsError, Placed, State, Until,
};
use nalgebra::{Matrix3, Point3, Vector3};

use crate::collision::blow::Blow;
use crate::collision::two::Two;
use crate::micro::Volumes;
use crate::surface::WornCollider;

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

/// Two of which one flies at the surface that stands.
pub(crate) struct Striker {
    two: Two,
    body: Body,
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
    pub worn: Volumes,
}

impl Striker {
    /// The body of a blow, on its way back from where Rapier has left it after a step of `dt` [s] in
    /// which it had the `drift` [m/s], in the world: above where it was before the step, for which
    /// Rapier found the normal.
    pub fn new(
        two: Two,
        blow: &Blow,
        drift: &Vector3<f64>,
        surfaces: &[WornCollider],
        dt: f64,
    ) -> Self {
        let worn = &surfaces[two.roles.stands.0];
        let Body { shape, state, .. } = two.body.clone();
        let left = state.position;
        let back = blow.back(worn.surface.pitch());
        let sliding = if two.roles.first_stands { blow.sliding } else { -blow.sliding };
        let sliding = two.frame.inverse_transform_vector(&sliding);
        let went = two.frame.inverse_transform_vector(drift) * dt;
        let state = State {
            position: left - two.down * back - went,
            velocity: two.down * blow.speed() + sliding,
            ..state
        };
        let inertia = Inertia { mass: blow.mass, tensor: Matrix3::identity() };
        Self { two, body: Body { shape, inertia, state, rotation_locked: true }, left }
    }

    /// Lets the two collide; the surfaces keep what it did, also before an error.
    pub fn run(
        mut self,
        surfaces: &mut [WornCollider],
        blow: &Blow,
        settings: EncounterSettings,
    ) -> (Outcome, Result<(), PhysicsError>) {
        let mut outcome = Outcome::default();
        let Some(mut placed) = self.two.roles.place(surfaces) else { return (outcome, Ok(())) };
        let [Placed { surface, skin, .. }] = &placed;
        let encounter = match skin {
            Some(skin) => Encounter::of_two(&self.body, skin, surface, settings),
            None => Encounter::new(&self.body, [&**surface], settings),
        };
        let mut encounter = match encounter {
            Ok(encounter) => encounter,
            Err(error) => return (outcome, Err(error)),
        };
        encounter.lift(&mut self.body, &placed, &self.two.down);
        let done = self.fly(&mut encounter, &mut placed, blow, settings.step_limit, &mut outcome);
        encounter.end(&mut placed);
        outcome.worn = self.two.roles.gained(placed);
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
            let period = encounter.period();
            let time = if period > 0.0 { fly.min(PERIOD * period) } else { fly };
            let (loads, until) = (Loads::default(), Until::FirstExit);
            let done = encounter.advance(&mut self.body, placed, &loads, time, until, &mut ())?;
            outcome.steps += done.steps;
            outcome.node_evaluations += done.node_evaluations;
            outcome.contact_time += done.contact_time;
            touched |= done.contact_time > 0.0;
            let beyond = (self.body.state.position - self.left).dot(&self.two.down) > far;
            let leaves = touched && self.body.state.velocity.dot(&self.two.down) <= 0.0;
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

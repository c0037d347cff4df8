//! A case run to its end, watched step by step of the embedder.

use abrade::{Inertia, Ledger, PhysicsError, State, Surface};

use crate::case::{Case, Precision};
use crate::{double, single};

/// Steps of the embedder by the case's own length, and then by [`REST`].
const STEPS: [u32; 2] = [40, 40];
/// Length of later steps [s].
const REST: f64 = 1.0 / 30.0;

/// What a step of the embedder said.
#[derive(Debug, Default)]
pub struct Step {
    pub error: Option<String>,
    pub failed: Option<PhysicsError>,
    pub refused: Option<&'static str>,
    /// Contacts that began.
    pub started: u32,
}

/// A world with one body and one surface.
pub trait World {
    fn step(&mut self, dt: f64) -> Step;
    /// Of the body, in the surface's frame.
    fn state(&self) -> State;
    fn inertia(&self) -> &Inertia;
    fn surface(&self) -> &Surface;
    fn ledger(&self) -> Ledger;
    /// Contact steps so far.
    fn steps(&self) -> u64;
    /// The body is near the surface.
    fn is_near(&self) -> bool;
    /// Body steps that Micro did not resolve.
    fn resolvers(&self) -> Vec<String>;
}

/// How a case ended.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// The body has left the surface.
    Rebounded,
    /// It is on the surface still, or close to it.
    Stays,
    /// It never touched.
    Apart,
    /// It takes more contact steps than a case is given.
    Long,
    /// A typed error.
    Failed(PhysicsError),
    /// Another resolver than Micro has taken it over: by whom, and why.
    HandedOn(String),
    /// A typed reason why nothing was worn.
    Refused(&'static str),
    /// Body or surface cannot be built.
    Unbuilt(String),
}

impl End {
    /// One word, to count by.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Rebounded => "rebounded",
            Self::Stays => "stays",
            Self::Apart => "apart",
            Self::Long => "long",
            Self::HandedOn(reason) => match reason.split(' ').next() {
                Some("Collision") => "Collision",
                Some("Lockstep") => "Lockstep",
                _ => "QuasiStatic",
            },
            Self::Refused(reason) => reason,
            Self::Unbuilt(_) => "unbuilt",
            Self::Failed(error) => match error {
                PhysicsError::Engulfed { .. } => "Engulfed",
                PhysicsError::StartsInside { .. } => "StartsInside",
                PhysicsError::NotFinite { .. } => "NotFinite",
                PhysicsError::StepVanished { .. } => "StepVanished",
                PhysicsError::TooManySteps { .. } => "TooManySteps",
                PhysicsError::Unbalanced { .. } => "Unbalanced",
                PhysicsError::LoadNotReached { .. } => "LoadNotReached",
                PhysicsError::Unsupported { .. } => "Unsupported",
            },
        }
    }

    /// Ended with a result.
    pub fn is_normal(&self) -> bool {
        matches!(self, Self::Rebounded | Self::Stays)
    }
}

/// What there is at the end of a run.
#[derive(Clone, Debug)]
pub struct Record {
    pub end: End,
    /// The middle of the body is over or under the nodes still.
    pub within: bool,
    pub start: State,
    pub last: State,
    pub inertia: Inertia,
    pub ledger: Ledger,
    /// Most that adhesion has given [J].
    pub drawn: f64,
    /// Depth of every node [m].
    pub depths: Vec<f64>,
    pub wear_volume: f64,
    pub worn_normal: f64,
    pub steps: u64,
    /// Contacts that began.
    pub touches: u32,
    /// What was wrong on the way.
    pub broken: Vec<String>,
}

pub fn run(case: &Case) -> Result<Record, End> {
    match case.precision {
        Precision::Single => single::Trial::new(case).map(|mut world| carry(&mut world, case)),
        Precision::Double => double::Trial::new(case).map(|mut world| carry(&mut world, case)),
    }
    .map_err(End::Unbuilt)
}

fn depths(surface: &Surface) -> Vec<f64> {
    (0..surface.nodes().len()).map(|node| surface.depth(node)).collect()
}

fn is_within(surface: &Surface, state: &State) -> bool {
    let [low, high] = surface.bounds();
    (0..2).all(|axis| state.position[axis] > low[axis] && state.position[axis] < high[axis])
}

fn carry(world: &mut dyn World, case: &Case) -> Record {
    let start = world.state();
    let mut broken = Vec::new();
    let mut seen = depths(world.surface());
    let mut renewals = world.surface().renewals();
    let (mut touches, mut last, mut drawn) = (0, start, 0.0f64);
    let mut end = None;
    for number in 0..STEPS[0] + STEPS[1] {
        let dt = if number < STEPS[0] { case.dt } else { REST };
        let step = world.step(dt);
        touches += step.started;
        drawn = drawn.max(-world.ledger().adhesion);
        let now = depths(world.surface());
        let rose = now.iter().zip(&seen).any(|(now, seen)| now < seen);
        if rose && renewals == world.surface().renewals() {
            broken.push(format!("a depth decreased in step {number}"));
        }
        (seen, renewals) = (now, world.surface().renewals());
        if !world.state().is_finite() || seen.iter().any(|depth| !depth.is_finite()) {
            broken.push(format!("a number is not finite in step {number}"));
        }
        // In free flight a spinning body is Rapier's, and as exact as Rapier is.
        if world.is_near() {
            last = world.state();
        }
        end = ended(&step, world, case.means.long, touches > 0);
        if end.is_some() {
            break;
        }
    }
    let end = end.unwrap_or(if touches > 0 { End::Stays } else { End::Apart });
    if let End::HandedOn(_) = end {
        last = world.state();
    }
    let surface = world.surface();
    Record {
        end,
        within: is_within(surface, &last),
        start,
        last,
        inertia: *world.inertia(),
        ledger: world.ledger(),
        drawn,
        depths: seen,
        wear_volume: surface.wear_volume(),
        worn_normal: surface.worn().normal,
        steps: world.steps(),
        touches,
        broken,
    }
}

fn ended(step: &Step, world: &dyn World, long: u64, touched: bool) -> Option<End> {
    if let Some(error) = &step.failed {
        return Some(End::Failed(error.clone()));
    }
    if let Some(reason) = step.refused {
        return Some(End::Refused(reason));
    }
    if touched && let Some(reason) = world.resolvers().into_iter().next() {
        return Some(End::HandedOn(reason));
    }
    if touched && !world.is_near() {
        return Some(End::Rebounded);
    }
    (world.steps() > long).then_some(End::Long)
}

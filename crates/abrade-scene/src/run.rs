//! Running a checked scene: engine, stop rule, recordings, summary.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;

use abrade::{Drive, DriveSolution, PhysicsError, Until};
use abrade_report::{ReportError, Summary, run_files};
use thiserror::Error;

use crate::build::{BuildError, Built};
use crate::check::Checked;
use crate::place;
use crate::run::bodies::Bodies;
use crate::run::engine::Engine;
use crate::run::record::Recorder;
use crate::scene::{Motion, Output, Placement, Solution, Stop};

mod bodies;
mod double;
mod ending;
mod engine;
mod entries;
mod erosion;
mod estimate;
mod extent;
mod fate;
mod files;
mod frames;
mod impacts;
mod record;
mod rim;
mod samples;
mod single;
mod stop;
mod streaming;
mod summary;
mod touch;

/// Precision of the engine; wear itself is always computed in `f64`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// `rapier3d`.
    Single,
    /// `rapier3d-f64`.
    #[default]
    Double,
}

/// How a scene is run.
#[derive(Clone, Debug, PartialEq)]
pub struct RunOptions {
    /// Folder of the results; made if it is missing.
    pub folder: PathBuf,
    /// Precision of the engine.
    pub precision: Precision,
}

/// Sees how far a run is, and may end it.
pub trait Progress {
    /// Called once per step of the engine. `share` is the part done, if the stop rule tells; a
    /// `false` breaks the run off, its results so far are kept.
    fn advance(&mut self, simulated: f64, share: Option<f64>) -> bool;

    /// Called by work of several cases, before the calls that it concerns: `over` of `all` are made.
    fn cases(&mut self, over: usize, all: usize) {
        let _ = (over, all);
    }
}

/// A run that failed.
#[derive(Debug, Error)]
pub enum RunError {
    /// The scene cannot be built.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// A contact left the reach of the model.
    #[error("body `{body}` on surface `{surface}`: {reason}")]
    Physics {
        /// Name of the body.
        body: String,
        /// Name of the surface.
        surface: String,
        /// Why.
        reason: PhysicsError,
    },
    /// The engine refused the scene.
    #[error("the engine refused the scene: {what}")]
    Engine {
        /// Why.
        what: String,
    },
    /// Results could not be written.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// The results' folder cannot be made.
    #[error("the folder `{}` cannot be made: {reason}", folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// Why not.
        reason: std::io::Error,
    },
}

/// What came of a run: the summary, and why it broke off if it did.
#[derive(Debug)]
pub struct Outcome {
    /// The summary, as written.
    pub summary: Summary,
    /// The failure that ended the run early.
    pub failure: Option<RunError>,
    /// True when the caller's progress broke it off.
    pub interrupted: bool,
}

/// Runs `checked`, writes what it asks for into the folder, in the place of what an earlier run left there.
///
/// # Errors
/// The scene cannot be built or its results cannot be written. A failure of the physics is in
/// the outcome, beside the results so far.
pub fn run(
    checked: &Checked,
    options: &RunOptions,
    progress: &mut dyn Progress,
) -> Result<Outcome, RunError> {
    let started = Instant::now();
    let built = checked.build()?;
    std::fs::create_dir_all(&options.folder)
        .map_err(|reason| RunError::Folder { folder: options.folder.clone(), reason })?;
    run_files::begin(&options.folder, &files::names(checked))?;
    let mut bodies = Bodies::new(checked, &built);
    let mut recorder = Recorder::new(checked, &built, &options.folder)?;
    let mut engine = engine(checked, built, options.precision)?;
    recorder.begin(engine.as_ref(), &bodies)?;
    let setup = started.elapsed().as_secs_f64();
    let ended = go(checked, engine.as_mut(), &mut bodies, &mut recorder, progress);
    let (end, failure) = match ended {
        Ok(end) => (end, None),
        Err(RunError::Report(error)) => return Err(error.into()),
        Err(error) => (stop::End::Failed, Some(error)),
    };
    let run = summary::Run {
        checked,
        engine: engine.as_ref(),
        bodies: &bodies,
        precision: options.precision,
        simulated: recorder.time(),
        setup,
        wall: started.elapsed().as_secs_f64(),
        end,
        failure: failure.as_ref(),
        laws: recorder.laws(),
    };
    let summary = summary::summary(&run);
    recorder.finish(engine.as_ref(), &bodies, &summary)?;
    Ok(Outcome { summary, failure, interrupted: end == stop::End::Interrupted })
}

/// Steps until the stop rule holds.
fn go(
    checked: &Checked,
    engine: &mut dyn Engine,
    bodies: &mut Bodies,
    recorder: &mut Recorder,
    progress: &mut dyn Progress,
) -> Result<stop::End, RunError> {
    let run = &checked.scene.run;
    loop {
        let time = recorder.time();
        let next = bodies.bring_due(engine, time, run.step)?;
        let dt = stop::step_length(run, time).min(recorder.until_frame()).min(next);
        let dt = dt.min(bodies.until_corner(time, run.step));
        bodies.lead(engine, [time, dt], run.step);
        recorder.open_step(engine, bodies);
        let stepped = engine.step(dt, &mut recorder.watch(bodies))?;
        bodies.settle(engine, &stepped, time);
        bodies.let_go(engine, recorder.time() + stepped.dt);
        recorder.close_step(engine, bodies, stepped.dt)?;
        if let Some(end) = stop::reached(run, engine, bodies, &stepped, recorder.time()) {
            return Ok(end);
        }
        let share = stop::share(run, engine, bodies, recorder.time());
        if !progress.advance(recorder.time(), share) {
            return Ok(stop::End::Interrupted);
        }
    }
}

/// The scene in a world of the given precision.
fn engine(
    checked: &Checked,
    built: Built,
    precision: Precision,
) -> Result<Box<dyn Engine>, RunError> {
    let scene = &checked.scene;
    let drives = drives(checked, &built);
    let ledger = scene.outputs.contains(&Output::Energy);
    let until = match scene.run.stop {
        Stop::FirstExit => Until::FirstExit,
        _ => Until::Duration,
    };
    macro_rules! world {
        ($precision:ident) => {{
            let wishes = $precision::world::Wishes {
                gravity: scene.gravity,
                accuracy: scene.run.accuracy,
                resolve: scene.run.resolve,
                ledger,
                until,
                drives: &drives,
                due: &checked.due,
            };
            Box::new($precision::world::World::new(built, &wishes)?)
        }};
    }
    Ok(match precision {
        Precision::Single => world!(single),
        Precision::Double => world!(double),
    })
}

/// The drives of the scene's bodies, each with the index of its surface.
fn drives(checked: &Checked, built: &Built) -> BTreeMap<String, (usize, Drive)> {
    let mut drives = BTreeMap::new();
    for (name, body) in &checked.scene.bodies {
        let Motion::Drive { indent_to, load, speed, distance, mass, solution, .. } = &body.motion
        else {
            continue;
        };
        let Placement::OnSurface { surface, .. } = &body.position else { continue };
        let Some(index) = built.surfaces.keys().position(|key| key == surface) else { continue };
        let pitch = place::strip(&checked.scene.surfaces[surface].geometry).map(|s| s.pitch);
        let own_mass = built.bodies.get(name).map_or(0.0, |body| body.inertia.mass);
        let drive = Drive {
            indent_to: *indent_to,
            load: load.unwrap_or(*indent_to),
            speed: *speed,
            distance: *distance,
            mass: mass.unwrap_or(own_mass),
            solution: match solution {
                Solution::Dynamic {} => DriveSolution::Dynamic,
                Solution::QuasiStatic { increment } => DriveSolution::QuasiStatic {
                    increment: increment.or(pitch.map(|p| 0.125 * p)).unwrap_or(0.0),
                },
            },
        };
        drives.insert(name.clone(), (index, drive));
    }
    drives
}

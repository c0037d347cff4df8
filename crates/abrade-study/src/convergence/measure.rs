//! Runs of a setting, one per landing.

use std::path::Path;
use std::time::Instant;

use abrade_report::Summary;
use abrade_scene::{Checked, Progress, RunError, RunOptions};

use crate::convergence::Plan;
use crate::convergence::ladder::{Rung, Variant};
use crate::convergence::quantities::Quantities;
use crate::error::StudyError;
use crate::sets;

/// The failure of a run that the user broke off.
pub(crate) const INTERRUPTED: &str = "interrupted";
/// Wall time below which a run is timed again [s], and how often at most.
const SHORT: f64 = 0.05;
const REPEATS: u32 = 3;

/// What a setting gave.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Measured {
    /// One per landing.
    pub landings: Vec<Quantities>,
    /// Least wall time of a run [s], means of its steps and node evaluations.
    pub wall: f64,
    pub steps: f64,
    pub node_evaluations: f64,
    /// Root mean squares of the runs' own estimates of their errors by time and by pitch [-].
    pub estimates: [Option<f64>; 2],
    /// Wall time of all of it [s].
    pub cost: f64,
    /// Why it did not come to its end.
    pub failure: Option<String>,
}

impl Measured {
    /// True when every run came to its end.
    pub fn is_done(&self) -> bool {
        self.failure.is_none() && !self.landings.is_empty()
    }
}

/// Makes the runs of a study.
pub(crate) struct Runner<'a> {
    path: &'a Path,
    sets: &'a [String],
    plan: &'a Plan,
    watch: Watch<'a>,
}

/// Tells the study's progress in the place of a run's.
struct Watch<'a> {
    progress: &'a mut dyn Progress,
    began: Instant,
    /// When the present run began.
    run_began: Instant,
    budget: f64,
    interrupted: bool,
}

impl Progress for Watch<'_> {
    fn advance(&mut self, simulated: f64, _: Option<f64>) -> bool {
        let share = self.began.elapsed().as_secs_f64() / self.budget;
        self.interrupted |= !self.progress.advance(simulated, Some(share.min(1.0)));
        // A run without an end would keep the others waiting.
        !self.interrupted && self.run_began.elapsed().as_secs_f64() < self.budget
    }
}

impl<'a> Runner<'a> {
    pub(crate) fn new(
        path: &'a Path,
        sets: &'a [String],
        plan: &'a Plan,
        progress: &'a mut dyn Progress,
    ) -> Self {
        let budget = plan.budget;
        let now = Instant::now();
        let watch = Watch { progress, began: now, run_began: now, budget, interrupted: false };
        Self { path, sets, plan, watch }
    }

    /// Wall time so far [s].
    pub(crate) fn spent(&self) -> f64 {
        self.watch.began.elapsed().as_secs_f64()
    }

    pub(crate) fn budget(&self) -> f64 {
        self.plan.budget
    }

    pub(crate) fn is_interrupted(&self) -> bool {
        self.watch.interrupted
    }

    /// Runs a setting from every landing.
    pub(crate) fn measure(&mut self, of: Variant, rung: &Rung) -> Result<Measured, StudyError> {
        let began = self.spent();
        let mut measured = Measured { wall: f64::INFINITY, ..Measured::default() };
        let mut estimates = [Some(0.0), Some(0.0)];
        for landing in 0..self.plan.landings.max(1) {
            let checked = match self.checked(rung, landing) {
                Ok(Some(checked)) => checked,
                // Nothing is placed on a plate: one run tells all.
                Ok(None) => break,
                Err(failure) => {
                    measured.failure = Some(failure);
                    break;
                }
            };
            let name =
                format!("{}_{:.4e}_{landing}", of.name().replace([',', ' '], "_"), rung.value);
            let summary = match self.run(&checked, rung, &name)? {
                Ok(summary) => summary,
                Err(failure) => {
                    measured.failure = Some(failure);
                    break;
                }
            };
            let reaches = checked.solids.values().map(|solid| solid.shape.bounding_radius());
            measured.landings.push(Quantities::of(&summary, &reaches.collect::<Vec<_>>()));
            measured.wall = measured.wall.min(summary.wall);
            measured.steps += summary.steps as f64;
            measured.node_evaluations += summary.node_evaluations as f64;
            let own = [summary.error_estimate.time, summary.error_estimate.pitch];
            for (sum, own) in estimates.iter_mut().zip(own) {
                *sum = sum.zip(own).map(|(sum, own)| sum + own * own);
            }
        }
        let count = measured.landings.len() as f64;
        if count > 0.0 {
            measured.steps /= count;
            measured.node_evaluations /= count;
            measured.estimates = estimates.map(|sum| sum.map(|sum| (sum / count).sqrt()));
        }
        measured.cost = self.spent() - began;
        Ok(measured)
    }

    /// The scene at a setting and a landing; none for a landing that is no other place.
    fn checked(&self, rung: &Rung, landing: u32) -> Result<Option<Checked>, String> {
        let mut sets = self.sets.to_vec();
        sets.extend_from_slice(&rung.sets);
        sets.push("outputs=[Energy]".to_owned());
        let load = |sets: &[String]| {
            abrade_scene::load(self.path, sets).map_err(|error| {
                let first = error.problems.first();
                first.map_or_else(String::new, |problem| problem.message.clone())
            })
        };
        let checked = load(&sets)?;
        if landing == 0 {
            return Ok(Some(checked));
        }
        let elsewhere = sets::landing(&checked, landing);
        if elsewhere.is_empty() {
            return Ok(None);
        }
        sets.extend(elsewhere);
        load(&sets).map(Some)
    }

    /// The summary of a run, with the least of its wall times, or why it ended early.
    fn run(
        &mut self,
        checked: &Checked,
        rung: &Rung,
        name: &str,
    ) -> Result<Result<Summary, String>, StudyError> {
        let folder = self.plan.folder.join("runs").join(name);
        let options = RunOptions { folder, precision: rung.precision };
        let mut wall = f64::INFINITY;
        for repeat in 1.. {
            self.watch.run_began = Instant::now();
            let outcome = match abrade_scene::run(checked, &options, &mut self.watch) {
                Ok(outcome) => outcome,
                Err(RunError::Build(error)) => return Ok(Err(error.to_string())),
                Err(error) => return Err(error.into()),
            };
            if self.watch.interrupted {
                return Ok(Err(INTERRUPTED.to_owned()));
            }
            if outcome.interrupted {
                let seconds = self.plan.budget;
                return Ok(Err(format!("not at its end after {seconds} s, the study's budget")));
            }
            if let Some(failure) = outcome.failure {
                return Ok(Err(failure.to_string()));
            }
            wall = wall.min(outcome.summary.wall);
            if wall > SHORT || repeat == REPEATS {
                return Ok(Ok(Summary { wall, ..outcome.summary }));
            }
        }
        Ok(Err(String::new()))
    }
}

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
    budget: f64,
    /// Wall time at which the present run is given up [s].
    until: f64,
    interrupted: bool,
}

impl Progress for Watch<'_> {
    fn advance(&mut self, simulated: f64, _: Option<f64>) -> bool {
        let spent = self.began.elapsed().as_secs_f64();
        let share = (spent / self.budget).min(1.0);
        self.interrupted |= !self.progress.advance(simulated, Some(share));
        // A run without an end would keep the others waiting.
        !self.interrupted && spent < self.until
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
        let began = Instant::now();
        let watch = Watch { progress, began, budget, until: budget, interrupted: false };
        Self { path, sets, plan, watch }
    }

    /// Wall time so far [s].
    pub(crate) fn spent(&self) -> f64 {
        self.watch.began.elapsed().as_secs_f64()
    }

    /// Gives up what runs for longer than until this wall time [s].
    pub(crate) fn give_up_after(&mut self, until: f64) {
        self.watch.until = until;
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
        let first = self.checked(rung, Vec::new());
        for landing in 0..self.plan.landings.max(1) {
            let checked = match &first {
                Err(failure) => Err(failure.clone()),
                Ok(first) if landing == 0 => Ok(first.clone()),
                Ok(first) => match sets::landing(first, landing) {
                    // It lands nowhere else: one run tells all.
                    elsewhere if elsewhere.is_empty() => break,
                    elsewhere => self.checked(rung, elsewhere),
                },
            };
            let checked = match checked {
                Ok(checked) => checked,
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
            let solids = checked.solids.iter();
            let reaches = solids.map(|(name, solid)| (name.clone(), solid.shape.bounding_radius()));
            measured.landings.push(Quantities::of(&summary, &reaches.collect()));
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

    /// The scene at a setting, with more changes behind it.
    fn checked(&self, rung: &Rung, more: Vec<String>) -> Result<Checked, String> {
        let mut sets = self.sets.to_vec();
        sets.extend_from_slice(&rung.sets);
        sets.push("outputs=[Energy]".to_owned());
        sets.extend(more);
        abrade_scene::load(self.path, &sets).map_err(|error| {
            let first = error.problems.first();
            first.map_or_else(String::new, |problem| problem.message.clone())
        })
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
            // A run that is over within its first step tells no progress.
            self.watch.advance(0.0, None);
            if self.watch.interrupted {
                return Ok(Err(INTERRUPTED.to_owned()));
            }
            let outcome = match abrade_scene::run(checked, &options, &mut self.watch) {
                Ok(outcome) => outcome,
                Err(error @ (RunError::Report(_) | RunError::Folder { .. })) => {
                    return Err(error.into());
                }
                Err(error) => return Ok(Err(error.to_string())),
            };
            if self.watch.interrupted {
                return Ok(Err(INTERRUPTED.to_owned()));
            }
            if outcome.interrupted {
                return Ok(Err("given up at the end of its part of the budget".to_owned()));
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

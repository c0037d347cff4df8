//! Error against run time: a scene at ladders of settings, each compared with the finest run.

mod chart;
mod cheapest;
mod compare;
mod estimates;
mod fit;
mod ladder;
mod measure;
mod quantities;
mod reference;
mod references;
mod table;

use std::path::{Path, PathBuf};

use abrade_scene::Progress;

pub use cheapest::Cheapest;
pub use compare::{Curve, Row};
pub use estimates::Told;
pub use ladder::{Ladder, Rung, Variant};
pub use quantities::{BodyQuantities, Errors, Quantities};

use crate::error::StudyError;
use measure::{Measured, Runner};
use references::References;

/// What a study does.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// What is varied.
    pub variants: Vec<Variant>,
    /// Number of places in the cell of a plate's lattice that every setting starts from, at least
    /// one. Errors are root mean squares over them.
    pub landings: u32,
    /// Wall time [s]. Every ladder has an equal part of what is left of it: no finer setting is begun
    /// behind its end, and a run that goes on until then is given up.
    pub budget: f64,
    /// A `summary.json`, or one with some of its values, of results to compare with in the place of
    /// the finest run.
    pub reference: Option<PathBuf>,
    /// Folder of the results; made if it is missing.
    pub folder: PathBuf,
}

impl Default for Plan {
    fn default() -> Self {
        Self {
            variants: Variant::ALL.to_vec(),
            landings: 4,
            budget: 120.0,
            reference: None,
            folder: PathBuf::new(),
        }
    }
}

/// What a study found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Study {
    /// Name of the scene.
    pub scene: String,
    /// The changes that the scene was given before all others.
    pub sets: Vec<String>,
    /// One curve per variant.
    pub curves: Vec<Curve>,
    /// What total errors are counted from, in words.
    pub reference: String,
    /// The cheapest settings for the errors that people ask for.
    pub cheapest: Vec<Cheapest>,
    /// How well the runs' own estimates told their errors by time and by pitch.
    pub told: [Told; 2],
    /// True when the user broke it off; what is there is complete.
    pub interrupted: bool,
}

/// Runs the scene file at `path`, with the `sets` applied, at the settings of `plan`, and writes
/// `study.csv` and `study.png` into its folder: the rows after each ladder, so that a study that is
/// killed leaves those of the ladders before, against the finest run of these.
///
/// # Errors
/// The scene is wrong, the reference cannot be read, no run came to its end, or the results cannot
/// be written. A setting at which the scene cannot be run is a row of its own.
pub fn convergence(
    path: &Path,
    sets: &[String],
    plan: &Plan,
    progress: &mut dyn Progress,
) -> Result<Study, StudyError> {
    let checked = abrade_scene::load(path, sets).map_err(StudyError::Scene)?;
    let given = plan.reference.as_deref().map(reference::read).transpose()?;
    let ladders: Vec<Ladder> =
        plan.variants.iter().filter_map(|&variant| Ladder::of(variant, &checked)).collect();
    let mut runner = Runner::new(path, sets, plan, progress);
    let mut climbed = Vec::new();
    let nothing = "nothing of what is to be varied makes a difference to it".to_owned();
    let mut study = Err(StudyError::Nothing { reason: nothing });
    for (at, ladder) in ladders.iter().enumerate() {
        let left = (ladders.len() - at) as f64;
        climbed.push((ladder, climb(ladder, &mut runner, left)?));
        let references = References::new(&climbed, given.as_ref());
        study = references.map(|references| Study {
            scene: checked.scene.name.clone(),
            sets: sets.to_vec(),
            interrupted: runner.is_interrupted(),
            ..Study::of(&climbed, &references)
        });
        // Should the next ladder be killed, this one's rows are there.
        if let Ok(study) = &study {
            table::write(study, &plan.folder.join("study.csv"))?;
        }
    }
    let study = study?;
    chart::write(&study, &plan.folder.join("study.png"))?;
    Ok(study)
}

/// Runs a ladder from coarse to fine, as far as its part of what is left of the budget lets it.
fn climb(ladder: &Ladder, runner: &mut Runner<'_>, left: f64) -> Result<Vec<Measured>, StudyError> {
    let until = runner.spent() + (runner.budget() - runner.spent()).max(0.0) / left;
    runner.give_up_after(until);
    let mut runs: Vec<Measured> = Vec::new();
    for rung in &ladder.rungs {
        let costs = runs.iter().rev().map(|run| run.cost).take(2).collect::<Vec<_>>();
        let next = match costs[..] {
            [last, before] if before > 0.0 => last * (last / before).max(1.0),
            [last, ..] => last,
            [] => 0.0,
        };
        if runner.is_interrupted() || !runs.is_empty() && runner.spent() + next > until {
            break;
        }
        runs.push(runner.measure(ladder.variant, rung)?);
    }
    Ok(runs)
}

impl Study {
    /// What the ladders that were climbed tell.
    fn of(climbed: &[(&Ladder, Vec<Measured>)], references: &References<'_>) -> Self {
        let curves = climbed.iter().map(|(ladder, runs)| Curve::new(ladder, runs, references));
        let curves: Vec<Curve> = curves.collect();
        let cheapest = cheapest::cheapest(&curves);
        // Against results from elsewhere both kinds of errors are in every one.
        let told =
            if references.are_given() { Default::default() } else { estimates::told(&curves) };
        Self { curves, cheapest, told, reference: references.words(), ..Self::default() }
    }

    /// The curves as a table to read.
    pub fn table(&self) -> String {
        table::text(self)
    }
}

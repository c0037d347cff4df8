//! Erosion: the impacts of grains of several forms on a plate, with means, intervals and ratios.
//!
//! [`load`] reads a study's file. A study is a list of cases ([`StudyFile::cases`]), each of which lies
//! in a file of its own when it is made; [`make`] makes those that are not there yet, all of them or
//! some, and [`result`] tells what those that are there come to.

mod begun;
mod case;
mod charts;
mod check;
mod craters;
mod descriptors;
mod file;
mod impact;
mod laws;
mod method;
mod page;
mod quantities;
mod sample;
mod sensitivity;
mod silhouette;
mod statistics;
mod store;
mod summary;
mod table;

use std::path::Path;

use abrade_report::atomic;
use abrade_scene::Progress;

pub use case::{Case, CaseError, Made, Unmade};
pub use check::{load, load_text, notes};
pub use descriptors::Descriptors;
pub use file::{Plate, Samples, Sequence, Size, StudyFile, Target, VERSION};
pub use impact::Impact;
pub use sample::Sample;
pub use sensitivity::Sensitivity;
pub use statistics::Estimate;
pub use summary::{CaseResult, Erosion, Exponent};

use crate::error::StudyError;
use begun::Watch;
use store::Store;

/// Makes those of `cases` that are not in the results folder `out` yet; files that the study names lie
/// `beside` it. Returns those that cannot be made; they leave the others alone.
///
/// # Errors
/// The user broke it off, or a file cannot be written.
pub fn make(
    file: &StudyFile,
    beside: &Path,
    cases: &[Case],
    out: &Path,
    progress: &mut dyn Progress,
) -> Result<Vec<Unmade>, StudyError> {
    let store = Store::new(file, beside, out);
    let mut unmade = Vec::new();
    let is_there = |case: &&Case| {
        let is_there = store.read(case).is_some();
        // Of two processes that were at it one may have kept it since.
        if is_there {
            store.forget(case);
        }
        is_there
    };
    let (there, todo): (Vec<&Case>, Vec<&Case>) = cases.iter().partition(is_there);
    for (made, case) in todo.into_iter().enumerate() {
        let at = there.len() + made;
        progress.cases(at, cases.len());
        // Another process may have made it by now.
        if is_there(&case) {
            continue;
        }
        let mut part = Part { whole: progress, at, of: cases.len() };
        let mut watch = Watch::new(&mut part, &store, case);
        match case.make(file, beside, store.begun(case), &mut watch) {
            Ok(Some(made)) => store.write(case, &made)?,
            Ok(None) => {
                return Err(watch.error.map_or(StudyError::Interrupted, StudyError::Report));
            }
            Err(error) => unmade.push(Unmade { case: case.clone(), error }),
        }
    }
    Ok(unmade)
}

/// The JSON schema of a study's file.
pub fn schema() -> serde_json::Value {
    schemars::schema_for!(StudyFile).to_value()
}

/// True when `case` is in the results folder `out`.
pub fn is_made(file: &StudyFile, beside: &Path, case: &Case, out: &Path) -> bool {
    Store::new(file, beside, out).read(case).is_some()
}

/// How far a case is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Nothing of it is there.
    None,
    /// It was broken off, and goes on from where it was.
    Begun,
    /// It is there.
    Made,
}

/// How far `case` is in the results folder `out`.
pub fn stage(file: &StudyFile, beside: &Path, case: &Case, out: &Path) -> Stage {
    let store = Store::new(file, beside, out);
    match (store.read(case), store.begun(case)) {
        (Some(_), _) => Stage::Made,
        (None, Some(_)) => Stage::Begun,
        (None, None) => Stage::None,
    }
}

/// Number of cases in the results folder `out` that are of another study, or of this one before it, a
/// file that it names or the program's version changed. They stay there.
pub fn others(file: &StudyFile, beside: &Path, out: &Path) -> usize {
    Store::new(file, beside, out).others(&file.cases())
}

/// Takes the cases that are in the results folder `from` over into `out`.
///
/// # Errors
/// It holds no case of this study, or the file system refuses.
pub fn gather(file: &StudyFile, beside: &Path, from: &Path, out: &Path) -> Result<(), StudyError> {
    let [from_store, store] = [from, out].map(|folder| Store::new(file, beside, folder));
    let mut found = 0;
    for case in file.cases() {
        if let Some(made) = from_store.read(&case) {
            found += 1;
            store.write(&case, &made)?;
        }
    }
    match found {
        0 => Err(StudyError::NoCases { folder: from.to_owned() }),
        _ => Ok(()),
    }
}

/// What the cases in the results folder `out` come to.
///
/// # Errors
/// A grain that has a case cannot be made.
pub fn result(file: &StudyFile, beside: &Path, out: &Path) -> Result<Erosion, StudyError> {
    let store = Store::new(file, beside, out);
    let made =
        file.cases().into_iter().filter_map(|case| store.read(&case).map(|made| (case, made)));
    let made: Vec<(Case, Made)> = made.collect();
    let mut grains = Vec::new();
    let is_there = |name: &&String| made.iter().any(|(case, _)| case.grain == **name);
    for name in file.grains.keys().filter(is_there) {
        let descriptors = descriptors::describe(file, name, beside)
            .map_err(|source| StudyError::Grain { name: name.clone(), source })?;
        grains.push((name.clone(), descriptors));
    }
    Ok(Erosion::of(file, &made, grains))
}

/// Writes what a study found into the folder `out`: `report.html`, tables and pictures.
///
/// # Errors
/// The file system refuses, or the drawing library does.
pub fn write(erosion: &Erosion, beside: &Path, out: &Path) -> Result<(), StudyError> {
    table::write(erosion, out)?;
    let mut pictures = erosion.charts()?;
    pictures.extend(craters::craters(&erosion.file, beside)?);
    for picture in &pictures {
        atomic::write(&out.join(picture.name), &picture.png)?;
    }
    Ok(erosion.page(pictures).write(&out.join("report.html"))?)
}

/// The progress of one case among others.
struct Part<'a> {
    whole: &'a mut dyn Progress,
    at: usize,
    of: usize,
}

impl Progress for Part<'_> {
    fn advance(&mut self, simulated: f64, share: Option<f64>) -> bool {
        let share = share.map(|share| (self.at as f64 + share) / self.of as f64);
        self.whole.advance(simulated, share)
    }
}

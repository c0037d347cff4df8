//! The cases of a map: one collision each. A case depends on nothing but its solid and bodies; it lies in a
//! file of its own, which appears when it is complete, so that a map that is broken off, made in parts, or
//! given another value or name, goes on where it is.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, Sender};

use abrade_adhesive::{Asperities, Collision, Figures, Solid};
use abrade_report::{FileAction, ReportError, atomic};
use abrade_scene::Progress;
use rayon::prelude::*;
use serde_json::{Value, json};

use super::file::MapFile;
use super::summary::figures_json;
use crate::case_files;
use crate::error::StudyError;
use crate::fingerprint::Fingerprint;

/// Steps between two looks at the user's wish to stop.
const STRETCH: usize = 1024;

/// A case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// Its number, from 0.
    pub number: usize,
    /// a [-].
    pub strength_ratio: f64,
    /// sigma_j [Pa].
    pub shear_strength: f64,
    /// sigma_0 / sigma_j [-].
    pub adhesion_ratio: f64,
    /// Gap at the start [diameters].
    pub gap: f64,
}

impl MapFile {
    /// All cases up to the tensile strength, in the order of their numbers; gap by gap, so that the first
    /// part of a map is whole but coarse.
    pub fn cases(&self) -> Vec<Case> {
        let mut cases = Vec::new();
        for &gap in &self.gaps {
            for &strength_ratio in &self.strength_ratios {
                for &shear_strength in &self.shear_strengths {
                    for &adhesion_ratio in &self.adhesion_ratios {
                        let number = cases.len();
                        let case =
                            Case { number, strength_ratio, shear_strength, adhesion_ratio, gap };
                        let solid = self.solid_of(&case);
                        if solid.adhesion <= solid.tensile_strength() * (1.0 + 1e-12) {
                            cases.push(case);
                        }
                    }
                }
            }
        }
        cases
    }

    fn solid_of(&self, case: &Case) -> Solid {
        Solid {
            strength_ratio: case.strength_ratio,
            shear_strength: case.shear_strength,
            adhesion: case.adhesion_ratio * case.shear_strength,
            ..self.solid
        }
    }

    fn bodies_of(&self, case: &Case) -> Asperities {
        Asperities { gap: case.gap, ..self.bodies.clone() }
    }

    fn fingerprint(&self, case: &Case) -> String {
        let mut hash = Fingerprint::new();
        hash.add(format!("{:?} {:?}", self.solid_of(case), self.bodies_of(case)).as_bytes());
        hash.text()
    }
}

/// What a case came to: figures, or why it ended early.
pub(crate) type Made = Result<Figures, String>;

/// Makes those of `cases` that are not in the results folder `out` yet or ended early there, on as many threads
/// as rayon has.
///
/// # Errors
/// The user broke it off, or a file cannot be written.
pub fn make(
    file: &MapFile,
    cases: &[Case],
    out: &Path,
    progress: &mut dyn Progress,
) -> Result<(), StudyError> {
    let folder = case_files::folder(out);
    std::fs::create_dir_all(&folder).map_err(|source| ReportError::File {
        action: FileAction::Create,
        path: folder.clone(),
        source,
    })?;
    let is_due = |case: &&Case| !matches!(read(file, case, out), Some(Ok(_)));
    let todo: Vec<&Case> = cases.iter().filter(is_due).collect();
    let there = cases.len() - todo.len();
    let (stop, over) = (AtomicBool::new(false), AtomicUsize::new(there));
    let (tell, heard) = mpsc::channel::<Done>();
    std::thread::scope(|scope| {
        let work = scope.spawn(|| {
            todo.par_iter().try_for_each_with(tell, |tell, case| {
                let made = collide(file, case, tell, &stop)?;
                write(file, case, &made, out)?;
                over.fetch_add(1, Ordering::Relaxed);
                Ok(())
            })
        });
        let all = cases.len() as f64;
        let mut share = there as f64 / all;
        for done in heard {
            progress.cases(over.load(Ordering::Relaxed), cases.len());
            share += done.share / all;
            if !progress.advance(done.time, Some(share)) {
                stop.store(true, Ordering::Relaxed);
            }
        }
        work.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })
}

/// What a collision has done since it last told.
struct Done {
    /// Share of its travel.
    share: f64,
    /// Its time [s].
    time: f64,
}

fn collide(
    file: &MapFile,
    case: &Case,
    tell: &Sender<Done>,
    stop: &AtomicBool,
) -> Result<Made, StudyError> {
    let mut collision = match Collision::new(&file.solid_of(case), &file.bodies_of(case)) {
        Ok(collision) => collision,
        Err(error) => return Ok(Err(error.to_string())),
    };
    while collision.share() < 1.0 {
        let before = collision.share();
        for _ in 0..STRETCH {
            if collision.share() >= 1.0 {
                break;
            }
            if let Err(error) = collision.step() {
                return Ok(Err(error.to_string()));
            }
        }
        let share = collision.share() - before;
        // Who listens has ended only where a panic goes through.
        let _ = tell.send(Done { share, time: collision.simulation().time() });
        if stop.load(Ordering::Relaxed) {
            return Err(StudyError::Interrupted);
        }
    }
    Ok(Ok(collision.figures()))
}

/// True when `case` is in the results folder `out`.
pub fn is_made(file: &MapFile, case: &Case, out: &Path) -> bool {
    read(file, case, out).is_some()
}

/// True when `case` ended early in the results folder `out`.
pub fn ended_early(file: &MapFile, case: &Case, out: &Path) -> bool {
    matches!(read(file, case, out), Some(Err(_)))
}

/// Number of cases in the results folder `out` that are of another map, or of this one before it or the
/// program's version changed. They stay there.
pub fn others(file: &MapFile, out: &Path) -> usize {
    let own = file.cases().iter().map(|case| file.fingerprint(case)).collect();
    case_files::others(out, &own)
}

/// Takes the cases that are in the results folder `from` over into `out`; one that ended early takes the place of
/// none that came to its end.
///
/// # Errors
/// It holds no case of this map, or the file system refuses.
pub fn gather(file: &MapFile, from: &Path, out: &Path) -> Result<(), StudyError> {
    let mut found = 0;
    for case in file.cases() {
        if let Some(made) = read(file, &case, from) {
            found += 1;
            if made.is_ok() || !matches!(read(file, &case, out), Some(Ok(_))) {
                write(file, &case, &made, out)?;
            }
        }
    }
    match found {
        0 => Err(StudyError::NoCases { folder: from.to_owned() }),
        _ => Ok(()),
    }
}

fn path(file: &MapFile, case: &Case, out: &Path) -> PathBuf {
    case_files::folder(out).join(file.fingerprint(case) + ".json")
}

fn write(file: &MapFile, case: &Case, made: &Made, out: &Path) -> Result<(), ReportError> {
    let path = path(file, case, out);
    let folder = path.parent().unwrap_or(out).to_owned();
    std::fs::create_dir_all(&folder).map_err(|source| ReportError::File {
        action: FileAction::Create,
        path: folder,
        source,
    })?;
    let value = json!({
        "study": file.name,
        "fingerprint": file.fingerprint(case),
        "mode": made.as_ref().map(|figures| figures.mode().name()).ok(),
        "figures": made.as_ref().map(figures_json).ok(),
        "failure": made.as_ref().err(),
    });
    atomic::write(&path, format!("{value}\n").as_bytes())
}

/// What an earlier run has made of `case`, if that was of its solid and bodies.
pub(crate) fn read(file: &MapFile, case: &Case, out: &Path) -> Option<Made> {
    let text = std::fs::read_to_string(path(file, case, out)).ok()?;
    let value: Value = serde_json::from_str(&text).ok()?;
    if value["fingerprint"] != file.fingerprint(case) {
        return None;
    }
    match value["failure"].as_str() {
        Some(failure) => Some(Err(failure.to_owned())),
        None => read_figures(&value["figures"]).map(Ok),
    }
}

fn read_figures(value: &Value) -> Option<Figures> {
    let number = |name: &str| value[name].as_f64();
    let failed = number("failed")?;
    Some(Figures {
        ground: number("ground")?,
        largest_piece: number("largest_piece")?,
        small_pieces: number("small_pieces")?,
        worn: number("worn")?,
        transferred: number("transferred")?,
        debris: number("debris")?,
        failed,
        parted: number("parted")?,
        are_joined: value["are_joined"].as_bool()?,
        // Only bodies that touch make a link fail.
        have_touched: failed > 0.0 || value["have_touched"].as_bool()?,
    })
}

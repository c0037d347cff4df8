//! The file of a case: a line of JSON that says which case of which study it is, then a line per impact.
//! It appears under its name when it is complete, so that a study that is broken off, or made in parts,
//! goes on where it is.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use abrade_report::{FileAction, ReportError, atomic};
use serde::{Deserialize, Serialize};

use super::case::{Case, Made};
use super::file::StudyFile;
use super::impact::Impact;
use crate::fingerprint::Fingerprint;

/// First line of a case's file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Head {
    study: String,
    /// Of the version, the study and its files.
    fingerprint: String,
    case: usize,
    grain: String,
    speed_m_s: f64,
    angle_rad: f64,
    pitch_m: f64,
    impacts: usize,
}

/// A further line.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Line {
    Hit(Box<Impact>),
    Miss { miss: String },
}

/// Where the cases of a study lie.
#[derive(Clone, Debug)]
pub(crate) struct Store {
    folder: PathBuf,
    study: String,
    fingerprint: String,
}

impl Store {
    /// The store of `file` below the results folder `out`; files that the study names lie in `beside`.
    pub(crate) fn new(file: &StudyFile, beside: &Path, out: &Path) -> Self {
        Self {
            folder: out.join("cases"),
            study: file.name.clone(),
            fingerprint: fingerprint(file, beside),
        }
    }

    /// Writes a case that was made.
    pub(crate) fn write(&self, case: &Case, made: &Made) -> Result<(), ReportError> {
        let head = Head {
            study: self.study.clone(),
            fingerprint: self.fingerprint.clone(),
            case: case.number,
            grain: case.grain.clone(),
            speed_m_s: case.speed,
            angle_rad: case.angle,
            pitch_m: made.pitch,
            impacts: made.impacts.len(),
        };
        let path = self.path(case);
        let json = |error: serde_json::Error| ReportError::File {
            action: FileAction::Write,
            path: path.clone(),
            source: error.into(),
        };
        let mut text = serde_json::to_string(&head).map_err(json)?;
        for impact in &made.impacts {
            let line = match impact {
                Ok(impact) => Line::Hit(Box::new(*impact)),
                Err(miss) => Line::Miss { miss: miss.clone() },
            };
            let _ = write!(text, "\n{}", serde_json::to_string(&line).map_err(json)?);
        }
        text.push('\n');
        std::fs::create_dir_all(&self.folder).map_err(|source| ReportError::File {
            action: FileAction::Write,
            path: self.folder.clone(),
            source,
        })?;
        atomic::write(&path, text.as_bytes())
    }

    /// What an earlier run has made of `case`, if that was of this study.
    pub(crate) fn read(&self, case: &Case) -> Option<Made> {
        let text = std::fs::read_to_string(self.path(case)).ok()?;
        let mut lines = text.lines();
        let head: Head = serde_json::from_str(lines.next()?).ok()?;
        if head.fingerprint != self.fingerprint || head.case != case.number {
            return None;
        }
        let impact = |line: &str| match serde_json::from_str(line).ok()? {
            Line::Hit(impact) => Some(Ok(*impact)),
            Line::Miss { miss } => Some(Err(miss)),
        };
        let impacts = lines.map(impact).collect::<Option<Vec<_>>>()?;
        (impacts.len() == head.impacts).then_some(Made { pitch: head.pitch_m, impacts })
    }

    fn path(&self, case: &Case) -> PathBuf {
        self.folder.join(format!("{:04}.jsonl", case.number))
    }
}

/// A number that changes with version, study and files that it names.
fn fingerprint(file: &StudyFile, beside: &Path) -> String {
    let mut hash = Fingerprint::new();
    hash.add(format!("{file:?}").as_bytes());
    for name in file.files() {
        // A file that cannot be read is refused when its grain is made.
        hash.add(&std::fs::read(beside.join(name)).unwrap_or_default());
    }
    hash.text()
}

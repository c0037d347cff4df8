//! The file of a case: a line of JSON that says which case of which study it is, then a line per impact.
//! It appears under its name when it is complete, so that a study that is broken off, or made in parts,
//! goes on where it is. Beside it lies, until then, the file of a case that is under way.

use std::fmt::Write as _;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};

use abrade_report::{FileAction, ReportError, atomic};
use serde::{Deserialize, Serialize};

use super::begun::Begun;
use super::case::{Case, Impacts, Made};
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

/// Last line of the file of a case that is under way.
#[derive(Serialize, Deserialize)]
struct Plate {
    depths_m: Vec<(u32, f64)>,
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

    /// Number of files of cases that are there, whole or begun, but not of this study as it is.
    pub(crate) fn others(&self) -> usize {
        let files = std::fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let head = |path: PathBuf| -> Option<Head> {
            let mut first = String::new();
            BufReader::new(std::fs::File::open(path).ok()?).read_line(&mut first).ok()?;
            serde_json::from_str(&first).ok()
        };
        let heads = files.filter_map(|file| head(file.path()));
        heads.filter(|head| head.fingerprint != self.fingerprint).count()
    }

    /// Writes a case that was made; what was kept of it goes.
    pub(crate) fn write(&self, case: &Case, made: &Made) -> Result<(), ReportError> {
        let path = self.path(case);
        let text = self.text(case, made.pitch, &made.impacts).map_err(unwritten(&path))?;
        self.put(&path, &text)?;
        self.forget(case);
        Ok(())
    }

    /// Removes what was kept of a case that is there; two processes may have been at it.
    pub(crate) fn forget(&self, case: &Case) {
        // Whoever reads a case that is there does not ask what was kept of it.
        let _ = std::fs::remove_file(self.path_under_way(case));
    }

    /// Keeps a case that is under way.
    pub(crate) fn keep(&self, case: &Case, begun: &Begun) -> Result<(), ReportError> {
        let path = self.path_under_way(case);
        let last = Plate { depths_m: begun.depths.clone() };
        let text = self.text(case, begun.pitch, &begun.impacts).and_then(|mut text| {
            text.push_str(&serde_json::to_string(&last)?);
            text.push('\n');
            Ok(text)
        });
        self.put(&path, &text.map_err(unwritten(&path))?)
    }

    fn put(&self, path: &Path, text: &str) -> Result<(), ReportError> {
        std::fs::create_dir_all(&self.folder).map_err(|source| ReportError::File {
            action: FileAction::Write,
            path: self.folder.clone(),
            source,
        })?;
        atomic::write(path, text.as_bytes())
    }

    fn text(&self, case: &Case, pitch: f64, impacts: &Impacts) -> serde_json::Result<String> {
        let head = Head {
            study: self.study.clone(),
            fingerprint: self.fingerprint.clone(),
            case: case.number,
            grain: case.grain.clone(),
            speed_m_s: case.speed,
            angle_rad: case.angle,
            pitch_m: pitch,
            impacts: impacts.len(),
        };
        let mut text = serde_json::to_string(&head)?;
        for impact in impacts {
            let line = match impact {
                Ok(impact) => Line::Hit(Box::new(*impact)),
                Err(miss) => Line::Miss { miss: miss.clone() },
            };
            let _ = write!(text, "\n{}", serde_json::to_string(&line)?);
        }
        text.push('\n');
        Ok(text)
    }

    /// What an earlier run has made of `case`, if that was of this study.
    pub(crate) fn read(&self, case: &Case) -> Option<Made> {
        let text = std::fs::read_to_string(self.path(case)).ok()?;
        let (head, lines) = self.open(case, &text)?;
        let impacts = lines.map(impact).collect::<Option<Impacts>>()?;
        (impacts.len() == head.impacts).then_some(Made { pitch: head.pitch_m, impacts })
    }

    /// What an earlier run has kept of `case`, if that was of this study.
    pub(crate) fn begun(&self, case: &Case) -> Option<Begun> {
        let text = std::fs::read_to_string(self.path_under_way(case)).ok()?;
        let (head, mut lines) = self.open(case, &text)?;
        let Plate { depths_m } = serde_json::from_str(lines.next_back()?).ok()?;
        let impacts = lines.map(impact).collect::<Option<Impacts>>()?;
        let is_whole = impacts.len() == head.impacts;
        is_whole.then_some(Begun { pitch: head.pitch_m, impacts, depths: depths_m })
    }

    /// The lines of a file of `case`.
    fn open<'a>(&self, case: &Case, text: &'a str) -> Option<(Head, std::str::Lines<'a>)> {
        let mut lines = text.lines();
        let head: Head = serde_json::from_str(lines.next()?).ok()?;
        let is_it = head.fingerprint == self.fingerprint && head.case == case.number;
        is_it.then_some((head, lines))
    }

    fn path(&self, case: &Case) -> PathBuf {
        self.folder.join(format!("{:04}.jsonl", case.number))
    }

    fn path_under_way(&self, case: &Case) -> PathBuf {
        self.folder.join(format!("{:04}.begun.jsonl", case.number))
    }
}

/// What an impact did, or why it has no result, of its line.
fn impact(line: &str) -> Option<Result<Impact, String>> {
    match serde_json::from_str(line).ok()? {
        Line::Hit(impact) => Some(Ok(*impact)),
        Line::Miss { miss } => Some(Err(miss)),
    }
}

/// The error of a file that cannot be written.
fn unwritten(path: &Path) -> impl Fn(serde_json::Error) -> ReportError {
    |error| ReportError::File {
        action: FileAction::Write,
        path: path.to_owned(),
        source: error.into(),
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

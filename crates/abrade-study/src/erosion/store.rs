//! The file of a case: a line of JSON that says what it is of, then a line per impact. It appears under its
//! name when it is complete, so that a study that is broken off, or made in parts, or given another grain, speed
//! or angle, goes on where it is. Beside it lies, until then, the file of a case that is under way.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use abrade_report::{FileAction, ReportError, atomic};
use abrade_scene::scene::Form;
use serde::{Deserialize, Serialize};

use super::begun::Begun;
use super::case::{Case, Impacts, Made};
use super::file::StudyFile;
use super::impact::Impact;
use crate::case_files;
use crate::fingerprint::Fingerprint;

/// First line of a case's file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Head {
    study: String,
    fingerprint: String,
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
    out: PathBuf,
    study: String,
    /// What all cases of a grain have in common, by its name.
    grains: BTreeMap<String, Fingerprint>,
}

impl Store {
    /// The store of `file` below the results folder `out`; files that the study names lie in `beside`.
    pub(crate) fn new(file: &StudyFile, beside: &Path, out: &Path) -> Self {
        let of_grain = |name: &String| (name.clone(), fingerprint(file, name, beside));
        let grains = file.grains.keys().map(of_grain).collect();
        Self { out: out.to_owned(), study: file.name.clone(), grains }
    }

    /// Number of cases that are there, whole or begun, and not among `cases`.
    pub(crate) fn others(&self, cases: &[Case]) -> usize {
        let own = cases.iter().map(|case| self.fingerprint(case)).collect();
        case_files::others(&self.out, &own)
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
        let folder = case_files::folder(&self.out);
        std::fs::create_dir_all(&folder).map_err(|source| ReportError::File {
            action: FileAction::Write,
            path: folder.clone(),
            source,
        })?;
        atomic::write(path, text.as_bytes())
    }

    fn text(&self, case: &Case, pitch: f64, impacts: &Impacts) -> serde_json::Result<String> {
        let head = Head {
            study: self.study.clone(),
            fingerprint: self.fingerprint(case),
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

    /// What an earlier run has made of `case`, if that was of the same.
    pub(crate) fn read(&self, case: &Case) -> Option<Made> {
        let text = std::fs::read_to_string(self.path(case)).ok()?;
        let (head, lines) = self.open(case, &text)?;
        let impacts = lines.map(impact).collect::<Option<Impacts>>()?;
        (impacts.len() == head.impacts).then_some(Made { pitch: head.pitch_m, impacts })
    }

    /// What an earlier run has kept of `case`, if that was of the same.
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
        (head.fingerprint == self.fingerprint(case)).then_some((head, lines))
    }

    fn path(&self, case: &Case) -> PathBuf {
        case_files::folder(&self.out).join(self.fingerprint(case) + ".jsonl")
    }

    fn path_under_way(&self, case: &Case) -> PathBuf {
        case_files::folder(&self.out).join(self.fingerprint(case) + ".begun.jsonl")
    }

    /// Of all that a case depends on: neither its number nor the names of study and grain.
    fn fingerprint(&self, case: &Case) -> String {
        let mut hash = self.grains.get(&case.grain).expect("a case of this study").clone();
        hash.add(format!("{:?} {:?}", case.speed, case.angle).as_bytes());
        hash.text()
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

/// What all cases of the grain of this `name` are made of: version, grain and its file, target, settings.
fn fingerprint(file: &StudyFile, name: &str, beside: &Path) -> Fingerprint {
    let StudyFile {
        version: _,
        name: _,
        target,
        grains,
        reference: _,
        density,
        size,
        speeds: _,
        angles: _,
        plate,
        samples,
        resolution,
        accuracy,
    } = file;
    let grain = &grains[name];
    let settings = (density, size, plate, samples, resolution, accuracy);
    let mut hash = Fingerprint::new();
    hash.add(format!("{grain:?} {target:?} {settings:?}").as_bytes());
    if let Form::Mesh { file } | Form::Clump { file } = &grain.form {
        // A file that cannot be read is refused when its grain is made.
        hash.add(&std::fs::read(beside.join(file)).unwrap_or_default());
    }
    hash
}

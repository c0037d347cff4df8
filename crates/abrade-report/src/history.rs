//! `history.csv`: a row per instant, a unit in every column name. The file carries a temporary
//! name until [`History::finish`].

mod read;

use std::io;
use std::path::{Path, PathBuf};

use abrade::State;
use nalgebra::Vector3;

use crate::atomic::PartialFile;
use crate::error::{FileAction, ReportError};
use crate::summary::EnergySummary;
pub use read::read_places;

/// What the columns of a history are; fixed over a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Columns {
    /// Names of the bodies, as the scene writes them.
    pub bodies: Vec<String>,
    /// Names of the surfaces, as the scene writes them.
    pub surfaces: Vec<String>,
    /// Names of the surfaces that move.
    pub carriers: Vec<String>,
    /// True when the ledger is kept.
    pub energies: bool,
}

/// An instant; bodies, surfaces and carriers in the order of [`Columns`].
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    /// Time since the run began [s].
    pub time: f64,
    /// One entry per body.
    pub bodies: &'a [BodyRow],
    /// One entry per surface.
    pub surfaces: &'a [SurfaceRow],
    /// The motion of the bodies that moving surfaces are on.
    pub carriers: &'a [State],
    /// Present exactly when the ledger is kept.
    pub energies: Option<&'a EnergySummary>,
}

/// A body at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyRow {
    /// Where it is and how it moves.
    pub state: State,
    /// Force of the surfaces on it [N].
    pub force: Vector3<f64>,
}

/// A surface at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceRow {
    /// W_V [m3].
    pub wear_volume: f64,
    /// Largest depth that a node has reached [m].
    pub max_depth: f64,
}

/// The writer.
#[derive(Debug)]
pub struct History {
    table: csv::Writer<PartialFile>,
    columns: Columns,
    path: PathBuf,
    fields: Vec<String>,
}

impl History {
    /// Opens the history and writes its header.
    ///
    /// # Errors
    /// The file system refuses.
    pub fn create(path: &Path, columns: Columns) -> Result<Self, ReportError> {
        let mut table = csv::Writer::from_writer(PartialFile::create(path)?);
        table.write_record(columns.names()).map_err(|e| csv_error(path, e))?;
        Ok(Self { table, columns, path: path.to_owned(), fields: Vec::new() })
    }

    /// Adds a row.
    ///
    /// # Errors
    /// The row does not have the columns of the header, or the file system refuses.
    pub fn push(&mut self, row: &Row<'_>) -> Result<(), ReportError> {
        self.check("bodies", self.columns.bodies.len(), row.bodies.len())?;
        self.check("surfaces", self.columns.surfaces.len(), row.surfaces.len())?;
        self.check("carriers", self.columns.carriers.len(), row.carriers.len())?;
        let energies = usize::from(row.energies.is_some());
        self.check("sets of energies", usize::from(self.columns.energies), energies)?;
        self.fields.clear();
        self.fields.extend(row.values().map(plain));
        self.table.write_record(&self.fields).map_err(|e| csv_error(&self.path, e))
    }

    /// Gives the file its final name.
    ///
    /// # Errors
    /// The file system refuses.
    pub fn finish(self) -> Result<(), ReportError> {
        let path = self.path;
        let into_inner = self.table.into_inner();
        into_inner
            .map_err(|e| ReportError::File {
                action: FileAction::Write,
                path,
                source: e.into_error(),
            })?
            .finish()
    }

    fn check(&self, what: &'static str, expected: usize, found: usize) -> Result<(), ReportError> {
        match expected == found {
            true => Ok(()),
            false => Err(ReportError::Row { path: self.path.clone(), what, expected, found }),
        }
    }
}

/// The shortest text that reads back as the same number.
pub(crate) fn plain(value: f64) -> String {
    match value == 0.0 || (1e-3..1e6).contains(&value.abs()) {
        true => value.to_string(),
        false => format!("{value:e}"),
    }
}

pub(crate) fn csv_error(path: &Path, error: csv::Error) -> ReportError {
    let source = match error.into_kind() {
        csv::ErrorKind::Io(source) => source,
        other => io::Error::other(format!("{other:?}")),
    };
    ReportError::File { action: FileAction::Write, path: path.to_owned(), source }
}

/// Columns of a motion, in the order of [`motion_values`].
const MOTION: [&str; 9] =
    ["x_m", "y_m", "z_m", "vx_m_s", "vy_m_s", "vz_m_s", "wx_rad_s", "wy_rad_s", "wz_rad_s"];
/// Columns of a body's force.
const FORCE: [&str; 3] = ["fx_N", "fy_N", "fz_N"];
const SURFACE: [&str; 2] = ["wear_volume_m3", "max_depth_m"];
const ENERGIES: [&str; 10] = [
    "initial_J",
    "kinetic_J",
    "elastic_J",
    "friction_J",
    "wear_J",
    "damping_J",
    "external_work_J",
    "history_J",
    "adhesion_J",
    "numerical_J",
];

impl Columns {
    /// The header: `time_s`, then `ball_x_m` and its like per body, `plate_wear_volume_m3` and its
    /// like per surface, `cube_x_m` and its like per surface that moves, `kinetic_J` and its like
    /// when the ledger is kept.
    pub fn names(&self) -> Vec<String> {
        let prefixed = |owner: &String, columns: &[&str]| {
            columns.iter().map(|column| format!("{owner}_{column}")).collect::<Vec<_>>()
        };
        let mut names = vec!["time_s".to_owned()];
        let body = [&MOTION[..], &FORCE].concat();
        names.extend(self.bodies.iter().flat_map(|name| prefixed(name, &body)));
        names.extend(self.surfaces.iter().flat_map(|name| prefixed(name, &SURFACE)));
        names.extend(self.carriers.iter().flat_map(|name| prefixed(name, &MOTION)));
        if self.energies {
            names.extend(ENERGIES.map(str::to_owned));
        }
        names
    }
}

impl Row<'_> {
    fn values(&self) -> impl Iterator<Item = f64> {
        std::iter::once(self.time)
            .chain(self.bodies.iter().flat_map(BodyRow::values))
            .chain(self.surfaces.iter().flat_map(|s| [s.wear_volume, s.max_depth]))
            .chain(self.carriers.iter().flat_map(motion_values))
            .chain(self.energies.into_iter().flat_map(energy_values))
    }
}

impl BodyRow {
    fn values(&self) -> impl Iterator<Item = f64> {
        motion_values(&self.state).chain(<[f64; 3]>::from(self.force))
    }
}

fn motion_values(state: &State) -> impl Iterator<Item = f64> + use<> {
    let State { position, velocity, spin, .. } = *state;
    let parts: [[f64; 3]; 3] = [position.coords.into(), velocity.into(), spin.into()];
    parts.into_iter().flatten()
}

fn energy_values(e: &EnergySummary) -> [f64; 10] {
    [
        e.initial,
        e.kinetic,
        e.elastic,
        e.friction,
        e.wear,
        e.damping,
        e.external_work,
        e.history,
        e.adhesion,
        e.numerical,
    ]
}

#[cfg(test)]
mod tests;

//! `impacts.csv`: a row per impact that is over, with what was worn and what closed-form laws say. The file
//! carries a temporary name until [`Impacts::finish`].

use std::path::{Path, PathBuf};

use crate::atomic::PartialFile;
use crate::error::{FileAction, ReportError};
use crate::history::{csv_error, plain};

/// An impact that is over.
#[derive(Clone, Debug, PartialEq)]
pub struct Impact<'a> {
    /// Time of the touch since the run began [s]; of bodies that the contact integrator does not carry,
    /// when the engine's step of the touch began.
    pub time: f64,
    /// Name of the body, as the scene writes it.
    pub body: &'a str,
    /// Name of the first surface that it touched.
    pub surface: &'a str,
    /// Mass of the body [kg].
    pub mass: f64,
    /// Speed over the surface at the touch [m/s].
    pub speed: f64,
    /// Angle from the surface at the touch [deg].
    pub angle: f64,
    /// Volume that the impact displaced [m3].
    pub wear_volume: f64,
    /// What each law says [m3], in the order of the columns.
    pub predicted: &'a [f64],
}

/// The writer.
#[derive(Debug)]
pub struct Impacts {
    table: csv::Writer<PartialFile>,
    path: PathBuf,
}

/// Columns before those of the laws.
const COLUMNS: [&str; 7] =
    ["time_s", "body", "surface", "mass_kg", "speed_m_s", "angle_deg", "wear_volume_m3"];

impl Impacts {
    /// Opens the table and writes its header: the columns of an impact, then `finnie-1960_m3` and its like
    /// per law.
    ///
    /// # Errors
    /// The file system refuses.
    pub fn create<'a>(
        path: &Path,
        laws: impl IntoIterator<Item = &'a str>,
    ) -> Result<Self, ReportError> {
        let mut table = csv::Writer::from_writer(PartialFile::create(path)?);
        let laws = laws.into_iter().map(|law| format!("{law}_m3"));
        let head: Vec<String> = COLUMNS.map(str::to_owned).into_iter().chain(laws).collect();
        table.write_record(head).map_err(|error| csv_error(path, error))?;
        Ok(Self { table, path: path.to_owned() })
    }

    /// Adds a row.
    ///
    /// # Errors
    /// The row has other columns than the header, or the file system refuses.
    pub fn push(&mut self, impact: &Impact<'_>) -> Result<(), ReportError> {
        let Impact { time, body, surface, mass, speed, angle, wear_volume, predicted } = impact;
        let numbers = [*mass, *speed, *angle, *wear_volume].map(plain);
        let names = [*body, *surface].map(str::to_owned);
        let laws = predicted.iter().map(|value| plain(*value));
        let row = std::iter::once(plain(*time)).chain(names).chain(numbers).chain(laws);
        self.table.write_record(row).map_err(|error| csv_error(&self.path, error))
    }

    /// Gives the file its final name.
    ///
    /// # Errors
    /// The file system refuses.
    pub fn finish(self) -> Result<(), ReportError> {
        let path = self.path;
        let whole = self.table.into_inner().map_err(|error| ReportError::File {
            action: FileAction::Write,
            path,
            source: error.into_error(),
        });
        whole?.finish()
    }
}

//! Clump files: a union of spheres in any of the formats that clump generators and particle codes
//! write, read by one tolerant reader.
//!
//! Lines of `x y z r` (CLUMP, LIGGGHTS multisphere, DEM-Engine), the folder that MClump writes,
//! Kratos clusters, LAMMPS molecules. Lengths are in the file's own unit.

mod error;
mod kratos;
mod lammps;
mod lines;
mod mclump;
mod properties;
mod rows;
mod write;

use std::path::{Path, PathBuf};

use abrade::Ball;
use nalgebra::{Matrix3, Point3};

use crate::unread::unread;

pub use error::{ClumpError, LineTrouble};
pub use properties::{Properties, Report, Source};
pub use write::write;

/// A clump as its file gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct ClumpFile {
    /// The file.
    pub path: PathBuf,
    /// Its format.
    pub format: Format,
    /// The spheres, in the file's unit.
    pub spheres: Vec<Ball>,
    /// Mass properties that the file gives itself.
    pub given: Given,
}

/// Formats of clump files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Lines of x, y, z, radius, separated by blanks, tabs, commas or semicolons.
    Xyzr,
    /// The same with commas and a header line.
    Csv,
    /// The folder that MClump writes: spheres in `Clump/Clump.txt`, properties in `Inertia`.
    MClump,
    /// A cluster of Kratos (`.clu`).
    Kratos,
    /// A molecule of LAMMPS.
    Lammps,
}

/// Mass properties that a file gives, as far as it does, in the file's units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Given {
    /// Mass.
    pub mass: Option<f64>,
    /// Volume.
    pub volume: Option<f64>,
    /// Centre of mass.
    pub centre: Option<Point3<f64>>,
    /// Inertia tensor about the centre of mass, per mass.
    pub tensor_per_mass: Option<Matrix3<f64>>,
}

/// Reads a clump file, or the folder of an MClump clump.
///
/// # Errors
/// A file that cannot be read, or a line that does not say what its place demands.
pub fn read(path: &Path) -> Result<ClumpFile, ClumpError> {
    if path.is_dir() {
        return mclump::read(path);
    }
    let clump = parse(path, &text_of(path)?)?;
    match clump.format {
        Format::Xyzr | Format::Csv => mclump::complete(clump),
        _ => Ok(clump),
    }
}

/// Reads the text of a clump file; `path` serves messages alone.
///
/// # Errors
/// A line that does not say what its place demands.
pub fn parse(path: &Path, text: &str) -> Result<ClumpFile, ClumpError> {
    let has = |word: &str| text.lines().any(|line| line.trim_start().starts_with(word));
    let clump = if has("Begin centers_and_radii") {
        kratos::parse(path, text)?
    } else if has("Coords") {
        lammps::parse(path, text)?
    } else {
        rows::parse(path, text)?
    };
    match clump.spheres.is_empty() {
        true => Err(ClumpError::Empty { path: path.to_owned() }),
        false => Ok(clump),
    }
}

fn text_of(path: &Path) -> Result<String, ClumpError> {
    let bytes = std::fs::read(path).map_err(|error| ClumpError::Unreadable {
        path: path.to_owned(),
        reason: unread(path, &error),
    })?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

impl ClumpFile {
    /// This clump with every length multiplied by `factor`.
    pub fn scaled(mut self, factor: f64) -> Self {
        for sphere in &mut self.spheres {
            sphere.centre *= factor;
            sphere.radius *= factor;
        }
        let given = &mut self.given;
        given.volume = given.volume.map(|volume| volume * factor.powi(3));
        given.centre = given.centre.map(|centre| centre * factor);
        given.tensor_per_mass = given.tensor_per_mass.map(|tensor| tensor * factor * factor);
        self
    }
}

impl Format {
    /// Name for messages and the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Xyzr => "xyzr",
            Self::Csv => "csv",
            Self::MClump => "mclump",
            Self::Kratos => "kratos",
            Self::Lammps => "lammps",
        }
    }
}

#[cfg(test)]
mod tests;

//! What the folder of a run holds: its summary, the series of its surfaces and bodies.

use std::fs;
use std::path::{Path, PathBuf};

use abrade_report::{Series, Summary};

use crate::error::ViewError;

/// The files of a run.
#[derive(Debug)]
pub(crate) struct RunFolder {
    pub(crate) folder: PathBuf,
    pub(crate) summary: Summary,
    /// Instants that every series has [s].
    pub(crate) times: Vec<f64>,
    /// Name of a surface, or of all copies of one, and its file at each instant; by name.
    pub(crate) surfaces: Vec<(String, Vec<PathBuf>)>,
    /// The file of all bodies at each instant.
    pub(crate) bodies: Option<Vec<PathBuf>>,
}

impl RunFolder {
    pub(crate) fn open(folder: &Path) -> Result<Self, ViewError> {
        let summary = folder.join("summary.json");
        if !summary.is_file() {
            return Err(ViewError::NoRun { folder: folder.to_owned() });
        }
        let summary = Summary::read(&summary)?;
        let mut surfaces = Vec::new();
        for (name, path) in surface_lists(folder, &summary) {
            surfaces.push((name, Series::read(&path)?));
        }
        if surfaces.is_empty() {
            let every = fitting_interval(summary.simulated);
            return Err(ViewError::NoSurface { folder: folder.to_owned(), every });
        }
        let bodies = folder.join("bodies.pvd");
        let bodies = bodies.is_file().then(|| Series::read(&bodies)).transpose()?;
        let all: Vec<_> = surfaces.iter().map(|(_, list)| list).chain(&bodies).collect();
        let times = common_times(&all);
        if times.is_empty() {
            return Err(ViewError::NoInstant { folder: folder.to_owned() });
        }
        let files = |list: Vec<(f64, PathBuf)>| {
            list.into_iter().take(times.len()).map(|(_, path)| path).collect::<Vec<_>>()
        };
        let surfaces = surfaces.into_iter().map(|(name, list)| (name, files(list))).collect();
        let bodies = bodies.map(files);
        Ok(Self { folder: folder.to_owned(), summary, times, surfaces, bodies })
    }
}

/// The lists of surfaces in the folder, by the names of their surfaces.
fn surface_lists(folder: &Path, summary: &Summary) -> Vec<(String, PathBuf)> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut lists: Vec<_> = entries
        .filter_map(|entry| {
            let file = entry.file_name().into_string().ok()?;
            let name = file.strip_prefix("surface")?.strip_suffix(".pvd")?;
            let name = match name.strip_prefix('_') {
                Some(name) => name.to_owned(),
                None if name.is_empty() => only_name(summary),
                None => return None,
            };
            Some((name, entry.path()))
        })
        .collect();
    lists.sort();
    lists
}

/// Name of the only surface of a run, or of what all of them are copies of.
fn only_name(summary: &Summary) -> String {
    let mut names = summary.surfaces.keys();
    match (names.next(), names.next()) {
        (Some(name), None) => name.clone(),
        (Some(copy), Some(_)) => match copy.rsplit_once('_') {
            Some((name, number)) if number.parse::<u64>().is_ok() => name.to_owned(),
            _ => copy.clone(),
        },
        (None, _) => "surface".to_owned(),
    }
}

/// The instants at the start of the lists that all of them have: a run that broke off may have
/// left one list longer than another.
fn common_times(lists: &[&Vec<(f64, PathBuf)>]) -> Vec<f64> {
    let Some((first, others)) = lists.split_first() else { return Vec::new() };
    let agree = |(number, (time, _)): &(usize, &(f64, PathBuf))| {
        others.iter().all(|list| list.get(*number).is_some_and(|(other, _)| other == time))
    };
    first.iter().enumerate().take_while(agree).map(|(_, (time, _))| *time).collect()
}

/// A fiftieth of `simulated` [s] to one digit, with its unit as a scene takes it.
fn fitting_interval(simulated: f64) -> String {
    const INSTANTS: f64 = 50.0;
    let every = simulated / INSTANTS;
    let units = [(1.0, "s"), (1e-3, "ms"), (1e-6, "us"), (1e-9, "ns")];
    let (size, unit) = units.into_iter().find(|(size, _)| every >= *size).unwrap_or((1e-9, "ns"));
    let value = every / size;
    let decade = 10.0_f64.powi(value.max(1.0).log10().floor() as i32);
    format!("{} {unit}", (value / decade).round().max(1.0) * decade)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for an advice with digits that nobody would write, or in a unit that is off.
    #[test]
    fn the_advised_interval_is_round() {
        let cases = [(2.9e-5, "600 ns"), (0.5, "10 ms"), (61.4e-3, "1 ms"), (0.0, "1 ns")];
        for (simulated, expected) in cases {
            assert_eq!(fitting_interval(simulated), expected);
        }
    }

    /// Fails for lists paired by place alone, or for one that is cut to the shorter without a look.
    #[test]
    fn instants_count_while_every_list_has_them() {
        let list = |times: &[f64]| times.iter().map(|time| (*time, PathBuf::new())).collect();
        let (long, short, other) = (list(&[0.0, 1.0, 2.0]), list(&[0.0, 1.0]), list(&[0.0, 1.5]));
        assert_eq!(common_times(&[&long, &short]), [0.0, 1.0]);
        assert_eq!(common_times(&[&long, &other]), [0.0]);
    }
}

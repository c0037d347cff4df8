//! The way back from `history.csv`: where bodies were.

use std::path::Path;

use nalgebra::Point3;

use super::csv_error;
use crate::error::{FileAction, ReportError};

/// Where each of the bodies called `names` was [m], row after row of the history at `path`.
///
/// # Errors
/// The file system refuses, a column is missing or an entry is no number.
pub fn read_places(path: &Path, names: &[String]) -> Result<Vec<Vec<Point3<f64>>>, ReportError> {
    let file = std::fs::File::open(path).map_err(ReportError::file(FileAction::Read, path))?;
    let mut table = csv::Reader::from_reader(std::io::BufReader::new(file));
    let damaged = |missing: String| ReportError::Damaged { path: path.to_owned(), missing };
    let header = table.headers().map_err(|error| csv_error(path, error))?.clone();
    let column =
        |name: String| header.iter().position(|found| found == name).ok_or_else(|| damaged(name));
    let mut columns = Vec::with_capacity(names.len());
    for name in names {
        let of = |axis: &str| column(format!("{name}_{axis}_m"));
        columns.push([of("x")?, of("y")?, of("z")?]);
    }
    let mut places = vec![Vec::new(); names.len()];
    let mut record = csv::StringRecord::new();
    while table.read_record(&mut record).map_err(|error| csv_error(path, error))? {
        for (places, columns) in places.iter_mut().zip(&columns) {
            let entry = |column: usize| record.get(column)?.parse().ok();
            let [x, y, z] = columns.map(entry);
            let place = x.zip(y).zip(z).map(|((x, y), z)| Point3::new(x, y, z));
            let line = record.position().map_or(0, csv::Position::line);
            places.push(place.ok_or_else(|| damaged(format!("a number in line {line}")))?);
        }
    }
    Ok(places)
}

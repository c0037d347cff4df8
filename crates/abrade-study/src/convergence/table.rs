//! The study as `study.csv`, and as a table to read.

use std::fmt::Write as _;
use std::path::Path;

use abrade_report::quantity_text::{digits, time};
use abrade_report::{ReportError, atomic};
use abrade_scene::Precision;

use crate::convergence::Study;
use crate::convergence::cheapest::Cheapest;
use crate::convergence::compare::{Curve, Row};
use crate::convergence::ladder::Variant;
use crate::convergence::quantities::NAMES;
use crate::error::StudyError;
use crate::sets;

/// Writes every row of `study`, a unit in every column name; the last column holds the
/// arguments of `abrade run SCENE` that make the first of its landings again.
pub(crate) fn write(study: &Study, path: &Path) -> Result<(), StudyError> {
    let mut table = csv::Writer::from_writer(Vec::new());
    let errors = NAMES.map(|name| format!("error_{name}"));
    let head = [
        "varied",
        "value",
        "precision",
        "landings",
        "wall_s",
        "steps",
        "node_evaluations",
        "wear_volume_m3",
        "max_depth_m",
        "peak_normal_force_N",
        "wear_rate_m2",
        "total_error_wear",
        "estimate_time",
        "estimate_pitch",
        "fitted",
    ];
    let head = head.into_iter().map(str::to_owned).chain(errors);
    let head = head.chain(["failure".to_owned(), "arguments".to_owned()]);
    let mut put =
        |record: Vec<String>| table.write_record(record).map_err(|error| in_csv(path, error));
    put(head.collect())?;
    for curve in &study.curves {
        for row in &curve.rows {
            put(record(study, curve, row))?;
        }
    }
    let bytes = table.into_inner().map_err(|error| ReportError::File {
        action: abrade_report::FileAction::Write,
        path: path.to_owned(),
        source: error.into_error(),
    })?;
    Ok(atomic::write(path, &bytes)?)
}

fn in_csv(path: &Path, error: csv::Error) -> StudyError {
    let source = std::io::Error::other(error);
    let action = abrade_report::FileAction::Write;
    StudyError::Report(ReportError::File { action, path: path.to_owned(), source })
}

fn record(study: &Study, curve: &Curve, row: &Row) -> Vec<String> {
    let number = |value: f64| if value.is_finite() { format!("{value:e}") } else { String::new() };
    let some = |value: Option<f64>| value.map_or_else(String::new, number);
    let mean = &row.mean;
    let ran = row.failure.is_none();
    let value = |value: f64| if ran { number(value) } else { String::new() };
    let precision = match row.rung.precision {
        Precision::Single => "f32",
        Precision::Double => "f64",
    };
    let mut record = vec![
        curve.variant.name().to_owned(),
        number(row.rung.value),
        precision.to_owned(),
        row.landings.to_string(),
        value(row.wall),
        value(row.steps),
        value(row.node_evaluations),
        value(mean.wear),
        value(mean.depth),
        value(mean.force),
        some(mean.rate),
        some(row.total),
        some(row.estimates[0]),
        some(row.estimates[1]),
        row.is_fitted.to_string(),
    ];
    record.extend(row.errors.array().map(some));
    record.push(row.failure.clone().unwrap_or_default());
    record.push(arguments(&study.sets, row.rung.precision, &row.rung.sets));
    record
}

/// Columns of the table to read, with their widths.
const HEAD: [(&str, usize); 12] = [
    ("", 11),
    ("time", 9),
    ("steps", 8),
    ("wear mm3", 11),
    ("error", 9),
    ("total", 9),
    ("depth", 9),
    ("force", 9),
    ("wear rate", 9),
    ("restit.", 9),
    ("angle deg", 9),
    ("spin", 9),
];

/// The curves, one block each, then the settings to take.
pub(crate) fn text(study: &Study) -> String {
    let mut text = format!(
        "{}\nerrors of the wear volume, total ones against {}\n",
        study.scene, study.reference
    );
    let used: Vec<bool> = (0..HEAD.len()).map(|at| is_used(study, at)).collect();
    for curve in &study.curves {
        let _ = write!(text, "\n{}", head(curve));
        let mut line = String::new();
        for ((name, width), _) in HEAD.iter().zip(&used).filter(|(_, used)| **used) {
            let name = if name.is_empty() { curve.variant.counts() } else { name };
            let _ = write!(line, "{name:>width$}", width = width + 2);
        }
        let _ = writeln!(text, "{}", line.trim_end());
        for row in &curve.rows {
            let _ = writeln!(text, "{}", read(row, &used));
        }
        if is_bounded(curve) {
            text.push_str("  settings alike: the stiffness that follows is at a bound\n");
        }
        if curve.left_out > 0 {
            let _ = writeln!(text, "  {} finer settings left out: the budget", curve.left_out);
        }
    }
    text.push('\n');
    for (told, name) in study.told.iter().zip(["time", "pitch"]) {
        text.push_str(&told.words(name));
    }
    for cheapest in &study.cheapest {
        text.push_str(&advice(study, cheapest));
    }
    text
}

/// True where another modulus gave the same to the bit.
fn is_bounded(curve: &Curve) -> bool {
    let alike = |pair: &[Row]| pair[0].failure.is_none() && pair[0].mean == pair[1].mean;
    curve.variant == Variant::Young && curve.rows.windows(2).any(alike)
}

fn head(curve: &Curve) -> String {
    let exponent = |name: &str, value: Option<f64>| {
        value.map_or_else(String::new, |q| format!("; error ~ {name}^{q:.1}"))
    };
    let number = curve.variant.counts().trim_end_matches(" x");
    format!(
        "{}{}{}\n",
        curve.variant.name(),
        exponent(number, curve.order),
        exponent("time", curve.slope)
    )
}

/// The cells of a row, in the order of [`HEAD`].
fn cells(row: &Row) -> [Option<String>; 12] {
    let error = |value: Option<f64>| value.map(|value| format!("{value:.1e}"));
    let [wear, depth, force, rate, restitution, angle, spin] = row.errors.array();
    [
        Some(digits(row.rung.value)),
        Some(time(row.wall)),
        Some(format!("{:.0}", row.steps)),
        Some(format!("{:.5e}", 1e9 * row.mean.wear)),
        error(wear),
        error(row.total),
        error(depth),
        error(force),
        error(rate),
        error(restitution),
        angle.map(|angle| format!("{angle:.1e}")),
        error(spin),
    ]
}

fn is_used(study: &Study, at: usize) -> bool {
    study.curves.iter().flat_map(|curve| &curve.rows).any(|row| cells(row)[at].is_some())
}

fn read(row: &Row, used: &[bool]) -> String {
    if let Some(failure) = &row.failure {
        return format!("{:>width$}  {failure}", digits(row.rung.value), width = HEAD[0].1 + 2);
    }
    let mut line = String::new();
    for ((cell, (_, width)), _) in cells(row).iter().zip(HEAD).zip(used).filter(|(_, used)| **used)
    {
        let cell = cell.as_deref().unwrap_or("-");
        let _ = write!(line, "{cell:>width$}", width = width + 2);
    }
    line
}

fn advice(study: &Study, cheapest: &Cheapest) -> String {
    let target = 100.0 * cheapest.target;
    match &cheapest.setting {
        None => format!("for {target} %: no setting of this study\n"),
        Some((variant, rung, wall, total)) => {
            let again = arguments(&study.sets, rung.precision, &rung.sets);
            let (name, wall) = (variant.name(), time(*wall));
            format!("for {target} %: {name}, {wall}, error {total:.1e}: {again}\n")
        }
    }
}

/// What runs a setting again, behind `abrade run SCENE`.
fn arguments(given: &[String], precision: Precision, own: &[String]) -> String {
    let mut sets = given.to_vec();
    sets.extend_from_slice(own);
    let told = sets::told(&sets);
    match precision {
        Precision::Double => told,
        Precision::Single => format!("--precision f32 {told}"),
    }
}

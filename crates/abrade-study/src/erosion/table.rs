//! What a study found, as files and as a table to read: `cases.csv` and `cases.jsonl` with one line per
//! case, `grains.csv` with the shapes.

use std::fmt::Write as _;
use std::path::Path;

use abrade_report::quantity_text::digits;
use abrade_report::{FileAction, ReportError, atomic};
use serde_json::{Map, Value, json};

use super::quantities::ALL;
use super::statistics::Estimate;
use super::summary::{CaseResult, Erosion};

/// Writes the files into `folder`.
pub(crate) fn write(erosion: &Erosion, folder: &Path) -> Result<(), ReportError> {
    let cases: Vec<Map<String, Value>> =
        erosion.cases.iter().map(|case| record(erosion, case)).collect();
    write_csv(&cases, &folder.join("cases.csv"))?;
    let lines: String =
        cases.into_iter().map(|case| format!("{}\n", Value::Object(case))).collect();
    atomic::write(&folder.join("cases.jsonl"), lines.as_bytes())?;
    let grains: Vec<Map<String, Value>> = erosion
        .grains
        .iter()
        .map(|(name, descriptors)| {
            let mut record = Map::from_iter([("grain".to_owned(), json!(name))]);
            if let Ok(Value::Object(values)) = serde_json::to_value(descriptors) {
                record.extend(values);
            }
            record
        })
        .collect();
    write_csv(&grains, &folder.join("grains.csv"))
}

/// All values of a case, by the names of their columns.
fn record(erosion: &Erosion, result: &CaseResult) -> Map<String, Value> {
    let case = &result.case;
    let mut record = Map::new();
    let mut put = |name: &str, value: Value| record.insert(name.to_owned(), value);
    put("case", json!(case.number));
    put("grain", json!(case.grain));
    put("speed_m_s", json!(case.speed));
    put("angle_deg", json!(case.angle.to_degrees()));
    put("impacts", json!(result.impacts));
    put("missed", json!(result.missed.as_ref().map_or(0, |(count, _)| *count)));
    put("pitch_m", json!(result.pitch));
    let exponent =
        erosion.exponents.iter().find(|e| e.grain == case.grain && e.angle == case.angle);
    let mut estimates: Vec<(&str, Option<Estimate>)> = ALL
        .iter()
        .map(|quantity| quantity.name)
        .zip(result.quantities.iter().copied().map(Some))
        .collect();
    estimates.push(("wear_ratio", result.wear_ratio));
    estimates.push(("removed_ratio", result.removed_ratio));
    estimates.push(("speed_exponent", exponent.map(|exponent| exponent.wear)));
    for (name, estimate) in estimates {
        put(name, json!(estimate.map(|estimate| estimate.value)));
        put(&format!("{name}_ci95"), json!(estimate.map(|estimate| estimate.half_width)));
    }
    record
}

/// Writes records of the same keys as lines below their names.
fn write_csv(records: &[Map<String, Value>], path: &Path) -> Result<(), ReportError> {
    let failed = |error: std::io::Error| ReportError::File {
        action: FileAction::Write,
        path: path.to_owned(),
        source: error,
    };
    let mut table = csv::Writer::from_writer(Vec::new());
    let text = |value: &Value| match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        value => value.to_string(),
    };
    let mut put = |line: Vec<String>| table.write_record(line).map_err(|e| failed(e.into()));
    if let Some(first) = records.first() {
        put(first.keys().cloned().collect())?;
    }
    for record in records {
        put(record.values().map(text).collect())?;
    }
    let bytes = table.into_inner().map_err(|error| failed(error.into_error()))?;
    atomic::write(path, &bytes)
}

/// A case's columns to read, with their widths.
const HEAD: [(&str, usize); 10] = [
    ("angle", 6),
    ("impacts", 8),
    ("displaced mm3/kg", 18),
    ("over ref.", 14),
    ("debris mm3/kg", 18),
    ("over ref.", 14),
    ("in wear", 7),
    ("depth um", 9),
    ("restit.", 8),
    ("turns on", 9),
];

impl Erosion {
    /// The study as a table to read.
    pub fn table(&self) -> String {
        let reference = self.file.reference.as_deref().unwrap_or("none");
        let mut text = format!(
            "{}\n+- is half of the 95 % interval; the reference is: {reference}\n",
            self.file.name
        );
        let mut last = None;
        for result in &self.cases {
            let case = &result.case;
            if last != Some((&case.grain, case.speed)) {
                last = Some((&case.grain, case.speed));
                let _ = writeln!(text, "\n{} at {} m/s", case.grain, digits(case.speed));
                let mut line = String::new();
                for (name, width) in HEAD {
                    let _ = write!(line, "  {name:>width$}");
                }
                let _ = writeln!(text, "{line}");
            }
            let _ = writeln!(text, "{}", line(result));
        }
        for exponent in &self.exponents {
            let _ = writeln!(
                text,
                "{} at {} deg: wear ~ V^({})",
                exponent.grain,
                digits(exponent.angle.to_degrees()),
                told(&exponent.wear)
            );
        }
        if let Some(wide) = self.wide() {
            let _ = writeln!(text, "{wide}");
        }
        text
    }
}

fn line(result: &CaseResult) -> String {
    let value = |name: &str| result.quantity(name).value;
    let ratio = |ratio: &Option<Estimate>| ratio.as_ref().map_or(NONE.to_owned(), told);
    let cells = [
        digits(result.case.angle.to_degrees()),
        result.impacts.to_string(),
        told(&result.quantity("wear_mm3_per_kg")),
        ratio(&result.wear_ratio),
        told(&result.quantity("removed_mm3_per_kg")),
        ratio(&result.removed_ratio),
        fixed(value("wear_energy_share"), 3),
        fixed(1e6 * value("depth_m"), 2),
        fixed(value("restitution"), 3),
        percent(value("forward_share"), 0),
    ];
    let mut line = String::new();
    for (cell, (_, width)) in cells.iter().zip(HEAD) {
        let _ = write!(line, "  {cell:>width$}");
    }
    match &result.missed {
        Some((count, why)) => format!("{line}  {count} without a result: {why}"),
        None => line,
    }
}

/// `value` with this many decimal `places`, if there is one.
pub(crate) fn fixed(value: f64, places: usize) -> String {
    if value.is_finite() { format!("{value:.places$}") } else { NONE.to_owned() }
}

/// The share `value` in percent.
pub(crate) fn percent(value: f64, places: usize) -> String {
    format!("{} %", fixed(100.0 * value, places))
}

/// What stands where there is no value.
const NONE: &str = "-";
/// What stands for a volume that is zero: no impact displaced or lost any.
pub(crate) const NOTHING: &str = "none";

/// Value +- half width, to the digits that the half width leaves.
pub(crate) fn told(estimate: &Estimate) -> String {
    let Estimate { value, half_width } = *estimate;
    if !value.is_finite() {
        return NONE.to_owned();
    }
    if value == 0.0 {
        return NOTHING.to_owned();
    }
    if !half_width.is_finite() {
        return digits(value);
    }
    if half_width == 0.0 {
        return format!("{} +- {half_width}", digits(value));
    }
    let places = (1.0 - half_width.log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{value:.places$} +- {half_width:.places$}")
}

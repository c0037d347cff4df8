//! What a study of erosion holds and how large it is: in rows, or in a line.

use abrade_report::quantity_text::{count, digits, length};
use abrade_study::erosion::{self, Plate, Size, StudyFile};

use crate::scene_text::row;

/// What stands in a row per list of the study.
pub(crate) fn rows(file: &StudyFile) -> String {
    let StudyFile { grains, speeds, angles, samples, .. } = file;
    let names: Vec<&str> = grains.keys().map(String::as_str).collect();
    let size = match file.size {
        Size::Volume { diameter, .. } => format!("a sphere of {}", length(diameter)),
        Size::Feret { diameter, .. } => format!("{} at their longest", length(diameter)),
    };
    let plate = match file.plate {
        Plate::Fresh => "fresh for every impact".to_owned(),
        Plate::Worn { width } => format!("worn by those before, over {}", length(width)),
    };
    let cases = file.cases().len();
    let listed = |values: &[f64], unit: &str| {
        let values: Vec<String> = values.iter().map(|value| digits(*value)).collect();
        format!("{} {unit}", values.join(", "))
    };
    let degrees: Vec<f64> = angles.iter().map(|angle| angle.to_degrees()).collect();
    let [least, most] = bounds(file);
    let each = range(samples.least, samples.most);
    let all = range(least, most);
    let mut rows = vec![
        row("study", file.name.clone()),
        row("cases", format!("{cases}: every grain at every speed and angle")),
        row("grains", format!("{}: {}; {size}", grains.len(), names.join(", "))),
        row("speeds", format!("{}: {}", speeds.len(), listed(speeds, "m/s"))),
        row("angles", format!("{}: {}", angles.len(), listed(&degrees, "deg"))),
        row("impacts", format!("{all} in all, {each} in each case; the plate is {plate}")),
    ];
    rows.extend(erosion::notes(file).into_iter().map(|note| row("note", note)));
    rows.concat()
}

/// The whole of it in a line.
pub(crate) fn line(file: &StudyFile) -> String {
    let mut parts = vec![
        "erosion study".to_owned(),
        count(file.cases().len(), "case", "cases"),
        format!("{} impacts at most", bounds(file)[1]),
    ];
    let notes = erosion::notes(file).len();
    if notes > 0 {
        parts.push(count(notes, "note", "notes"));
    }
    parts.join(", ")
}

/// From `least` to `most`, or one number where they are the same.
fn range(least: impl ToString, most: impl ToString) -> String {
    let [least, most] = [least.to_string(), most.to_string()];
    if least == most { least } else { format!("{least} to {most}") }
}

/// Impacts of all cases together, at least and at most.
fn bounds(file: &StudyFile) -> [u64; 2] {
    let cases = file.cases().len() as u64;
    [file.samples.least, file.samples.most].map(|each| cases * u64::from(each))
}

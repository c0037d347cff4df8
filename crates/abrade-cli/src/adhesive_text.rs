//! How large a scene or a map of two asperities is: in rows, or in a line.

use abrade_report::quantity_text::{count, time};
use abrade_study::adhesive::{MapFile, SceneFile, Size};

use crate::scene_text::row;

/// What a scene holds, in rows.
pub(crate) fn rows(file: &SceneFile) -> String {
    let size = file.size();
    let mut rows = vec![
        row("scene", format!("{}: two asperities", file.name)),
        row("size", extent(&size)),
        row("time", of_core(size.seconds())),
    ];
    rows.extend(file.notes().into_iter().map(|note| row("note", note)));
    rows.concat()
}

/// The whole of it in a line.
pub(crate) fn line(file: &SceneFile) -> String {
    let size = file.size();
    let mut parts = vec!["two asperities".to_owned(), extent(&size), of_core(size.seconds())];
    let notes = file.notes().len();
    if notes > 0 {
        parts.push(count(notes, "note", "notes"));
    }
    parts.join(", ")
}

/// What a map holds, in rows.
pub(crate) fn rows_of_map(file: &MapFile) -> String {
    let (cases, size) = (file.cases().len(), file.size());
    let gaps = count(file.gaps.len(), "gap", "gaps");
    [
        row("map", format!("{}: two asperities", file.name)),
        row("cases", format!("{cases}, from {gaps} at each point")),
        row("size", format!("{} in each case", extent(&size))),
        row("time", of_core(size.seconds() * cases as f64)),
    ]
    .concat()
}

/// The whole of it in a line.
pub(crate) fn line_of_map(file: &MapFile) -> String {
    let (cases, size) = (file.cases().len(), file.size());
    let (each, all) = (extent(&size), of_core(size.seconds() * cases as f64));
    format!("map of two asperities, {}, {each} in each, {all}", count(cases, "case", "cases"))
}

fn extent(size: &Size) -> String {
    let elements = count(size.elements, "element", "elements");
    format!("{elements}, {}", count(size.steps, "step", "steps"))
}

fn of_core(seconds: f64) -> String {
    format!("about {} of a core", time(seconds))
}

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
    parts.extend(notes_counted(&file.notes()));
    parts.join(", ")
}

/// What a map holds, in rows.
pub(crate) fn rows_of_map(file: &MapFile) -> String {
    let (cases, size) = (file.cases().len(), file.size());
    let gaps = count(file.gaps.len(), "gap", "gaps");
    let mut rows = vec![
        row("map", format!("{}: two asperities", file.name)),
        row("cases", format!("{cases}, from {gaps} at each point")),
        row("size", format!("{} in each case", extent(&size))),
        row("time", of_core(size.seconds() * cases as f64)),
    ];
    rows.extend(file.notes().into_iter().map(|note| row("note", note)));
    rows.concat()
}

/// The whole of it in a line.
pub(crate) fn line_of_map(file: &MapFile) -> String {
    let (cases, size) = (file.cases().len(), file.size());
    let (each, all) = (extent(&size), of_core(size.seconds() * cases as f64));
    let cases = count(cases, "case", "cases");
    let mut parts = vec![format!("map of two asperities, {cases}, {each} in each"), all];
    parts.extend(notes_counted(&file.notes()));
    parts.join(", ")
}

fn notes_counted(notes: &[String]) -> Option<String> {
    (!notes.is_empty()).then(|| count(notes.len(), "note", "notes"))
}

fn extent(size: &Size) -> String {
    let elements = count(size.elements, "element", "elements");
    format!("{elements}, {}", count(size.steps, "step", "steps"))
}

fn of_core(seconds: f64) -> String {
    format!("about {} of a core", time(seconds))
}

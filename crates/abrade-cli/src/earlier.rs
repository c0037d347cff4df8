//! What a results folder holds before a command writes into it: an earlier result of abrade is replaced with a
//! note, anything else is left alone.

use std::path::Path;

use abrade_report::quantity_text::{count, time};
use abrade_report::run_files;
use anyhow::anyhow;
use serde_json::Value;

use crate::failure::Failure;
use crate::say;

/// Makes sure that the run `own` may write into `folder`; says so if it replaces another one. Where nobody
/// has `named` the folder, it replaces those of its own name alone.
pub(crate) fn make_way_for_run(folder: &Path, own: &str, named: bool) -> Result<(), Failure> {
    let summary = folder.join("summary.json");
    match run_name(&summary) {
        Some(name) if name != own && !named => {
            return Err(foreign(folder, &format!("the run `{name}`")));
        }
        Some(name) => tell(&format!("the run `{name}`"), &summary, folder),
        // Of a run that was broken off there is nothing to tell.
        None if run_files::is_of_run(folder) || is_empty(folder) => {}
        None => return Err(foreign(folder, "files that are no run's of abrade")),
    }
    Ok(())
}

/// Makes sure that a study of convergence may write into `folder`; says so if it replaces another one.
pub(crate) fn make_way_for_convergence(folder: &Path) -> Result<(), Failure> {
    let table = folder.join("study.csv");
    let head = std::fs::read_to_string(&table).unwrap_or_default();
    if head.lines().next().is_some_and(|line| line.contains(",wall_s,")) {
        tell("the study", &table, folder);
        return Ok(());
    }
    refuse_run(folder)?;
    refuse_any(folder, &["study.csv", "study.png"])
}

/// Makes sure that a study that keeps its cases in `folder`, each in a file of its fingerprint and `end`, may write
/// `tables` there. One of its own goes on.
pub(crate) fn make_way_for_cases(folder: &Path, end: &str, tables: &[&str]) -> Result<(), Failure> {
    let is_fingerprint =
        |text: &str| text.len() == 16 && text.bytes().all(|c| c.is_ascii_hexdigit());
    let cases = folder.join("cases");
    if names(&cases).any(|name| name.strip_suffix(end).is_some_and(is_fingerprint)) {
        return Ok(());
    }
    refuse_run(folder)?;
    refuse_any(folder, tables)
}

/// Says that `others` of the cases in `folder` are none of the study that is made now.
pub(crate) fn tell_others(others: usize, folder: &Path) {
    if others > 0 {
        let others = count(others, "case is", "cases are");
        let place = say::place(folder);
        say::aside(&format!(
            "note: {others} in {place} of another study, or of this one before it changed: they stay there beside \
             those that are made now"
        ));
    }
}

/// True where there is no `folder`, or nothing in it but hidden files.
fn is_empty(folder: &Path) -> bool {
    names(folder).all(|name| name.starts_with('.'))
}

/// Names in `folder`; none where there is none.
fn names(folder: &Path) -> impl Iterator<Item = String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.map(|entry| entry.file_name().to_string_lossy().into_owned())
}

/// What the run is called whose summary lies at `path`, if that is one.
fn run_name(path: &Path) -> Option<String> {
    let summary: Value = serde_json::from_str(&std::fs::read_to_string(path).ok()?).ok()?;
    let name = summary.get("abrade").and_then(|_| summary.get("scene"))?;
    name.as_str().map(str::to_owned)
}

/// Refuses the folder of a run, whose files would be taken for those of a study, and the other way round.
fn refuse_run(folder: &Path) -> Result<(), Failure> {
    match run_name(&folder.join("summary.json")) {
        Some(name) => Err(foreign(folder, &format!("the run `{name}`"))),
        None if run_files::is_of_run(folder) => Err(foreign(folder, "a run that was broken off")),
        None => Ok(()),
    }
}

fn refuse_any(folder: &Path, written: &[&str]) -> Result<(), Failure> {
    match written.iter().find(|name| folder.join(name).exists()) {
        Some(name) => Err(foreign(folder, &format!("{name} of something else"))),
        None => Ok(()),
    }
}

fn foreign(folder: &Path, what: &str) -> Failure {
    Failure::Input(anyhow!(
        "the output folder `{}` holds {what}: name another one with --out, or empty it",
        folder.display()
    ))
}

/// Says that `what`, whose last file is at `path`, is replaced.
fn tell(what: &str, path: &Path, folder: &Path) {
    let age =
        path.metadata().and_then(|file| file.modified()).ok().and_then(|at| at.elapsed().ok());
    let age = age.map_or(String::new(), |age| format!(" of {} ago", time(age.as_secs_f64())));
    let place = say::place(folder);
    say::aside(&format!("note: replaces {what}{age} in {place}; --out DIR keeps both"));
}

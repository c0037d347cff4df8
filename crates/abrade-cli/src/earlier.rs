//! What a results folder holds before a command writes into it: an earlier result of abrade is replaced with a
//! note, anything else is left alone.

use std::path::Path;

use abrade_report::quantity_text::time;
use anyhow::anyhow;
use serde_json::Value;

use crate::failure::Failure;
use crate::say;

/// Endings of what a run leaves that was killed.
const BROKEN: [&str; 3] = [".partial", ".vtp", ".pvd"];

/// Makes sure that a run may write into `folder`; says so if it replaces another one.
pub(crate) fn make_way_for_run(folder: &Path) -> Result<(), Failure> {
    let names = names(folder);
    let summary = folder.join("summary.json");
    match run_name(&summary) {
        Some(name) => tell(&format!("the run `{name}`"), &summary, folder),
        None if names.iter().all(|name| BROKEN.iter().any(|end| name.ends_with(end))) => {}
        None => return Err(foreign(folder, "files that are no run's of abrade")),
    }
    Ok(())
}

/// Makes sure that a study of convergence may write into `folder`; says so if it replaces another one.
pub(crate) fn make_way_for_convergence(folder: &Path) -> Result<(), Failure> {
    let table = folder.join("study.csv");
    let head = std::fs::read_to_string(&table).unwrap_or_default();
    match head.lines().next().is_some_and(|line| line.contains(",wall_s,")) {
        true => tell("the study", &table, folder),
        false => refuse_any(folder, &["study.csv", "study.png"])?,
    }
    Ok(())
}

/// Makes sure that a study that keeps its cases in `folder` may write `tables` there. One of its own goes on.
pub(crate) fn make_way_for_cases(folder: &Path, tables: &[&str]) -> Result<(), Failure> {
    match folder.join("cases").is_dir() {
        true => Ok(()),
        false => refuse_any(folder, tables),
    }
}

/// Names in `folder`, but for hidden ones; none where there is no folder.
fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    names.filter(|name| !name.starts_with('.')).collect()
}

/// What the run is called whose summary lies at `path`, if that is one.
fn run_name(path: &Path) -> Option<String> {
    let summary: Value = serde_json::from_str(&std::fs::read_to_string(path).ok()?).ok()?;
    let of_asperities = summary.get("mode").and_then(|_| summary.get("name"));
    let name = summary.get("abrade").and_then(|_| summary.get("scene")).or(of_asperities)?;
    name.as_str().map(str::to_owned)
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
    let place = folder.display();
    say::aside(&format!("note: replaces {what}{age} in {place}; --out DIR keeps both"));
}

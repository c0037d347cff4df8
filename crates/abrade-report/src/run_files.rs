//! Which files of a folder are a run's: a hidden list of names that a run leaves before all else. By it the folder
//! of a run that was broken off is known, and what of it goes when another run takes its place.

use std::fs;
use std::path::Path;

use crate::error::{FileAction, ReportError};

/// File of the list.
const LIST: &str = ".abrade-run";

/// True where a run has begun in `folder`.
pub fn is_of_run(folder: &Path) -> bool {
    folder.join(LIST).is_file()
}

/// Makes `folder` that of a run that writes files of these `names`, with `a.pvd` those of its series. Files of the
/// run before it go, and nothing else.
///
/// # Errors
/// The file system refuses.
pub fn begin(folder: &Path, names: &[String]) -> Result<(), ReportError> {
    let list = folder.join(LIST);
    // Where no run has begun there is no list, and nothing goes.
    let before = fs::read_to_string(&list).unwrap_or_default();
    let entries = fs::read_dir(folder).map_err(ReportError::file(FileAction::Read, folder))?;
    for entry in entries.flatten() {
        let (path, file) = (entry.path(), entry.file_name().to_string_lossy().into_owned());
        if before.lines().any(|name| is_of(name, &file)) && !path.is_dir() {
            fs::remove_file(&path).map_err(ReportError::file(FileAction::Remove, &path))?;
        }
    }
    let text: String = names.iter().map(|name| format!("{name}\n")).collect();
    fs::write(&list, text).map_err(ReportError::file(FileAction::Write, &list))
}

/// True for a `file` called `name`, a part of one, and one of the series whose list is called so.
fn is_of(name: &str, file: &str) -> bool {
    let part = file.strip_suffix(".partial").and_then(|part| part.rsplit_once('.'));
    let whole = part.map_or(file, |(whole, _)| whole);
    let frame = whole.strip_suffix(".vtp").and_then(|frame| frame.rsplit_once('_'));
    let of_series = frame.is_some_and(|(stem, number)| {
        let is_number = number.len() >= 4 && number.bytes().all(|digit| digit.is_ascii_digit());
        is_number && name.strip_suffix(".pvd") == Some(stem)
    });
    whole == name || of_series
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a run that leaves a frame or half a file of the one before it, and for one that takes what is
    /// not in its list.
    #[test]
    fn a_run_takes_what_the_list_of_the_one_before_it_names() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let begin = |names: &[&str]| {
            let names: Vec<String> = names.iter().map(|&name| name.to_owned()).collect();
            begin(folder.path(), &names).expect("writable");
        };
        let old = ["surface_a.pvd", "surface_a_0000.vtp", "surface_a_10000.vtp", "history.csv"];
        let parts = ["history.csv.7-00ff-0.partial", "surface_a_0001.vtp.7-00ff-1.partial"];
        let mine = ["surface_a.png", "surface_a_cut.vtp", "surface_0000.vtp", "history.csv.bak"];
        for name in old.iter().chain(&parts).chain(&mine) {
            fs::write(folder.path().join(name), "").expect("writable");
        }
        assert!(!is_of_run(folder.path()));
        begin(&["surface_a.pvd", "history.csv"]);
        let is_there = |name: &&&str| folder.path().join(name).exists();
        assert_eq!(old.iter().filter(is_there).count(), old.len(), "no list named them");
        assert!(is_of_run(folder.path()));
        begin(&["summary.json"]);
        assert_eq!(old.iter().chain(&parts).find(is_there), None);
        assert_eq!(mine.iter().filter(is_there).count(), mine.len());
    }
}

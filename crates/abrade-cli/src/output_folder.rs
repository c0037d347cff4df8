//! The results folder: its name, and whether it can be written to, known before anything runs.

use std::path::{Path, PathBuf};

use abrade_report::atomic::process_name;
use anyhow::Context;

use crate::failure::Failure;

/// Folder in which results lie that nobody gave a place.
pub(crate) const RUNS: &str = "runs";

/// Where the results of the file at `path` go: `runs/<its name without the ending>` unless `out`
/// says.
pub(crate) fn chosen(out: Option<&Path>, path: &Path) -> PathBuf {
    chosen_for(out, path, "")
}

/// The same, where `what` is done with a file of which others make something else.
pub(crate) fn chosen_for(out: Option<&Path>, path: &Path, what: &str) -> PathBuf {
    if let Some(out) = out {
        return out.to_owned();
    }
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(what);
    Path::new(RUNS).join(name)
}

/// Makes `folder` and finds out whether it can be written to. Other processes may do the same.
pub(crate) fn make(folder: &Path) -> Result<(), Failure> {
    refused(folder, std::fs::create_dir_all(folder).and_then(|()| try_file(folder)))
}

/// Finds out by trying whether `folder` can be made and written to; leaves nothing behind.
pub(crate) fn probe(folder: &Path) -> Result<(), Failure> {
    let missing: Vec<&Path> = folder
        .ancestors()
        .take_while(|path| !path.as_os_str().is_empty() && !path.exists())
        .collect();
    let tried = std::fs::create_dir_all(folder).and_then(|()| try_file(folder));
    for path in missing {
        // What was made here is empty again; what could not be made is not there.
        let _ = std::fs::remove_dir(path);
    }
    refused(folder, tried)
}

fn try_file(folder: &Path) -> std::io::Result<()> {
    let file = folder.join(format!(".abrade-{}", process_name()));
    std::fs::write(&file, b"").and_then(|()| std::fs::remove_file(&file))
}

fn refused(folder: &Path, tried: std::io::Result<()>) -> Result<(), Failure> {
    tried
        .with_context(|| format!("the output folder `{}` cannot be written to", folder.display()))
        .map_err(Failure::Input)
}

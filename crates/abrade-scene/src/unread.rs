//! Why a file cannot be read, in words: of one that is not there, where it was looked for and what lies there
//! under a like name.

use std::io::{Error, ErrorKind};
use std::path::Path;

use crate::problem::{any_of, near};

/// Names that are told at most.
const NAMES: usize = 3;

/// Why `path` cannot be read, after the file system has said `error`.
pub fn unread(path: &Path, error: &Error) -> String {
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let place = absolute.parent().zip(absolute.file_name());
    let Some((folder, name)) = place.filter(|_| error.kind() == ErrorKind::NotFound) else {
        return error.kind().to_string();
    };
    let entries = match std::fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == ErrorKind::NotFound => {
            return format!("there is no folder `{}`", folder.display());
        }
        Err(_) => return error.kind().to_string(),
    };
    let name = name.to_string_lossy();
    let mut known: Vec<String> = entries
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        // A link that leads nowhere has the name itself.
        .filter(|known| !known.starts_with('.') && *known != name)
        .collect();
    known.sort();
    let mut text = format!("there is no `{name}` in `{}`", folder.display());
    // The endings of all files are alike, and make no names alike.
    let stems = known.iter().map(|name| (stem(name), name.as_str()));
    let likely = near(stem(&name), stems);
    if !likely.is_empty() {
        text += &format!("; did you mean {}?", any_of(likely.into_iter().take(NAMES)));
    }
    text
}

fn stem(name: &str) -> &str {
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

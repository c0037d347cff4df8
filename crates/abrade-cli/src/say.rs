//! Text for the standard output stream, and lines for the standard error stream.

use std::io::{ErrorKind, Write};
use std::path::Path;

use abrade_report::quantity_text::count;
use anyhow::Context;

use crate::failure::Failure;

/// `part of all cases are`, as the words for one case are.
pub(crate) fn of_cases(part: usize, all: usize) -> String {
    let are = if all == 1 { "is" } else { "are" };
    format!("{part} of {} {are}", count(all, "case", "cases"))
}

/// A folder as a command takes it: in quotes where a shell would take it apart.
pub(crate) fn place(folder: &Path) -> String {
    let text = folder.display().to_string();
    let is_plain = |c: char| c.is_alphanumeric() || "/\\:._-+=@%,".contains(c);
    if text.chars().all(is_plain) { text } else { format!("\"{text}\"") }
}

/// Tells `line` on the standard error stream. Work goes on where nobody reads it, or the disk behind it is full.
pub(crate) fn aside(line: &str) {
    let _ = std::io::stderr().lock().write_all(format!("{line}\n").as_bytes());
}

/// Prints `text`. A reader that has gone, as in `abrade schema | head`, is no fault.
pub(crate) fn say(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(error).context("the output cannot be written").map_err(Failure::Run)
        }
        _ => Ok(()),
    }
}

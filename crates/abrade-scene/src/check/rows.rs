//! Files of rows that a scene names, and faults in them, shown where they stand.

use std::path::Path;

use super::Checker;
use crate::number_rows::{self, Line, Rows, RowsTrouble};
use crate::problem::{Mark, Problem, Source};
use crate::spans::ScenePath;

impl Checker<'_> {
    /// Reads the `file` of `what` that is named at `path`; None when it is refused.
    pub(super) fn read_rows(
        &mut self,
        path: &ScenePath,
        what: &'static str,
        folder: &Path,
        file: &str,
    ) -> Option<Rows> {
        let trouble = match number_rows::read(folder, what, file) {
            Ok(rows) => return Some(rows),
            Err(trouble) => trouble,
        };
        let message = trouble.to_string();
        match trouble {
            RowsTrouble::Unreadable { .. } => self.refuse(path, message, ""),
            RowsTrouble::NotANumber { line, .. } => self.refuse_row(path, what, line, message),
        }
        None
    }

    /// A fault in a line of a file of `what`, which is named at `path`.
    pub(super) fn refuse_row(
        &mut self,
        path: &ScenePath,
        what: &str,
        line: Line,
        fault: impl Into<String>,
    ) {
        let named = self.mark(path, "named here");
        let Line { file: name, number: first_line, text } = line;
        let message = format!("the {what} `{name}` has a bad line");
        let range = 0..text.len();
        let source = self.add_source(Source { name, text, first_line });
        let marks = vec![Mark { source, range, label: fault.into() }, named];
        self.problems.push(Problem { message, marks, help: None });
    }
}

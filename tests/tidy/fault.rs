//! A broken rule and where it is broken.

use std::fmt;

/// A broken rule at a line of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    pub file: String,
    /// Counted from 1.
    pub line: usize,
    pub rule: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.file, self.line, self.rule)
    }
}

/// Faults at the lines (counted from 0) of `file`.
pub fn at(file: &str, rule: &str, lines: impl IntoIterator<Item = usize>) -> Vec<Fault> {
    let fault = |line| Fault { file: file.into(), line: line + 1, rule: rule.into() };
    lines.into_iter().map(fault).collect()
}

/// Fails with the whole list.
pub fn assert_none(faults: &[Fault]) {
    let list: Vec<_> = faults.iter().map(Fault::to_string).collect();
    assert!(faults.is_empty(), "{} faults:\n{}", list.len(), list.join("\n"));
}

/// The lines at which `check` finds fault, counted from 1: what the checks' own tests compare.
#[track_caller]
pub fn assert_lines(faults: &[Fault], lines: &[usize]) {
    let found: Vec<_> = faults.iter().map(|fault| fault.line).collect();
    assert_eq!(found, lines, "{faults:?}");
}

//! Small rooms: no source file of 500 lines, most of them under 250.

use crate::fault::{self, Fault};
use crate::tree;

const LIMIT: usize = 500;
const USUAL: usize = 250;
/// Share of the files that must be under the usual length.
const MOST: f64 = 0.8;

fn too_long(name: &str, text: &str) -> Vec<Fault> {
    let lines = text.lines().count();
    let rule = format!("{lines} lines; a file holds one idea and fewer than {LIMIT} lines");
    fault::at(name, &rule, (lines >= LIMIT).then_some(LIMIT - 1))
}

/// Share of the lengths that are under the usual one.
fn usual_share(lengths: &[usize]) -> f64 {
    let short = lengths.iter().filter(|length| **length < USUAL).count();
    short as f64 / lengths.len() as f64
}

#[test]
fn files_are_small() {
    let files = tree::files("", ".rs");
    let faults: Vec<_> = files.iter().flat_map(|file| too_long(&file.name, &file.text)).collect();
    fault::assert_none(&faults);
    let lengths: Vec<_> = files.iter().map(|file| file.text.lines().count()).collect();
    let share = usual_share(&lengths);
    assert!(share >= MOST, "only {share:.2} of the files are under {USUAL} lines");
}

#[test]
fn a_long_file_is_refused() {
    fault::assert_lines(&too_long("a.rs", &"\n".repeat(LIMIT)), &[LIMIT]);
    fault::assert_lines(&too_long("a.rs", &"\n".repeat(LIMIT - 1)), &[]);
    assert_eq!(usual_share(&[10, 300, 10, 250]), 0.5);
}

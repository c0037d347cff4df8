//! Style: module docs, names of rooms, nothing unfinished, nothing that panics without a reason.

use crate::fault::{self, Fault};
use crate::source::{code, is_test_file, test_lines};
use crate::tree;

const BARRED_ROOMS: [&str; 8] =
    ["utils", "util", "common", "helpers", "helper", "types", "misc", "manager"];
const UNFINISHED: [&str; 4] = ["todo!", "unimplemented!", "dbg!", "allow(dead_code"];

/// A module's first words are its `//!`.
fn opens_with_docs(name: &str, text: &str) -> Vec<Fault> {
    let opens = text.starts_with("//! ");
    fault::at(name, "a module opens with `//!`: what it is", (!opens).then_some(0))
}

/// A file or folder with a name that says nothing of what it holds.
fn has_a_telling_name(name: &str) -> Vec<Fault> {
    let barred = name
        .split('/')
        .any(|part| BARRED_ROOMS.contains(&part.strip_suffix(".rs").unwrap_or(part)));
    fault::at(name, "name a module after what it holds", barred.then_some(0))
}

/// Modules of such a name inside a file.
fn has_telling_modules(name: &str, text: &str) -> Vec<Fault> {
    let code = code(text);
    let barred = |line: &str| {
        let mut words = line.split(|c: char| !c.is_alphanumeric() && c != '_');
        words.any(|word| word == "mod") && words.next().is_some_and(|m| BARRED_ROOMS.contains(&m))
    };
    let lines = code.lines().enumerate().filter(|(_, line)| barred(line)).map(|(i, _)| i);
    fault::at(name, "name a module after what it holds", lines)
}

/// What is not finished, or nobody uses.
fn nothing_unfinished(name: &str, text: &str) -> Vec<Fault> {
    let code = code(text);
    let of = |word: &&str| {
        let lines = code.lines().enumerate().filter(|(_, line)| line.contains(*word));
        fault::at(name, &format!("no `{word}`"), lines.map(|(i, _)| i))
    };
    UNFINISHED.iter().flat_map(of).collect()
}

/// `unwrap` in library code: `expect` names the invariant, or the error is returned.
fn no_unwrap(name: &str, text: &str) -> Vec<Fault> {
    let code = code(text);
    let test = test_lines(&code);
    let lines = code.lines().enumerate();
    let found = lines.filter(|(i, line)| !test[*i] && line.contains(".unwrap()")).map(|(i, _)| i);
    fault::at(name, "no `unwrap` in library code: say with `expect` what holds", found)
}

#[test]
fn every_module_opens_with_what_it_is() {
    let files = tree::files("", ".rs");
    let faults: Vec<_> =
        files.iter().flat_map(|file| opens_with_docs(&file.name, &file.text)).collect();
    fault::assert_none(&faults);
}

#[test]
fn modules_are_named_after_what_they_hold() {
    let mut faults: Vec<_> = tree::names("").iter().flat_map(|n| has_a_telling_name(n)).collect();
    let files = tree::files("", ".rs");
    faults.extend(files.iter().flat_map(|file| has_telling_modules(&file.name, &file.text)));
    fault::assert_none(&faults);
}

#[test]
fn nothing_is_left_unfinished() {
    let files = tree::files("", ".rs");
    let faults: Vec<_> =
        files.iter().flat_map(|file| nothing_unfinished(&file.name, &file.text)).collect();
    fault::assert_none(&faults);
}

#[test]
fn library_code_does_not_unwrap() {
    let files = tree::files("crates", ".rs");
    let library = files.iter().filter(|file| !is_test_file(&file.name));
    let faults: Vec<_> = library.flat_map(|file| no_unwrap(&file.name, &file.text)).collect();
    fault::assert_none(&faults);
}

mod refuses {
    use super::*;
    use crate::fault::assert_lines;

    #[test]
    fn a_module_without_docs() {
        assert_lines(&opens_with_docs("a.rs", "use std::fmt;\n//! Late."), &[1]);
        assert_lines(&opens_with_docs("a.rs", "//! A room.\n"), &[]);
    }

    #[test]
    fn rooms_whose_names_say_nothing() {
        assert_lines(&has_a_telling_name("crates/abrade/src/utils.rs"), &[1]);
        assert_lines(&has_a_telling_name("crates/abrade/src/common/mod.rs"), &[1]);
        assert_lines(&has_a_telling_name("crates/abrade/src/utility_of_wear.rs"), &[]);
        let text = "mod grid;\npub(crate) mod types;\n// mod helpers;";
        assert_lines(&has_telling_modules("lib.rs", text), &[2]);
    }

    #[test]
    fn unfinished_code() {
        let text = "// todo!()\ntodo!()\n#[allow(dead_code)]\nfn f() { dbg!(1) }";
        assert_lines(&nothing_unfinished("a.rs", text), &[2, 4, 3]);
    }

    #[test]
    fn unwraps_outside_tests() {
        let text = "a.unwrap();\nb.unwrap_or(0);\n#[cfg(test)]\nmod tests {\n  c.unwrap();\n}\nd.unwrap();";
        assert_lines(&no_unwrap("a.rs", text), &[1, 7]);
    }
}

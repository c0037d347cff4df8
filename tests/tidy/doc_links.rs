//! Links in doc comments. rustdoc's own check is off, because units stand in brackets and would
//! be taken for links; so names in ticks and brackets are looked up here.

use std::collections::BTreeSet;

use crate::fault::{self, Fault};
use crate::source::code;
use crate::tree;

/// Links of the form ``[`Name`]`` or ``[`path::Name`](..)`` in doc comments: line (from 0), name.
fn linked(text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for (i, line) in text.lines().enumerate() {
        let line = line.trim_start();
        if !line.starts_with("///") && !line.starts_with("//!") {
            continue;
        }
        for part in line.split("[`").skip(1) {
            let Some((name, _)) = part.split_once("`]") else { continue };
            let last = name.rsplit("::").next().unwrap_or(name);
            found.push((i, last.trim_end_matches(['(', ')', '!']).to_owned()));
        }
    }
    found
}

/// Links to names that no code uses.
fn unknown_links(name: &str, text: &str, known: &BTreeSet<String>) -> Vec<Fault> {
    let unknown = linked(text).into_iter().filter(|(_, link)| !known.contains(link));
    unknown
        .flat_map(|(i, link)| fault::at(name, &format!("nothing is called `{link}`"), [i]))
        .collect()
}

/// Every name that stands in code.
fn names(text: &str) -> BTreeSet<String> {
    let code = code(text);
    let words = code.split(|c: char| !c.is_alphanumeric() && c != '_');
    words.filter(|word| !word.is_empty()).map(str::to_owned).collect()
}

#[test]
fn doc_links_name_something() {
    let files = tree::files("crates", ".rs");
    let known = files.iter().flat_map(|file| names(&file.text)).collect();
    let faults: Vec<_> =
        files.iter().flat_map(|file| unknown_links(&file.name, &file.text, &known)).collect();
    fault::assert_none(&faults);
}

#[test]
fn a_link_to_nothing_is_refused() {
    let text =
        "/// As [`Surface`] and [`Gone::away`], in metres [m].\n// [`Not`] a doc.\nstruct Surface;";
    fault::assert_lines(&unknown_links("a.rs", text, &names(text)), &[1]);
}

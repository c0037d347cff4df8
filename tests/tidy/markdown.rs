//! Markdown: every relative link leads to something that is there, and plain words throughout.

use crate::fault::{self, Fault};
use crate::tree;

const PRAISE: [&str; 12] = [
    "robust",
    "efficient",
    "blazing",
    "elegant",
    "powerful",
    "seamless",
    "seamlessly",
    "state-of-the-art",
    "cutting-edge",
    "amazing",
    "comprehensive",
    "effortless",
];

/// A link or picture: its line (from 0) and its target without `#part` and title.
fn targets(text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut fenced = false;
    for (i, line) in text.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
        }
        if fenced {
            continue;
        }
        // What stands between ticks is code.
        let prose: String = line.split('`').step_by(2).collect();
        for part in prose.split("](").skip(1) {
            let target = part.split([')', ' ', '#']).next().unwrap_or_default();
            found.push((i, target.to_owned()));
        }
    }
    found
}

/// Links that lead nowhere. Addresses on the net are left alone.
fn dead_links(name: &str, text: &str, exists: impl Fn(&str) -> bool) -> Vec<Fault> {
    let folder = name.rsplit_once('/').map_or("", |(folder, _)| folder);
    let mut faults = Vec::new();
    for (line, target) in targets(text) {
        if target.is_empty() || target.contains("://") || target.starts_with("mailto:") {
            continue;
        }
        if !exists(&resolved(folder, &target)) {
            faults.extend(fault::at(name, &format!("`{target}` does not exist"), [line]));
        }
    }
    faults
}

/// A relative target as a path from the root.
fn resolved(folder: &str, target: &str) -> String {
    let mut parts: Vec<&str> = folder.split('/').filter(|part| !part.is_empty()).collect();
    for part in target.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop();
            }
            _ => parts.push(part),
        }
    }
    parts.join("/")
}

/// Words that praise instead of saying.
fn praise(name: &str, text: &str) -> Vec<Fault> {
    let of = |(i, line): (usize, &str)| {
        let lower = line.to_lowercase();
        let mut words = lower.split(|c: char| !c.is_alphanumeric() && c != '-');
        let word = words.find(|word| PRAISE.contains(word)).map(str::to_owned)?;
        Some(fault::at(name, &format!("`{word}` praises; say what it does"), [i]))
    };
    text.lines().enumerate().filter_map(of).flatten().collect()
}

#[test]
fn relative_links_lead_somewhere() {
    let pages = tree::files("", ".md");
    assert!(!pages.is_empty());
    let exists = |path: &str| tree::root().join(path).exists();
    let faults: Vec<_> =
        pages.iter().flat_map(|page| dead_links(&page.name, &page.text, exists)).collect();
    fault::assert_none(&faults);
}

#[test]
fn pages_and_comments_do_not_praise() {
    let mut files = tree::files("", ".md");
    files.extend(tree::files("crates", ".rs"));
    files.extend(tree::files("scenes", ".ron"));
    let faults: Vec<_> = files.iter().flat_map(|file| praise(&file.name, &file.text)).collect();
    fault::assert_none(&faults);
}

mod refuses {
    use super::*;
    use crate::fault::assert_lines;

    #[test]
    fn links_to_nothing() {
        let exists = |path: &str| ["docs/b.md", "a.md"].contains(&path);
        let text = "[a](../a.md) [b](b.md#part \"title\")\n[c](c.md)\n`[d](d.md)`\n```\n[e](e.md)\n```\n[f](https://f) [g](#g) ![h](h.png)";
        assert_lines(&dead_links("docs/page.md", text, exists), &[2, 7]);
    }

    #[test]
    fn words_of_praise() {
        assert_lines(&praise("a.md", "A file.\nA Robust file.\nRobustly."), &[2]);
    }
}

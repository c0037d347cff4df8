//! Pages that must agree with the tree: README with its commands, scene and example, the pages of
//! docs with the examples they quote, and the table of scenes.

use crate::fault::{self, Fault};
use crate::tree;

const COMMANDS: [&str; 2] =
    ["cargo run --release --bin abrade -- run scenes/first_impact.ron", "cargo test --release"];

/// The fenced blocks of a page in `language`.
fn blocks(text: &str, language: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let Some(named) = line.strip_prefix("```") else { continue };
        let inside = lines.by_ref().take_while(|line| !line.starts_with("```"));
        let block: Vec<&str> = inside.collect();
        if named == language {
            found.push(block.join("\n"));
        }
    }
    found
}

/// The first command block holds the two commands and nothing else.
fn gives_the_two_commands(name: &str, text: &str) -> Vec<Fault> {
    let blocks = blocks(text, "sh");
    let given: Vec<&str> = blocks.first().map_or(Vec::new(), |block| block.lines().collect());
    let rule = format!("the first commands must be {COMMANDS:?}");
    fault::at(name, &rule, (given != COMMANDS).then_some(0))
}

/// Blocks of a page in `language` that `file` does not hold line for line.
fn quotes(name: &str, text: &str, language: &str, file: &tree::File) -> Vec<Fault> {
    let blocks = blocks(text, language);
    let rule = format!("a `{language}` block must stand in {} as it is", file.name);
    let differs = blocks.is_empty() || blocks.iter().any(|block| !stands_in(block, &file.text));
    fault::at(name, &rule, differs.then_some(0))
}

/// `rust` blocks of a page that none of `files` holds line for line.
fn made_up(name: &str, text: &str, files: &[tree::File]) -> Vec<Fault> {
    let stands = |block: &String| files.iter().any(|file| stands_in(block, &file.text));
    let rule = "a `rust` block must stand in an example as it is";
    let blocks = blocks(text, "rust");
    blocks.iter().filter(|block| !stands(block)).flat_map(|_| fault::at(name, rule, [0])).collect()
}

/// True when the lines of `block` stand in `text` one after another, indented alike.
fn stands_in(block: &str, text: &str) -> bool {
    let block: Vec<&str> = block.lines().collect();
    let lines: Vec<&str> = text.lines().collect();
    lines.windows(block.len()).any(|window| {
        let indent = window[0].len() - window[0].trim_start().len();
        let own = block[0].len() - block[0].trim_start().len();
        let strip = |line: &str, by: usize| line.get(by..).unwrap_or_default().to_owned();
        window.iter().zip(&block).all(|(a, b)| strip(a, indent) == strip(b, own))
    })
}

/// Files of `scenes/` that its table does not name, by their path from `scenes/`.
fn unlisted(table: &str, files: &[String]) -> Vec<Fault> {
    let listed = |file: &String| {
        let path = file.strip_prefix("scenes/").unwrap_or(file);
        path == "README.md" || table.contains(&format!("]({path})"))
    };
    let missing = files.iter().filter(|file| !listed(file));
    missing.flat_map(|file| fault::at(file, "scenes/README.md does not list it", [0])).collect()
}

/// Reference tables that the page of tables does not name.
fn undescribed(page: &str, tables: &[String]) -> Vec<Fault> {
    let named = |file: &String| {
        let name = file.rsplit('/').next().unwrap_or(file).trim_end_matches(".csv");
        page.contains(&format!("`{name}`"))
    };
    let missing = tables.iter().filter(|file| !named(file));
    let rule = "docs/verification.md does not say what it is and which test reads it";
    missing.flat_map(|file| fault::at(file, rule, [0])).collect()
}

#[test]
fn every_reference_table_is_described() {
    let page = tree::read("docs/verification.md");
    fault::assert_none(&undescribed(&page.text, &tree::names("tests/reference")));
}

#[test]
fn readme_gives_the_two_commands() {
    let readme = tree::read("README.md");
    fault::assert_none(&gives_the_two_commands(&readme.name, &readme.text));
}

#[test]
fn readme_quotes_a_scene_and_an_example_that_are_run() {
    let readme = tree::read("README.md");
    let mut faults = quotes(&readme.name, &readme.text, "ron", &tree::read("scenes/one_ball.ron"));
    faults.extend(quotes(&readme.name, &readme.text, "rust", &tree::read("examples/embed.rs")));
    fault::assert_none(&faults);
}

#[test]
fn pages_quote_examples_that_are_run() {
    let (pages, examples) = (tree::files("docs", ".md"), tree::files("examples", ".rs"));
    assert!(pages.iter().any(|page| !blocks(&page.text, "rust").is_empty()));
    let faults: Vec<_> =
        pages.iter().flat_map(|page| made_up(&page.name, &page.text, &examples)).collect();
    fault::assert_none(&faults);
}

#[test]
fn every_scene_is_listed() {
    let table = tree::read("scenes/README.md");
    fault::assert_none(&unlisted(&table.text, &tree::names("scenes")));
}

mod refuses {
    use super::*;
    use crate::fault::assert_lines;

    #[test]
    fn other_commands() {
        let good = format!("# a\n```sh\n{}\n{}\n```", COMMANDS[0], COMMANDS[1]);
        assert_lines(&gives_the_two_commands("README.md", &good), &[]);
        let bad = good.replace("cargo test --release", "cargo test");
        assert_lines(&gives_the_two_commands("README.md", &bad), &[1]);
        assert_lines(&gives_the_two_commands("README.md", "cargo test --release"), &[1]);
    }

    #[test]
    fn quotations_that_differ() {
        let file =
            tree::File { name: "a.rs".into(), text: "fn main() {\n    a();\n\n    b();\n}".into() };
        assert_lines(&quotes("b.md", "```rust\na();\n\nb();\n```", "rust", &file), &[]);
        assert_lines(&quotes("b.md", "```rust\na();\nb();\n```", "rust", &file), &[1]);
        assert_lines(&quotes("b.md", "no block", "rust", &file), &[1]);
    }

    #[test]
    fn blocks_that_no_example_holds() {
        let files = ["a();\nb();", "    c();"]
            .map(|text| tree::File { name: "a.rs".into(), text: text.into() });
        assert_lines(&made_up("b.md", "```rust\nb();\n```\n```rust\nc();\n```", &files), &[]);
        assert_lines(&made_up("b.md", "```rust\na();\nc();\n```", &files), &[1]);
    }

    #[test]
    fn tables_that_the_page_does_not_name() {
        let tables = ["t/wear.csv", "t/wear_rates.csv"].map(String::from);
        let faults = undescribed("`wear` is a table", &tables);
        let files: Vec<_> = faults.iter().map(|f| f.file.as_str()).collect();
        assert_eq!(files, ["t/wear_rates.csv"]);
    }

    #[test]
    fn scenes_that_no_table_names() {
        let files = ["scenes/README.md", "scenes/a.ron", "scenes/paper/b.ron"].map(String::from);
        let faults = unlisted("| [a](a.ron) | [b](b.ron) |", &files);
        assert_eq!(
            faults.iter().map(|f| f.file.as_str()).collect::<Vec<_>>(),
            ["scenes/paper/b.ron"]
        );
    }
}

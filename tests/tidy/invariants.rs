//! Who may know what: the one-direction picture of ARCHITECTURE.md.

use crate::fault::{self, Fault};
use crate::source::{self, code, lines_with_word};
use crate::tree;

/// Names of the engine. Its scalar type and its vector library count as well.
const ENGINE: [&str; 5] =
    ["rapier", "rapier3d", "rapier3d_f64", "abrade_rapier3d", "abrade_rapier3d_f64"];
const CLOCK_AND_FILES: [&str; 6] =
    ["std::fs", "std::path", "std::time", "std::env", "std::net", "std::process"];
const SCALARS: [&str; 5] = ["f32", "Real", "glam", "glamx", "SimdReal"];

/// The files that may name the engine: the plug-in, and where a scene's world is made of it.
const ENGINE_ROOMS: [&str; 6] = [
    "crates/abrade-lockstep/",
    "crates/abrade-rapier3d/",
    "crates/abrade-rapier3d-f64/",
    "crates/abrade-scene/src/run/single.rs",
    "crates/abrade-scene/src/run/double.rs",
    "crates/abrade-scene/src/run/world.rs",
];

/// Lines of the core that name an engine, a file or a clock.
fn core_knows_no_world(name: &str, text: &str) -> Vec<Fault> {
    let code = code(text);
    let words = ENGINE.iter().chain(&CLOCK_AND_FILES);
    let of = |word: &&str| {
        let rule = format!("the core must not name `{word}`");
        fault::at(name, &rule, lines_with_word(&code, word))
    };
    words.flat_map(of).collect()
}

/// Lines that name the engine outside the rooms that may.
fn engine_is_named_in_its_rooms(name: &str, text: &str) -> Vec<Fault> {
    if ENGINE_ROOMS.iter().any(|room| name.starts_with(room)) {
        return Vec::new();
    }
    let code = code(text);
    let rule = "only the plug-in and the world of abrade-scene name Rapier";
    ENGINE.iter().flat_map(|word| fault::at(name, rule, lines_with_word(&code, word))).collect()
}

/// Lines of the plug-in that name Rapier's scalar or vector library outside `scalar.rs`.
fn one_file_converts_scalars(name: &str, text: &str) -> Vec<Fault> {
    if name.ends_with("/scalar.rs") {
        return Vec::new();
    }
    let code = code(text);
    let of = |word: &&str| {
        let rule = format!("only scalar.rs of the plug-in names `{word}`");
        fault::at(name, &rule, lines_with_word(&code, word))
    };
    SCALARS.iter().flat_map(of).collect()
}

/// Lines of the writers that could change a run: `&mut` of one of the core's types.
fn reports_only_look(name: &str, text: &str) -> Vec<Fault> {
    const CORE: [&str; 7] = ["Surface", "Nodes", "Body", "State", "Encounter", "Driven", "Placed"];
    let code = code(text);
    let of = |noun: &&str| {
        let rule = format!("abrade-report must not take `&mut {noun}`");
        let lines = lines_with_word(&code, &format!("&mut {noun}"));
        let qualified = lines_with_word(&code, &format!("&mut abrade::{noun}"));
        fault::at(name, &rule, lines.into_iter().chain(qualified))
    };
    CORE.iter().flat_map(of).collect()
}

/// A crate's root without `forbid(unsafe_code)`. A lint table could not be stricter than its
/// strictest exception: the test that counts allocations needs an allocator of its own.
fn forbids_unsafe_code(name: &str, text: &str) -> Vec<Fault> {
    let missing = !code(text).contains("#![forbid(unsafe_code)]");
    fault::at(name, "a crate opens with `#![forbid(unsafe_code)]`", missing.then_some(0))
}

/// Lines of a manifest that depend on something in `words`.
fn manifest_depends_on(name: &str, text: &str, words: &[&str]) -> Vec<Fault> {
    let depends = |line: &str| {
        let key = line.split(['=', '.', ' ']).next().unwrap_or_default();
        words.contains(&key) || words.iter().any(|word| line.contains(&format!("\"{word}\"")))
    };
    let lines = text.lines().enumerate().filter(|(_, line)| depends(line)).map(|(i, _)| i);
    fault::at(name, "this crate must not depend on that", lines)
}

#[test]
fn the_core_names_no_engine_no_file_and_no_clock() {
    let files = tree::files("crates/abrade/src", ".rs");
    assert!(!files.is_empty());
    let library = files.iter().filter(|file| !source::is_test_file(&file.name));
    let mut faults: Vec<_> =
        library.flat_map(|file| core_knows_no_world(&file.name, &file.text)).collect();
    let manifest = tree::read("crates/abrade/Cargo.toml");
    let engines = ["rapier", "rapier3d", "rapier3d-f64", "abrade-rapier3d", "abrade-rapier3d-f64"];
    faults.extend(manifest_depends_on(&manifest.name, &manifest.text, &engines));
    fault::assert_none(&faults);
}

#[test]
fn only_the_plug_in_and_the_world_of_a_scene_name_rapier() {
    let files = tree::files("crates", ".rs");
    let library = files.iter().filter(|file| !source::is_test_file(&file.name));
    let faults: Vec<_> =
        library.flat_map(|file| engine_is_named_in_its_rooms(&file.name, &file.text)).collect();
    fault::assert_none(&faults);
}

#[test]
fn only_scalar_rs_names_rapiers_scalar() {
    let files = tree::files("crates/abrade-rapier3d/src", ".rs");
    assert!(!files.is_empty());
    let faults: Vec<_> =
        files.iter().flat_map(|file| one_file_converts_scalars(&file.name, &file.text)).collect();
    fault::assert_none(&faults);
}

#[test]
fn reports_take_shared_references_only() {
    let files = tree::files("crates/abrade-report/src", ".rs");
    assert!(!files.is_empty());
    let library = files.iter().filter(|file| !source::is_test_file(&file.name));
    let mut faults: Vec<_> =
        library.flat_map(|file| reports_only_look(&file.name, &file.text)).collect();
    let manifest = tree::read("crates/abrade-report/Cargo.toml");
    let others = ["abrade-scene", "abrade-cli", "abrade-rapier3d", "abrade-rapier3d-f64"];
    faults.extend(manifest_depends_on(&manifest.name, &manifest.text, &others));
    fault::assert_none(&faults);
}

#[test]
fn only_abrade_scene_knows_the_file_format() {
    let manifests = tree::files("crates", "Cargo.toml");
    let others = manifests.iter().filter(|file| !file.name.contains("abrade-scene"));
    let faults: Vec<_> =
        others.flat_map(|file| manifest_depends_on(&file.name, &file.text, &["ron"])).collect();
    fault::assert_none(&faults);
}

#[test]
fn every_crate_forbids_unsafe_code() {
    let is_root = |name: &str| name.ends_with("/src/lib.rs") || name.ends_with("/src/main.rs");
    let roots: Vec<_> =
        tree::files("crates", ".rs").into_iter().filter(|file| is_root(&file.name)).collect();
    assert!(roots.len() >= 5);
    let faults: Vec<_> =
        roots.iter().flat_map(|file| forbids_unsafe_code(&file.name, &file.text)).collect();
    fault::assert_none(&faults);
}

mod refuses {
    use super::*;
    use crate::fault::assert_lines;

    #[test]
    fn a_core_that_reads_files_or_knows_the_engine() {
        let text = "//! As rapier does.\nuse rapier::math::Real;\nlet s = \"std::fs\";\nstd::fs::read(p);\nuse std::time::Instant;";
        assert_lines(&core_knows_no_world("a.rs", text), &[2, 4, 5]);
    }

    #[test]
    fn an_engine_outside_its_room() {
        let text = "use abrade_rapier3d::WearWorld;";
        let check = engine_is_named_in_its_rooms;
        assert_lines(&check("crates/abrade-cli/src/run.rs", text), &[1]);
        assert_lines(&check("crates/abrade-scene/src/run/world.rs", text), &[]);
        assert_lines(&check("crates/abrade-rapier3d/src/step.rs", text), &[]);
    }

    #[test]
    fn a_scalar_outside_its_file() {
        let text = "use rapier::math::{Real, Vector};\nlet x = 1.0 as f32;";
        let check = one_file_converts_scalars;
        assert_lines(&check("crates/abrade-rapier3d/src/steer.rs", text), &[2, 1]);
        assert_lines(&check("crates/abrade-rapier3d/src/scalar.rs", text), &[]);
    }

    #[test]
    fn a_report_that_can_change_a_run() {
        let text = "fn a(surface: &Surface) {}\nfn b(surface: &mut Surface) {}\nfn c(n: &mut abrade::Nodes) {}";
        assert_lines(&reports_only_look("a.rs", text), &[2, 3]);
    }

    #[test]
    fn a_crate_that_may_be_unsafe() {
        assert_lines(&forbids_unsafe_code("lib.rs", "//! A.\n// #![forbid(unsafe_code)]"), &[1]);
        assert_lines(&forbids_unsafe_code("lib.rs", "//! A.\n#![forbid(unsafe_code)]"), &[]);
    }

    #[test]
    fn a_manifest_that_reaches_up() {
        let text = "[dependencies]\nron = \"1\"\nx = { package = \"ron\" }\nronin = \"1\"\nron.workspace = true";
        assert_lines(&manifest_depends_on("Cargo.toml", text, &["ron"]), &[2, 3, 5]);
    }
}

//! Collisions of asperities and maps of them, cut short.

use std::path::{Path, PathBuf};

use abrade_adhesive::{Asperities, Solid};
use abrade_scene::Progress;
use abrade_study::adhesive;

struct Patient;

impl Progress for Patient {
    fn advance(&mut self, _: f64, _: Option<f64>) -> bool {
        true
    }
}

/// Breaks off at once.
struct Hasty;

impl Progress for Hasty {
    fn advance(&mut self, _: f64, _: Option<f64>) -> bool {
        false
    }
}

fn write(folder: &Path, text: &str) -> PathBuf {
    let path = folder.join("file.ron");
    std::fs::write(&path, text).unwrap();
    path
}

/// Fails for a row or a frame a call where several are due in one step: an instant would stand many times.
#[test]
fn more_rows_than_steps_do_not_repeat_an_instant() {
    let folder = tempfile::tempdir().unwrap();
    let scene = r#"(version: 1, name: "short", bodies: (travel: "1 um"), frames: 300, rows: 1000)"#;
    let scene = adhesive::load_scene(&write(folder.path(), scene), &[]).unwrap();
    let ended = adhesive::run(&scene, folder.path(), &mut Patient).unwrap();
    let steps = ended.summary.steps as usize;
    assert!((30..40).contains(&steps), "{steps}");
    let rows = std::fs::read_to_string(folder.path().join("timeseries.csv")).unwrap();
    assert_eq!(rows.lines().count(), 1 + steps + 1, "head, before each step, end");
    let frames = std::fs::read_to_string(folder.path().join("elements.pvd")).unwrap();
    assert_eq!(frames.matches("<DataSet").count(), steps + 1);
}

/// Fails for a map that makes nothing and says nothing.
#[test]
fn a_map_without_a_case_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let map = r#"(version: 1, name: "none", strength_ratios: [1.7], adhesion_ratios: [5.0])"#;
    let error = adhesive::load_map(&write(folder.path(), map), &[]).unwrap_err().to_string();
    assert!(error.contains("no case") && error.contains("tensile strength"), "{error}");
}

/// Fails for cases that are made again, or counted as missing, when a map gets another value or name.
#[test]
fn a_map_that_is_extended_keeps_its_cases() {
    let folder = tempfile::tempdir().unwrap();
    let map = |name: &str, ratios: &str, gaps: &str| {
        let text = format!(
            r#"(version: 1, name: "{name}", bodies: (travel: "1 um"), strength_ratios: [{ratios}],
            adhesion_ratios: [0.0, 0.4], gaps: [{gaps}])"#
        );
        adhesive::load_map(&write(folder.path(), &text), &[]).unwrap()
    };
    let first = map("first", "1.0", "1.2");
    adhesive::make(&first, &first.cases(), folder.path(), &mut Patient).unwrap();
    let missing = |file: &adhesive::MapFile| adhesive::result(file, folder.path()).missing();
    assert_eq!(missing(&first), 0);
    for (ratios, gaps) in [("1.0", "1.2, 1.5"), ("1.0", "1.1, 1.2"), ("1.3, 1.0", "1.2")] {
        let more = map("second", ratios, gaps);
        assert_eq!((missing(&more), adhesive::others(&more, folder.path())), (2, 0), "{gaps}");
    }
    // Other solids or gaps are other cases.
    for other in [map("first", "1.3", "1.2"), map("first", "1.0", "1.5")] {
        assert_eq!((missing(&other), adhesive::others(&other, folder.path())), (2, 2));
    }
    let runs =
        adhesive::result(&first, folder.path()).points.iter().map(|p| p.runs).collect::<Vec<_>>();
    assert_eq!(runs, [1, 1]);
}

/// Fails for a run that was broken off and has a label all the same.
#[test]
fn a_run_that_is_broken_off_has_no_mode() {
    let folder = tempfile::tempdir().unwrap();
    let scene = r#"(version: 1, name: "short", frames: 1, rows: 1)"#;
    let scene = adhesive::load_scene(&write(folder.path(), scene), &[]).unwrap();
    assert!(adhesive::run(&scene, folder.path(), &mut Hasty).unwrap().interrupted);
    let text = std::fs::read_to_string(folder.path().join("summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
    for label in ["mode", "is_ground", "is_split"] {
        assert!(summary.get(label).is_some_and(serde_json::Value::is_null), "{label}: {text}");
    }
}

/// Fails for bodies that never met and are told to have slipped, and for a note where they met.
#[test]
fn bodies_that_do_not_touch_are_told_so() {
    let folder = tempfile::tempdir().unwrap();
    for (overlap, mode) in [(-1.0, "no contact"), (0.3, "slipping")] {
        let scene = format!(
            r#"(version: 1, name: "x", bodies: (travel: "60 um", overlap: {overlap}), frames: 1, rows: 1)"#
        );
        let scene = adhesive::load_scene(&write(folder.path(), &scene), &[]).unwrap();
        let summary = adhesive::run(&scene, folder.path(), &mut Patient).unwrap().summary;
        let (json, text) = (summary.to_json(), summary.text());
        assert_eq!(json["mode"], mode, "{text}");
        let warnings = json["warnings"].as_array().unwrap();
        assert_eq!(warnings.len(), usize::from(mode == "no contact"), "{warnings:?}");
        assert_eq!(text.contains("note: the bodies did not touch"), mode == "no contact", "{text}");
    }
}

/// Fails for a summary from which its run cannot be made again, and for a warning that only the terminal shows.
#[test]
fn a_summary_holds_what_the_run_was_made_from() {
    let folder = tempfile::tempdir().unwrap();
    for (words, warnings) in [
        (
            r#"solid: (hardening: "50 MPa", slope: Plastic), bodies: (travel: "1 um",
            profile: Trapezoid(side: "45 deg"), packing: Rotated(angle: "15 deg"))"#,
            &["`solid.hardening` is 5e7 Pa", "did not touch"][..],
        ),
        // Without a travel of its own.
        ("bodies: (speed: 100.0)", &[]),
    ] {
        let scene = format!(r#"(version: 1, name: "x", frames: 1, rows: 1, {words})"#);
        let scene = adhesive::load_scene(&write(folder.path(), &scene), &[]).unwrap();
        let json = adhesive::run(&scene, folder.path(), &mut Patient).unwrap().summary.to_json();
        let [solid, bodies] = ["solid", "bodies"].map(|name| json[name].clone());
        assert_eq!(serde_json::from_value::<Solid>(solid).unwrap(), scene.solid);
        assert_eq!(serde_json::from_value::<Asperities>(bodies).unwrap(), scene.bodies);
        let told = json["warnings"].as_array().unwrap();
        assert_eq!(told.len(), warnings.len(), "{json}");
        for (warning, told) in told.iter().zip(warnings) {
            assert!(warning.as_str().unwrap().contains(told), "{json}");
        }
        assert!(json["abrade"].is_string());
    }
}

/// Fails for cases that end early without a word, for good, or as if they had slipped: bodies so fast that a step
/// does not resolve what their contact makes of them.
#[test]
fn cases_that_end_early_are_told_and_tried_again() {
    let folder = tempfile::tempdir().unwrap();
    let map = r#"(version: 1, name: "fast", bodies: (speed: 140.0), adhesion_ratios: [0.0], gaps: [1.2, 1.5])"#;
    let map = adhesive::load_map(&write(folder.path(), map), &[]).unwrap();
    let make = || {
        adhesive::make(&map, &map.cases(), folder.path(), &mut Patient).unwrap();
        adhesive::result(&map, folder.path())
    };
    let made = make();
    assert_eq!((made.missing(), made.fruitless(), made.points[0].early_runs), (0, 1, 2));
    assert_eq!(made.points[0].modes.iter().sum::<usize>(), 0);
    let told = made.table();
    assert!(told.contains("2 of 2 cases ended early; the first, case 0: at "), "{told}");
    let first = std::fs::read_dir(folder.path().join("cases")).unwrap().next().unwrap();
    let first = first.unwrap().path();
    let before = std::fs::read_to_string(&first).unwrap();
    std::fs::write(&first, before.replace("went at", "once went at")).unwrap();
    make();
    assert_eq!(std::fs::read_to_string(&first).unwrap(), before);
}

/// Fails for an outline that goes over the period in part, backwards, in millimetres, or with a step at its end.
#[test]
fn outlines_that_do_not_go_over_the_period_are_refused_by_line() {
    let folder = tempfile::tempdir().unwrap();
    let load = |outline: &str| {
        std::fs::write(folder.path().join("line.csv"), outline).unwrap();
        let scene = r#"(version: 1, name: "x", outline: "line.csv")"#;
        adhesive::load_scene(&write(folder.path(), scene), &[]).map_err(|error| {
            error.problems.into_iter().map(|problem| problem.message).collect::<Vec<_>>().join("; ")
        })
    };
    assert!(load("0 0\n1e-3 4e-4 # the peak\n2.25e-3 0\n").is_ok());
    for (outline, line, why) in [
        ("0 0\n1 0.4\n2.25 0\n", 3, "must at the period"),
        ("0 0\n1e-3 4e-4\n", 2, "must at the period"),
        ("1e-3 4e-4\n2.25e-3 0\n", 1, "must at 0"),
        ("0 0\n1e-3 4e-4\n5e-4 1e-4\n2.25e-3 0\n", 3, "must rise"),
        ("0 0\n1e-3 4e-4\n2.25e-3 2e-4\n", 3, "does not close"),
        ("x,height\n0 0\n2.25e-3 0\n", 1, "not a finite number"),
    ] {
        let told = load(outline).unwrap_err();
        assert!(told.contains(&format!("line {line} of `")), "{outline}: {told}");
        assert!(told.contains("line.csv`") && told.contains(why), "{outline}: {told}");
        assert!(told.contains("in metres"), "{outline}: {told}");
    }
}

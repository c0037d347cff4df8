//! Collisions of asperities and maps of them, cut short.

use std::path::{Path, PathBuf};

use abrade_scene::Progress;
use abrade_study::adhesive;

struct Patient;

impl Progress for Patient {
    fn advance(&mut self, _: f64, _: Option<f64>) -> bool {
        true
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

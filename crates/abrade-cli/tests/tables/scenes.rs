//! Every shipped scene runs, and the first one leaves what the README shows.

use std::process::Command;

use crate::run::{at, root, run};

/// Fails for a scene that no longer runs, or whose energies no longer close. Those of asperities have a
/// command of their own.
#[test]
fn every_scene_runs_and_its_energies_close() {
    for entry in glob("scenes") {
        let name =
            entry.strip_prefix(root().join("scenes")).expect("a scene").display().to_string();
        // The scratch is run in full against LAMMPS.
        if name == "paper/scratch.ron" || name.starts_with("adhesive/") {
            continue;
        }
        let summary = run(&name, &[]);
        assert_eq!(summary["complete"], true, "{name}");
        if !summary["energy"].is_null() {
            let part = |key: &str| at(&summary, &format!("energy.{key}"));
            let kept = [
                "kinetic_J",
                "elastic_J",
                "friction_J",
                "wear_J",
                "damping_J",
                "history_J",
                "adhesion_J",
            ];
            let sum: f64 = kept.iter().map(|key| part(key)).sum();
            let put_in = part("initial_J") + part("external_work_J").abs();
            let gap = part("initial_J") + part("external_work_J") - sum - part("numerical_J");
            assert!(gap.abs() < 1e-9 * put_in, "{name}: {gap:e} of {put_in:e}");
            assert!(part("numerical_J").abs() < 5e-3 * put_in, "{name}");
            assert!(part("wear_J") >= 0.0 && part("friction_J") >= 0.0, "{name}");
        }
    }
}

/// Fails for wear that is not K F s / H of the load that lies on a pin, and for an arm that gains height.
#[test]
fn slides_wear_by_their_load_and_their_way() {
    let (load, hardness) = (20.0, 1e9);
    let way = 2.0 * std::f64::consts::PI * 4e-3 * 4.0;
    let disc = run("archard/pin_on_disc.ron", &[]);
    let pin = run("archard/reciprocating_slide.ron", &[]);
    let worn = |summary, name: &str| {
        at(summary, &format!("surfaces.{name}.wear_volume_archard_m3")) * hardness / load
    };
    // The pin is carried along by its groove, by up to 3 of the 126 mm/s.
    let ring = worn(&disc, "disc") / (1e-3 * way) - 1.0;
    let cap = worn(&pin, "pin") / (1e-2 * 40e-3) - 1.0;
    println!("ring {ring:.1e}, cap {cap:.1e}");
    assert!((-2e-2..0.0).contains(&ring) && cap.abs() < 1e-4, "{ring:e} {cap:e}");
}

fn glob(folder: &str) -> Vec<std::path::PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "ron") {
                found.push(path);
            }
        }
    }
    found.sort();
    assert!(found.len() >= 15, "{}", found.len());
    found
}

/// Fails for a first scene whose bodies leave no mark, or that writes less than it names.
#[test]
fn the_first_scene_leaves_its_files_and_no_half_ones() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = root().join("scenes/first_impact.ron");
    let status = Command::new(env!("CARGO_BIN_EXE_abrade"))
        .args(["run".as_ref(), scene.as_os_str(), "--out".as_ref(), folder.path().as_os_str()])
        .status()
        .expect("the command runs");
    assert!(status.success());
    let mut files: Vec<_> = std::fs::read_dir(folder.path())
        .expect("a folder")
        .map(|entry| entry.expect("a file").file_name().to_string_lossy().into_owned())
        .collect();
    files.sort();
    let expected = [
        ".abrade-run",
        "bodies.pvd",
        "bodies_0000.vtp",
        "history.csv",
        "summary.json",
        "surface.png",
        "surface.pvd",
        "surface_0000.vtp",
    ];
    assert_eq!(files, expected);
    let text = std::fs::read_to_string(folder.path().join("summary.json")).expect("a summary");
    let summary: serde_json::Value = serde_json::from_str(&text).expect("json");
    for body in ["ball", "cube", "clump"] {
        assert!(at(&summary, &format!("bodies.{body}.restitution")) < 0.9, "{body}");
    }
    assert_eq!(summary["warnings"].as_array().map(Vec::len), Some(0), "{}", summary["warnings"]);
}

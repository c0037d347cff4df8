//! `adhesive run`, `adhesive map`.

use std::path::Path;

use super::Folder;

const SCENE: &str = r#"(version: 1, name: "brittle",
  solid: (strength_ratio: 1.7, adhesion: "0 MPa"), bodies: (travel: "60 um"), frames: 2, rows: 5)"#;

/// Two points of one gap and one of them from another, cut short.
pub(crate) const MAP: &str = r#"(version: 1, name: "small map", bodies: (travel: "40 um"),
  strength_ratios: [1.0, 1.7], adhesion_ratios: [0.4, 1.6], gaps: [1.2, 1.5])"#;

/// Fails for a run without one of its files, a summary that is not the run's, or half a file left over.
#[test]
fn a_collision_leaves_its_files_and_says_what_became_of_the_asperities() {
    let folder = Folder::new("adhesive");
    folder.write("bodies.ron", SCENE);
    let said = folder.abrade(&["adhesive", "run", "bodies.ron", "--json"]);
    assert_eq!(said.code, Some(0), "{}", said.err);
    let summary: serde_json::Value = serde_json::from_str(&said.out).unwrap();
    assert_eq!((&summary["complete"], &summary["elements"]), (&true.into(), &3586.into()));
    assert_eq!(summary["mode"], "slipping");
    assert!(summary["energy"]["drive_J_m"].as_f64().unwrap() > 0.0);
    let place = folder.0.join("runs/bodies");
    let mut names: Vec<String> = std::fs::read_dir(&place)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names.retain(|name| !name.starts_with('.'));
    let expected = ["asperities.png", "elements.pvd", "elements_0000.vtp", "elements_0001.vtp"];
    assert_eq!(names[..4], expected);
    assert!(names.iter().all(|name| !name.contains("partial")), "{names:?}");
    let rows = std::fs::read_to_string(place.join("timeseries.csv")).unwrap();
    assert_eq!(rows.lines().count(), 1 + 5 + 1, "head, rows, end: {rows}");
    assert!(rows.lines().all(|row| row.split(',').count() == 13), "{rows}");
}

/// Fails for a fault that is found only when the bodies move, or is shown in another place.
#[test]
fn faults_are_shown_where_they_stand() {
    let folder = Folder::new("adhesive_bad");
    folder.write("bodies.ron", SCENE);
    folder.write("map.ron", MAP);
    folder.write("line.csv", "0 0\n1\n");
    for (arguments, told) in [
        (
            ["run", "bodies.ron", "--set", "solid.adhesion=\"-1 MPa\""],
            "^^^^^^^ must be finite and at least 0\n",
        ),
        (["run", "bodies.ron", "--set", "solid.adhesion=\"1 mm\""], "a pressure"),
        (["run", "bodies.ron", "--set", "bodies.overlp=0.3"], "did you mean `overlap`?"),
        (["run", "bodies.ron", "--set", "outline=\"line.csv\""], "line 2 of `line.csv`"),
        (["run", "bodies.ron", "--set", "bodies.gap=-4.0"], "the bodies do not overlap"),
        (["run", "bodies.ron", "--set", "solid.poisson=0.1"], "must be below 0.4658"),
        (["run", "bodies.ron", "--set", "bodies.courant=0.65"], "^^^^ must be below 0.6017"),
        (["map", "map.ron", "--set", "shear_strengths=[0.0]"], "must be finite and above zero"),
        (["map", "map.ron", "--set", "gaps=[1.2,1.2]"], "`gaps.1` is there twice"),
        (["map", "map.ron", "--case", "17"], "there is no case 17"),
        (["run", "bodies.ron", "--set", "bodies.speed=200.0"], "must be at most 1.43"),
        (["run", "bodies.ron", "--set", "solid.adhesion_range=\"5 um\""], "at most 0.05 diameters"),
        (["run", "bodies.ron", "--set", "bodies.profile.side=3.0"], "between 0.05 and 90 deg"),
        (["map", "map.ron", "--set", "gaps=[1.2,-4.0]"], "`gaps.1` is out of range"),
        (["map", "map.ron", "--set", "bodies.gap=1.3"], "give `gaps` alone"),
        (["map", "map.ron", "--set", "solid.adhesion=1e6"], "give `adhesion_ratios` alone"),
        (["map", "map.ron", "--set", "solid.strength_ratio=1.3"], "give `strength_ratios` alone"),
    ] {
        let said = folder.abrade(&[&["adhesive"], &arguments[..]].concat());
        assert_eq!(said.code, Some(2), "{arguments:?}: {}", said.err);
        assert!(said.err.contains(told), "{arguments:?}: {}", said.err);
    }
}

/// Fails for a check that lets through what a run refuses at its start, and for one that says nothing of adhesion
/// above the strength, of the bound of a value as bad, or of how long it takes.
#[test]
fn check_tells_what_a_run_would_and_how_long_it_takes() {
    let folder = Folder::new("adhesive_check");
    folder.write("bodies.ron", SCENE);
    folder.write("map.ron", MAP);
    let check = |file: &str, set: &str| folder.abrade(&["check", file, "--set", set]);
    for (file, set, told) in [
        ("bodies.ron", "bodies.speed=200.0", "must be at most 1.43"),
        ("bodies.ron", "bodies.gap=-4.0", "the bodies do not overlap at the start"),
        ("map.ron", "gaps=[1.2,-4.0]", "the bodies do not overlap at the start"),
    ] {
        let said = check(file, set);
        assert_eq!(said.code, Some(2), "{set}: {}", said.out);
        assert!(said.err.contains(told), "{set}: {}", said.err);
    }
    let strong = check("bodies.ron", "solid.adhesion=\"7 MPa\"");
    assert_eq!(strong.code, Some(0), "{}", strong.err);
    assert!(strong.out.contains("note     `solid.adhesion` is 7e6 Pa, above"), "{}", strong.out);
    let soft = check("bodies.ron", "solid.hardening=\"50 MPa\"");
    assert!(soft.out.contains("note     `solid.hardening` is 5e7 Pa"), "{}", soft.out);
    assert!(!check("bodies.ron", "solid.hardening=\"100 MPa\"").out.contains("note"));
    let said = check("bodies.ron", "bodies.profile=Trapezoid(top: \"25 um\")");
    assert_eq!(said.code, Some(0), "{}", said.err);
    assert!(
        said.out.contains("\nsize     ") && said.out.contains(" steps\ntime     about "),
        "{}",
        said.out
    );
    let said = check("bodies.ron", "bodies.profile.side=45 deg");
    assert_eq!(said.code, Some(0), "{}", said.err);
}

/// Fails for a map without a result that ends as if it had one.
#[test]
fn a_map_whose_cases_all_end_early_is_an_error() {
    let folder = Folder::new("adhesive_failed");
    folder.write("map.ron", MAP);
    let arguments = ["adhesive", "map", "map.ron", "--out", "out", "--set", "bodies.speed=140.0"];
    let arguments = [&arguments[..], &["--set", "bodies.travel=\"1 mm\""]].concat();
    let said = folder.abrade(&arguments);
    assert_eq!(said.code, Some(1), "{}", said.out);
    assert!(said.out.contains("6 of 6 cases ended early; the first, case 0: at "), "{}", said.out);
    assert!(said.err.contains("no case of 3 of 3 points came to its end"), "{}", said.err);
}

/// Fails for a folder that abrade has written itself and calls damaged.
#[test]
fn the_folder_of_a_collision_is_not_viewed() {
    let folder = Folder::new("adhesive_viewed");
    folder.write("bodies.ron", SCENE);
    assert_eq!(folder.abrade(&["adhesive", "run", "bodies.ron", "--out", "out"]).code, Some(0));
    let said = folder.abrade(&["view", "out"]);
    assert_eq!(said.code, Some(2), "{}", said.err);
    assert!(said.err.contains("open asperities.png"), "{}", said.err);
}

/// Fails for a check that knows scenes alone, stops at the first file that cannot be used, or shows its faults
/// in other words than the command that reads it.
#[test]
fn check_takes_files_of_every_kind() {
    let folder = Folder::new("check_kinds");
    folder.write("bodies.ron", SCENE);
    folder.write("map.ron", MAP);
    folder.write("study.ron", crate::studies::EROSION);
    let said = folder.abrade(&["check", "scene.ron", "bodies.ron", "map.ron", "study.ron"]);
    assert_eq!((said.code, said.err.as_str()), (Some(0), ""));
    assert_eq!(
        said.out,
        "scene.ron: Oblique impact of a ball: scene, 1 surface, 18480 nodes, 1 body, a second or less
bodies.ron: brittle: two asperities, 3586 elements, 1969 steps, about 162 ms of a core
map.ron: small map: map of two asperities, 6 cases, 3586 elements, 1313 steps in each, about 650 ms of a core
study.ron: two grains: erosion study, 2 cases, 8 impacts at most
"
    );
    folder.write("overlap.ron", &SCENE.replace("travel", "gap: -4.0, travel"));
    folder.write("frayed.ron", &SCENE.replace("frames: 2,", "frames: 2"));
    let bad = ["overlap.ron", "frayed.ron", "bodies.ron", "none.ron"];
    let said = folder.abrade(&[&["check"], &bad[..]].concat());
    assert_eq!(said.code, Some(2), "{}", said.err);
    let sound =
        "bodies.ron: brittle: two asperities, 3586 elements, 1969 steps, about 162 ms of a core\n";
    assert_eq!(said.out, sound);
    let mut told = String::new();
    for command in ["overlap.ron", "frayed.ron", "none.ron"] {
        told += &folder.abrade(&["adhesive", "run", command]).err;
    }
    assert_eq!(said.err, told + "error: 3 of 4 files cannot be used\n");
    assert!(!folder.0.join("runs/bodies/summary.json").exists());
}

/// Fails for a file of names that several kinds have that is not taken for the one by which it is sound, and for
/// one that is read twice.
#[cfg(unix)]
#[test]
fn a_file_that_could_be_of_two_kinds_is_read_once_and_of_the_sound_one() {
    let folder = Folder::new("adhesive_tie");
    folder.write("tied.ron", "(version: 1, name: \"x\", bodies: (gap: 1.0))");
    let check = format!("cat tied.ron | '{}' check /dev/stdin", env!("CARGO_BIN_EXE_abrade"));
    let mut shell = std::process::Command::new("sh");
    let said = shell.current_dir(&folder.0).args(["-c", &check]).output().unwrap();
    let (out, err) = (String::from_utf8_lossy(&said.stdout), String::from_utf8_lossy(&said.stderr));
    assert!(out.starts_with("scene    x: two asperities\n"), "{out}{err}");
}

/// Fails for a file of another kind that is answered with the words that are strange here, and for a fault in
/// an argument that is taken for one of the file.
#[test]
fn a_file_of_another_kind_is_told_by_its_command() {
    let folder = Folder::new("adhesive_kinds");
    folder.write("bodies.ron", SCENE);
    folder.write("map.ron", MAP);
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/one_ball.ron");
    for (arguments, command) in [
        (&["run", "bodies.ron"][..], "`abrade adhesive run`"),
        (&["run", "map.ron"], "`abrade adhesive map`"),
        (&["adhesive", "run", "map.ron"], "`abrade adhesive map`"),
        (&["study", "erosion", scene], "`abrade run`"),
    ] {
        let said = folder.abrade(arguments);
        assert_eq!(said.code, Some(2), "{arguments:?}: {}", said.err);
        assert!(said.err.ends_with(&format!("is a file for {command}\n")), "{}", said.err);
    }
    folder.write("bad.ron", &SCENE.replace("rows: 5", "row: 5"));
    let said = folder.abrade(&["run", "bad.ron"]);
    assert!(said.err.ends_with("is a file for `abrade adhesive run`\n"), "{}", said.err);
    let said = folder.abrade(&["adhesive", "run", "bodies.ron", "--set", "bodis.gap=1.0"]);
    assert!(said.err.contains("did you mean `bodies`?"), "{}", said.err);
}

/// Fails for a map that is made again where it was broken off, or whose parts do not come to the same bytes.
#[test]
fn a_map_is_made_whole_or_in_parts_on_any_number_of_threads() {
    let folder = Folder::new("adhesive_map");
    folder.write("map.ron", MAP);
    let read = |place: &str| std::fs::read(folder.0.join(place).join("cases.csv")).unwrap();
    let said = folder.abrade(&["adhesive", "map", "map.ron", "--jobs", "2", "--out", "whole"]);
    assert_eq!(said.code, Some(0), "{}", said.err);
    // 40 um are 1.6 d: from a gap of 1.5 d the corners do not come to touch.
    assert!(said.out.contains("1 slipping, 1 no contact\n"), "{}", said.out);
    let early = folder.abrade(&["adhesive", "map", "map.ron", "--out", "part0", "--merge"]);
    assert_eq!(early.code, Some(1), "{}", early.out);
    for part in ["0/2", "1/2"] {
        let out = format!("part{}", &part[..1]);
        let arguments =
            ["adhesive", "map", "map.ron", "--shard", part, "--jobs", "1", "--out", &out];
        assert_eq!(folder.abrade(&arguments).code, Some(0));
    }
    let merge = ["adhesive", "map", "map.ron", "--out", "merged", "--merge", "part0", "part1"];
    assert_eq!(folder.abrade(&merge).code, Some(0));
    assert_eq!(read("whole"), read("merged"));
    // sigma_0 = 1.6 sigma_j lies above the tensile strength where a = 1.7.
    assert_eq!(read("whole").iter().filter(|byte| **byte == b'\n').count(), 1 + 6);
    let cases = std::fs::read_dir(folder.0.join("whole/cases")).unwrap();
    let cases: Vec<_> = cases.map(|case| case.unwrap().path()).collect();
    let [case, other] = [&cases[0], &cases[1]];
    let before = modified(case);
    std::fs::remove_file(other).unwrap();
    assert_eq!(folder.abrade(&["adhesive", "map", "map.ron", "--out", "whole"]).code, Some(0));
    assert_eq!(modified(case), before);
    assert!(other.exists());
    assert_eq!(read("whole"), read("merged"));
    let changed = ["adhesive", "map", "map.ron", "--out", "whole", "--set", "gaps=[1.3]"];
    let said = folder.abrade(&changed);
    let note = "note: 6 cases are in whole of another study, or of this one before it changed: ";
    assert!(said.err.starts_with(note), "{}", said.err);
}

fn modified(path: &Path) -> std::time::SystemTime {
    std::fs::metadata(path).unwrap().modified().unwrap()
}

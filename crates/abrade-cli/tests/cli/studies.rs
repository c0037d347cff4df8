//! `study convergence`, `study erosion`, `sweep`.

use super::Folder;

#[test]
fn a_study_prints_its_table_and_leaves_its_files() {
    let folder = Folder::new("study");
    let arguments = ["study", "convergence", "scene.ron", "--vary", "accuracy", "--landings", "1"];
    let said = folder.abrade(&[&arguments[..], &["--budget", "0.5"]].concat());
    assert_eq!(said.code, Some(0), "{}", said.err);
    for words in ["Oblique impact of a ball\n", "accuracy; error ~ ", "for 1 %: ", "study.csv"] {
        assert!(said.out.contains(words), "{}", said.out);
    }
    let place = folder.0.join("runs/scene_convergence");
    let table = std::fs::read_to_string(place.join("study.csv")).unwrap();
    assert!(table.lines().count() > 3 && table.contains(",wall_s,"), "{table}");
    let picture = std::fs::read(place.join("study.png")).unwrap();
    assert!(picture.starts_with(b"\x89PNG"));
}

/// One that ran first and looked later would leave a folder, or take minutes to say so.
#[test]
fn bad_input_is_said_before_anything_runs() {
    let folder = Folder::new("study_bad");
    folder.write("empty.json", "{}");
    let cases: [(&[&str], &str); 5] = [
        (&["--reference", "none.json"], "the reference `none.json` cannot be read"),
        (&["--reference", "empty.json"], "surfaces.<name>.wear_volume_m3"),
        (&["--set", "bodies.ball.motion.sped=1"], "did you mean `speed`?"),
        (&["--landings", "0"], "0 is not in 1..=1000"),
        (&["--budget", "-1"], "expected a number above zero"),
    ];
    for (more, told) in cases {
        let said = folder.abrade(&[&["study", "convergence", "scene.ron"], more].concat());
        assert_eq!(said.code, Some(2), "{more:?}: {}", said.err);
        assert!(said.err.contains(told), "{more:?}: {}", said.err);
        assert_eq!(folder.files(), ["empty.json", "scene.ron"]);
    }
}

/// A study of two cases with a few impacts each.
pub(crate) const EROSION: &str = r#"(version: 1, name: "two grains",
  target: (material: (hardness: "1.7 GPa"), density: 7850.0, removal: AttackAngle(critical: "35 deg")),
  grains: { "ball": (form: Sphere), "cube": (form: Polyhedron(kind: Cube)) },
  density: 2650.0, size: Volume(diameter: "200 um"), speeds: ["98 m/s"], angles: ["30 deg"],
  samples: (least: 4, most: 4))"#;

/// Fails for a study that has to be made again, whose parts do not come to the same, that a merge before its first
/// case keeps from being made, that makes cases again which it has, or that leaves others among its own without a word.
#[test]
fn an_erosion_study_is_made_whole_or_in_parts() {
    let folder = Folder::new("erosion");
    folder.write("study.ron", EROSION);
    let said = folder.abrade(&["study", "erosion", "study.ron"]);
    assert_eq!(said.code, Some(0), "{}", said.err);
    for words in ["two grains\n", "cube at 98 m/s", "30         4", "runs/study"] {
        assert!(said.out.contains(words), "{words}: {}", said.out);
    }
    let wide = "In 1 of 2 cases the displaced volume is known to no better than ± 5 % after 4 impacts: give more samples.";
    let page = std::fs::read_to_string(folder.0.join("runs/study/report.html")).unwrap();
    assert!(said.out.contains(wide) && page.contains(wide), "{}", said.out);
    let table = |place: &str| {
        std::fs::read_to_string(folder.0.join(place).join("cases.csv")).expect("a table")
    };
    let whole = table("runs/study");
    let sweep = |more: &[&str]| folder.abrade(&[&["sweep", "study.ron"], more].concat());
    let none = sweep(&["--out", "a", "--merge"]);
    assert_eq!(none.code, Some(1), "{}", none.out);
    assert!(none.err.contains("2 of 2 cases are missing"), "{}", none.err);
    let part = sweep(&["--out", "a", "--shard", "1/2", "--jobs", "1"]);
    assert_eq!(
        (part.code, part.out.as_str()),
        (Some(0), "1 of 2 cases are in a\n"),
        "{}",
        part.err
    );
    let early = sweep(&["--out", "a", "--merge"]);
    assert_eq!(early.code, Some(1), "{}", early.out);
    assert!(early.err.contains("1 of 2 cases are missing"), "{}", early.err);
    assert_eq!(sweep(&["--out", "b", "--case", "0"]).code, Some(0));
    let list = sweep(&["--out", "b", "--list"]).out;
    assert!(list.contains("0  there") && list.contains("1  -"), "{list}");
    assert_eq!(sweep(&["--out", "c", "--merge", "a", "b"]).code, Some(0));
    let one = sweep(&["--out", "d", "--case", "0", "--set", "grains={\"ball\": (form: Sphere)}"]);
    assert_eq!(one.out, "1 of 1 case is in d\n", "{}", one.err);
    assert_eq!(table("c"), whole);
    let again = folder.abrade(&["study", "erosion", "study.ron"]);
    assert_eq!((again.code, again.err.as_str()), (Some(0), ""));
    let changed = folder.abrade(&["study", "erosion", "study.ron", "--set", "samples.most=5"]);
    let note =
        "note: 2 cases are in runs/study of another study, or of this one before it changed: ";
    assert!(changed.err.starts_with(note), "{}", changed.err);
    let angles = ["--set", "angles=[\"20 deg\", \"30 deg\"]"];
    let more = folder.abrade(&[&["sweep", "study.ron", "--list"][..], &angles].concat()).out;
    let stages: Vec<_> = more.lines().map(|line| line[7..12].trim().to_owned()).collect();
    assert_eq!(stages, ["-", "there", "-", "there"]);
    // What the file of a case that is under way holds is that of a case, and the plate.
    let case = std::fs::read_dir(folder.0.join("b/cases")).unwrap().next().unwrap().unwrap().path();
    let text = std::fs::read_to_string(&case).unwrap() + "{\"depths_m\":[]}\n";
    std::fs::write(case.with_extension("begun.jsonl"), text).unwrap();
    std::fs::remove_file(case).unwrap();
    let list = sweep(&["--out", "b", "--list"]).out;
    assert!(list.contains("0  begun") && list.contains("1  -"), "{list}");
}

/// Fails for a volume of nothing that is told as a number with an interval, or by a word that nobody explains.
#[test]
fn no_debris_is_told_as_none() {
    let folder = Folder::new("erosion_none");
    folder.write("study.ron", EROSION);
    let said = folder.abrade(&["study", "erosion", "study.ron", "--out", "out"]);
    let rows: Vec<_> = said.out.lines().filter(|line| line.starts_with("      30")).collect();
    // By the removal rule a ball leaves no debris below a critical angle of 35 degrees, and a cube does.
    assert!(rows[0].contains(" none ") && !rows[1].contains("none"), "{}", said.out);
    let page = std::fs::read_to_string(folder.0.join("out/report.html")).unwrap();
    assert!(page.contains("<td>none</td>") && !page.contains("0 ± 0<"));
    for legend in ["none: no impact displaces any", "none: ball leaves none"] {
        assert!(page.contains(legend), "{legend}");
    }
}

/// One that ran first and looked later would leave a folder.
#[test]
fn a_wrong_study_is_shown_at_its_place() {
    let folder = Folder::new("erosion_bad");
    folder.write("study.ron", EROSION);
    let cases: [(&[&str], &str); 4] = [
        (&["study", "erosion", "study.ron", "--set", "samples.mots=3"], "did you mean `most`?"),
        (
            &[
                "study",
                "erosion",
                "study.ron",
                "--set",
                "grains.cube.form=Sphere",
                "--set",
                "grains.cube.spheres=2",
            ],
            "made of spheres",
        ),
        (&["sweep", "study.ron", "--case", "2"], "there are 2, from 0"),
        (&["sweep", "study.ron", "--shard", "2/2"], "I from 0 to N - 1"),
    ];
    for (arguments, told) in cases {
        let said = folder.abrade(arguments);
        assert_eq!(said.code, Some(2), "{arguments:?}: {}", said.err);
        assert!(said.err.contains(told), "{arguments:?}: {}", said.err);
        assert_eq!(folder.files(), ["scene.ron", "study.ron"]);
    }
}

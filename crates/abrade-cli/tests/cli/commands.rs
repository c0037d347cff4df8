//! `check`, `clump` and `schema`.

use super::Folder;

#[test]
fn check_says_how_large_a_scene_is_and_leaves_nothing() {
    let folder = Folder::new("check");
    let said = folder.abrade(&["check", "scene.ron", "--set", "bodies.ball.motion.angle=30 deg"]);
    assert_eq!(said.code, Some(0), "{}", said.err);
    assert_eq!(
        said.out,
        "scene    Oblique impact of a ball
surface  plate: 18480 nodes (231 x 80, 150 um apart); CapozzaHanley(Projected), Foundation of k_w 4.39e14 Pa/m, all displaced is debris; plate
body     ball: ball, 2.83e-4 kg, reach 3 mm; impact at 35 m/s, 30 deg
run      until every body has left or rests, or has slid its distance, Auto, accuracy 0.001
memory   1.66 MB for the nodes
time     a second or less
"
    );
    assert_eq!(folder.files(), ["scene.ron"]);
}

/// Fails for a study that is told as a number of cases alone, or with the wrong bounds.
#[test]
fn check_says_what_a_study_holds() {
    let folder = Folder::new("check_study");
    folder.write("study.ron", crate::studies::EROSION);
    let sets = ["--set", "angles=[\"30 deg\", \"90 deg\"]", "--set", "samples.most=10"];
    let said = folder.abrade(&[&["check", "study.ron"], &sets[..]].concat());
    assert_eq!(
        said.out,
        "study    two grains
cases    4: every grain at every speed and angle
grains   2: ball, cube; a sphere of 200 um
speeds   1: 98 m/s
angles   2: 30, 90 deg
impacts  16 to 40 in all, 4 to 10 in each case; the plate is fresh for every impact
",
        "{}",
        said.err
    );
}

/// Fails for a file that a scene names and that is told as a scene with faults.
#[test]
fn files_that_scenes_name_are_told_as_such() {
    let folder = Folder::new("parts");
    folder.write("pair.csv", "x,y,z,r\n-0.5,0,0,1\n0.5,0,0,1\n");
    folder.write("a.stl", "solid a\nendsolid a\n");
    std::fs::write(folder.0.join("b.STL"), [0xff; 90]).unwrap();
    folder.write("notes.txt", "(version: 1, name: 3)");
    for (file, told) in [
        ("pair.csv", "pair.csv is no scene: its numbers are those of a clump of 2 spheres, which"),
        ("pair.csv", "`shape: Clump(file: \"pair.csv\")`"),
        (
            "a.stl",
            "a.stl is a mesh: a scene takes it as a surface with `geometry: Mesh(file: \"a.stl\")`",
        ),
        ("b.STL", "b.STL is a mesh: "),
        ("notes.txt", "notes.txt:1:20"),
    ] {
        for command in ["check", "run"] {
            let said = folder.abrade(&[command, file]);
            assert_eq!((said.code, said.out.as_str()), (Some(2), ""));
            assert!(said.err.contains(told), "{command}: {}", said.err);
        }
    }
}

#[test]
fn clump_looks_a_file_over_and_converts_it() {
    let folder = Folder::new("clump");
    folder.write("pair.csv", "x,y,z,r\n-0.5,0,0,1\n0.5,0,0,1\n");
    let convert =
        ["clump", "pair.csv", "--density", "2500", "--convert", "kratos", "--out", "p.clu"];
    let said = folder.abrade(&convert);
    assert_eq!(said.code, Some(0), "{}", said.err);
    assert_eq!(
        said.out,
        "file      pair.csv (csv)
spheres   2
overlaps  1 pair, 15.6 % of the spheres' volume
volume    7.07 m3, the union's
mass      17700 kg at 2500 kg/m3
centre    (0, 0, 0) m
inertia   xx yy zz xy xz yz: 7510 13000 13000 0 0 0 kg m2, about the centre
reach     1.5 m from the centre
error     3e-6 of volume and inertia, at most
written   p.clu (kratos)
"
    );
    let said = folder.abrade(&["clump", "p.clu"]);
    assert!(said.out.contains("note      the file's own values differ"), "{}", said.out);
}

#[test]
fn schema_describes_every_field() {
    let folder = Folder::new("schema");
    let said = folder.abrade(&["schema"]);
    let schema: serde_json::Value = serde_json::from_str(&said.out).unwrap();
    assert!(schema.pointer("/properties/materials").is_some());
    let said = folder.abrade(&["schema", "--fields"]);
    let speed = "bodies.<name>.motion.speed (of Impact): number or \"number unit\" [m/s], required\n    \
                 Speed of the centre of mass.\n";
    assert!(said.out.contains(speed), "{}", said.out);
    let stop = "run.stop = Time(..)\n    After a time.\n";
    assert!(said.out.contains(stop), "{}", said.out);
}

/// Fails for a part with fields of others, and for a name of one's own that finds nothing.
#[test]
fn a_part_of_the_fields_can_be_asked_for() {
    let folder = Folder::new("schema part");
    let part = |prefix: &str| folder.abrade(&["schema", "--fields", prefix]);
    let paths = |said: &str| -> Vec<String> {
        let lines = said.lines().skip(3).filter(|line| !line.is_empty() && !line.starts_with(' '));
        lines.map(str::to_owned).collect()
    };
    let run = paths(&part("run").out);
    assert!(run.len() > 5 && run.iter().all(|path| path.starts_with("run")), "{run:?}");
    let speed = paths(&part("bodies.ball.motion.speed").out);
    assert!(!speed.is_empty(), "no field");
    assert!(speed.iter().all(|path| path.starts_with("bodies.<name>.motion.speed")), "{speed:?}");
    let whole = folder.abrade(&["schema", "--fields"]).out;
    assert_eq!(paths(&part("bodies.<name>").out), paths(&part("bodies.b").out));
    assert!(paths(&whole).len() > 200, "{}", whole.len());
    let none = part("bodys");
    assert_eq!(
        (none.code, none.err.as_str()),
        (Some(2), "error: no field of a scene begins with `bodys`\n")
    );
    let study = folder.abrade(&["schema", "--study", "--fields", "samples.most"]);
    assert_eq!(paths(&study.out).len(), 1, "{}", study.out);
}

/// Fails for an example of another command's file, which would be refused.
#[test]
fn the_examples_of_help_are_of_the_files_that_a_command_reads() {
    let folder = Folder::new("help");
    folder.write("bodies.ron", "(version: 1, name: \"brittle\")");
    folder.write("map.ron", super::adhesive::MAP);
    folder.write("study.ron", super::studies::EROSION);
    for (command, file, examples) in [
        (&["run"][..], "scene.ron", &["bodies.ball.motion.speed=\"30 m/s\""][..]),
        (&["study", "convergence"], "scene.ron", &["bodies.ball.motion.speed=\"30 m/s\""]),
        (&["study", "erosion"], "study.ron", &["samples.most=256", "density=\"2650 kg/m3\""]),
        (&["sweep"], "study.ron", &["samples.most=256", "density=\"2650 kg/m3\""]),
        (&["adhesive", "run"], "bodies.ron", &["bodies.overlap=0.3", "solid.adhesion=\"200 MPa\""]),
        (&["adhesive", "map"], "map.ron", &["bodies.overlap=0.3", "gaps=\"[1.2, 1.5]\""]),
    ] {
        let help = folder.abrade(&[command, &["--help"]].concat()).out;
        let words = help.split_whitespace().collect::<Vec<_>>().join(" ");
        let usage = words.split_once("Usage:").expect("usage").1;
        assert_eq!(usage.contains("<MAP>"), command.contains(&"map"), "{help}");
        assert!(words.contains("default: runs/<name of the file without .ron>"), "{help}");
        let given = words.split_once("as in ").expect("an example").1;
        let given = given.split_once(';').expect("its end").0;
        assert_eq!(given, examples.join(" or "), "{command:?}");
        for example in examples {
            // As a shell hands them over.
            let (path, value) = example.split_once('=').expect("PATH=VALUE");
            let set = format!("{path}={}", value.trim_matches('"'));
            let said = folder.abrade(&["check", file, "--set", &set]);
            assert_eq!(said.code, Some(0), "{example}: {}", said.err);
        }
    }
}

#[test]
fn wrong_usage_is_bad_input() {
    let folder = Folder::new("usage");
    assert_eq!(folder.abrade(&["fly"]).code, Some(2));
    assert_eq!(
        folder.abrade(&["clump", "none.txt"]).err,
        format!(
            "error: cannot read `none.txt`: there is no `none.txt` in `{}`\n",
            folder.0.display()
        )
    );
    let said = folder.abrade(&["clump", "scene.ron", "--density", "-1"]);
    assert_eq!(said.err, "error: --density is -1, it must be finite and above zero\n");
    assert_eq!(said.code, Some(2));
}

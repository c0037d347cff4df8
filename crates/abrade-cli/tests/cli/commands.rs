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
surface  plate: 18480 nodes (231 x 80, 150 um apart); CapozzaHanley(Projected), Foundation, all removed; plate
body     ball: ball, 2.83e-4 kg, reach 3 mm; impact at 35 m/s, 30 deg
run      until every body has left or rests, or has slid its distance, Auto, accuracy 0.001
memory   1.66 MB for the nodes
time     roughly 2.38 ms
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

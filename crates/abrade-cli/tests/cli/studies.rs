//! `study convergence`.

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
    let place = folder.0.join("runs/Oblique impact of a ball, convergence");
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

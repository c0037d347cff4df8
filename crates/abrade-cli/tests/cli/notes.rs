//! What a run says that went another way than its scene meant.

use super::Folder;

/// Fails for a body that misses the plate, or goes down beside it, and is told as one that has rebounded.
#[test]
fn a_body_that_misses_or_falls_past_its_surface_has_no_restitution() {
    let folder = Folder::new("past");
    for (place, angle, note) in [
        ("(\"40 mm\", \"0 mm\")", "90 deg", "`ball` has touched nothing"),
        ("(\"17 mm\", \"0 mm\")", "90 deg", "`ball` is below the surface that it was aimed at"),
    ] {
        let place = format!("bodies.ball.position.at={place}");
        let angle = format!("bodies.ball.motion.angle=\"{angle}\"");
        let sets = ["--set", &place, "--set", &angle, "--set", "outputs=[]"];
        let said = folder.abrade(&[&["run", "scene.ron", "--json"], &sets[..]].concat());
        assert_eq!(said.code, Some(0), "{}", said.err);
        let summary: serde_json::Value = serde_json::from_str(&said.out).unwrap();
        let warnings = summary["warnings"].as_array().unwrap();
        let is_told = warnings.iter().any(|w| w.as_str().is_some_and(|w| w.starts_with(note)));
        assert!(is_told, "{place}: {warnings:?}");
        assert!(summary["bodies"]["ball"]["restitution"].is_null(), "{summary}");
    }
}

/// Fails for a hardness without its unit that is taken as it stands without a word.
#[test]
fn a_hardness_softer_than_any_solid_is_noted_before_anything_runs() {
    let folder = Folder::new("soft");
    let said = folder.abrade(&["check", "scene.ron", "--set", "materials.plate.hardness=7"]);
    assert!(said.out.contains("a number without a unit is in Pa"), "{}", said.out);
    let said =
        folder.abrade(&["check", "scene.ron", "--set", "materials.plate.hardness=\"700 HV\""]);
    assert_eq!(said.code, Some(0), "{}", said.err);
    assert!(!said.out.contains("softer"), "{}", said.out);
}

/// Fails for a run that failed and is told by figures that end in the middle of a contact.
#[test]
fn a_run_that_failed_says_so_and_nothing_else() {
    let folder = Folder::new("failed");
    let sets =
        ["--set", "materials.plate.hardness=\"10 MPa\"", "--set", "bodies.ball.motion.speed=3000"];
    let said = folder.abrade(&[&["run", "scene.ron"], &sets[..]].concat());
    assert_eq!(said.code, Some(1), "{}{}", said.out, said.err);
    assert!(said.out.contains("failed after"), "{}", said.out);
    assert!(!said.out.contains("restitution"), "{}", said.out);
}

/// Fails for a wear rate without its name or its unit, and for places that tell different ones.
#[test]
fn a_wear_rate_is_told_with_its_unit_and_the_same_everywhere() {
    let folder = Folder::new("rate");
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/foundation/scratch.ron");
    let said = folder.abrade(&["run", scene, "--out", "out", "--set", "outputs=[Report]"]);
    assert_eq!(said.code, Some(0), "{}", said.err);
    let number = |text: &str, before: &str, after: &str| -> f64 {
        let (_, rest) = text.split_once(before).expect(before);
        rest.split_once(after).expect(after).0.trim().parse().expect("a number")
    };
    let told = number(&said.out, "wear rate at the end ", " mm3/mm");
    let read = |name: &str| std::fs::read_to_string(folder.0.join("out").join(name)).unwrap();
    let kept = number(&read("summary.json"), "\"wear_rate_m2\": ", ",");
    // Three digits, and one mm2 is 1e-6 m2.
    assert!((told - 1e6 * kept).abs() < 5e-3 * told, "{told} mm3/mm, {kept} m2");
    let page = read("report.html");
    let shown = page.split_once("Wear rate at the end").expect("a row").1;
    let shown: String = shown.chars().take(100).collect();
    assert!(shown.contains("m³/m"), "{shown}");
}

/// Fails for a run in a long contact that no interrupt can end.
#[cfg(unix)]
#[test]
fn a_second_interrupt_ends_a_run_at_once() {
    use std::process::{Command, Stdio};
    use std::thread::sleep;
    use std::time::Duration;

    let folder = Folder::new("interrupted");
    let mut run = Command::new(env!("CARGO_BIN_EXE_abrade"));
    run.current_dir(&folder.0).args(["run", "scene.ron", "--set", "materials.plate.hardness=7"]);
    let mut run = run.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let pid = run.id().to_string();
    let interrupt = || Command::new("kill").args(["-INT", &pid]).status().unwrap();
    sleep(Duration::from_millis(500));
    assert!(interrupt().success());
    sleep(Duration::from_millis(500));
    assert!(run.try_wait().unwrap().is_none(), "the contact is too short for this test");
    assert!(interrupt().success());
    assert_eq!(run.wait().unwrap().code(), Some(130));
}

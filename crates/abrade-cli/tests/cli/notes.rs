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

/// Fails for a number without its unit that is taken as it stands without a word, and for a value of some solid that
/// is not.
#[test]
fn a_value_that_no_solid_has_is_noted_before_anything_runs() {
    let folder = Folder::new("unlikely");
    let notes = |set: &str| {
        let said = folder.abrade(&["check", "scene.ron", "--set", set]);
        assert_eq!(said.code, Some(0), "{}", said.err);
        let notes = said.out.lines().filter_map(|line| line.strip_prefix("note     "));
        notes.map(str::to_owned).collect::<Vec<_>>()
    };
    let less = "less than any solid has: a bare number is in Pa";
    for (set, note) in [
        ("materials.plate.hardness=7", format!("`materials.plate.hardness` is 7 Pa, {less}")),
        ("materials.plate.young=200", format!("`materials.plate.young` is 200 Pa, {less}")),
        (
            "bodies.ball.shape.radius=3",
            "`bodies.ball` is 6 m across, the largest surface 30 mm: a bare number is in m"
                .to_owned(),
        ),
        (
            "streams.jet=(count: 3, every: 1e-3, density: 2650.0, \
             shape: Grain(form: Sphere, diameter: 200), motion: Impact(speed: 30.0, angle: 1.0), \
             position: OnSurface(surface: \"plate\"))",
            "`streams.jet` is 200 m across, the largest surface 30 mm: a bare number is in m"
                .to_owned(),
        ),
    ] {
        assert_eq!(notes(set), [note]);
    }
    for set in [
        "bodies.ball.density=1e7",
        "materials.plate.hardness=\"700 HV\"",
        "bodies.ball.shape.radius=\"100 mm\"",
    ] {
        assert_eq!(notes(set), [""; 0]);
    }
}

/// Fails for a scene that cannot show what it is for and runs without a word, and for a word about one that can.
#[test]
fn what_is_plainly_too_coarse_is_noted_before_anything_runs() {
    let folder = Folder::new("coarse");
    let notes = |sets: &[&str]| {
        let sets: Vec<&str> = sets.iter().flat_map(|set| ["--set", set]).collect();
        let said = folder.abrade(&[&["check", "scene.ron"], &sets[..]].concat());
        assert_eq!(said.code, Some(0), "{}", said.err);
        let notes = said.out.lines().filter_map(|line| line.strip_prefix("note     "));
        notes.map(str::to_owned).collect::<Vec<_>>()
    };
    let jet = "streams.jet=(count: 20, every: 1e-5, density: 2650.0, motion: Impact(speed: 80.0, angle: 1.5), \
               shape: Grain(form: Sphere, diameter: \"0.3 mm\"), \
               position: OnSurface(surface: \"plate\", gap: \"1 mm\"))";
    let coarse = "surfaces.plate.geometry.pitch=\"0.4 mm\"";
    let adhesion = "surfaces.plate.adhesion=(work: 0.1, range: 1e-9)";
    for (sets, told) in [
        (
            &[coarse][..],
            "the contact of `bodies.ball` on `plate` is about 473 um in radius, and the pitch 400 um",
        ),
        (
            &[adhesion],
            "the rim in which adhesion draws `bodies.ball` to `plate` is 2.45 um wide, and the pitch 150 um",
        ),
        (&[jet], "about 2.88 bodies of `streams.jet` are on their way at once and may meet"),
        (
            &["bodies.ball.motion.speed=2e5"],
            "`bodies.ball.motion` is of 2e5 m/s, faster than any projectile",
        ),
    ] {
        let notes = notes(sets);
        assert!(notes.len() == 1 && notes[0].starts_with(told), "{notes:?}");
    }
    for sets in [&[][..], &[jet, "run.step=1 us"]] {
        assert_eq!(notes(sets), [""; 0], "{sets:?}");
    }
}

/// Fails for a study whose numbers without units are taken as they stand without a word.
#[test]
fn a_value_that_no_solid_has_is_noted_in_a_study() {
    let folder = Folder::new("unlikely_study");
    folder.write("study.ron", crate::studies::EROSION);
    let sets = ["--set", "size.diameter=200", "--set", "target.material.hardness=17"];
    let said = folder.abrade(&[&["check", "study.ron"], &sets[..]].concat());
    for field in ["`target.material.hardness` is 17 Pa, less", "`size.diameter` is 200 m, more"] {
        assert!(said.out.contains(&format!("note     {field} than any solid has")), "{}", said.out);
    }
    let sets = ["--set", "density=2.65"];
    let said = folder.abrade(&[&["sweep", "study.ron", "--case", "0"], &sets[..]].concat());
    assert!(said.err.contains("note: `density` is 2.65 kg/m3, less"), "{}", said.err);
}

/// Fails for a body beside its plate that is told only after the run, and for one that comes over it which is told.
#[test]
fn a_body_that_comes_to_no_plate_is_noted_before_anything_runs() {
    let folder = Folder::new("beside");
    let check = |place: &str, angle: &str| {
        let place = format!("bodies.ball.position.at={place}");
        let angle = format!("bodies.ball.motion.angle=\"{angle}\"");
        folder.abrade(&["check", "scene.ron", "--set", &place, "--set", &angle]).out
    };
    let note = "note     `bodies.ball` comes to no plate on its way";
    // The plate is 30 mm long and 12 mm wide, the ball 6 mm across, and flies along x.
    for (place, angle) in
        [("(0.04, 0.0)", "45 deg"), ("(0.0, 0.02)", "45 deg"), ("(-0.04, 0.0)", "60 deg")]
    {
        let said = check(place, angle);
        assert!(said.contains(note), "{place} {said}");
    }
    for (place, angle) in
        [("(0.0, 0.0)", "45 deg"), ("(0.017, 0.0)", "90 deg"), ("(-0.04, 0.0)", "2 deg")]
    {
        let said = check(place, angle);
        assert!(!said.contains("comes to no plate"), "{place} {said}");
    }
}

/// Fails for a crater that is cut off by the rim of its plate without a word, and for a note about one that is whole.
#[test]
fn a_crater_at_the_rim_is_noted() {
    let folder = Folder::new("rim");
    let note = "  note: the wear on `plate` reaches the rim of the plate, beyond which there is nothing to wear";
    for (place, cure) in
        [("(0.0, 0.0)", None), ("(0.0147, 0.0)", Some("longer")), ("(0.0, 0.0057)", Some("wider"))]
    {
        let place = format!("bodies.ball.position.at={place}");
        let said = folder.abrade(&["run", "scene.ron", "--set", &place, "--set", "outputs=[]"]);
        assert_eq!(said.code, Some(0), "{}", said.err);
        match cure {
            Some(cure) => {
                assert!(said.out.contains(&format!("{note}: make it {cure}\n")), "{}", said.out)
            }
            None => assert!(!said.out.contains("note"), "{}", said.out),
        }
    }
}

/// Fails for notes that come when the run is over, come twice, or go among the figures.
#[test]
fn notes_of_the_scene_come_once_and_before_the_figures() {
    let folder = Folder::new("noted");
    let soft = "materials.plate.hardness=9000";
    let sets = ["--set", soft, "--set", "bodies.ball.motion.speed=0.001", "--set", "outputs=[]"];
    let said = folder.abrade(&[&["run", "scene.ron"], &sets[..]].concat());
    assert_eq!(said.code, Some(0), "{}", said.err);
    assert_eq!(said.err.matches("than any solid has").count(), 1, "{}", said.err);
    assert!(said.err.starts_with("note: "), "{}", said.err);
    assert!(!said.out.contains("than any solid"), "{}", said.out);
}

/// Fails for a ratio of speeds that is told as the restitution of textbooks, and for one of those
/// that is taken along another direction than the plate's normal.
#[test]
fn what_a_body_keeps_of_its_speed_is_told_as_that() {
    let folder = Folder::new("keeps");
    let run = |more: &[&str]| folder.abrade(&[&["run", "scene.ron"], more].concat());
    let said = run(&["--json", "--set", "outputs=[]"]);
    let summary: serde_json::Value = serde_json::from_str(&said.out).unwrap();
    let ball = &summary["bodies"]["ball"];
    let up = ball["velocity_m_s"][2].as_f64().unwrap();
    let normal = ball["restitution_normal"].as_f64().unwrap();
    let down = 35.0 * std::f64::consts::FRAC_1_SQRT_2;
    assert!((normal - up / down).abs() < 1e-9, "{normal}: {up} of {down} m/s");
    let whole = ball["restitution"].as_f64().unwrap();
    let angle = ball["rebound_angle_deg"].as_f64().unwrap();
    let told = format!("leaves with {whole:.3} of its speed, at {angle:.1} deg from the surface\n");
    let said = run(&["--set", "outputs=[]"]);
    assert!(said.out.contains(&told), "{told}: {}", said.out);
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
    assert!(!said.out.contains("leaves"), "{}", said.out);
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
    assert!(shown.contains("mm³/mm"), "{shown}");
    let shown = number(&shown, "<td>", "&nbsp;");
    assert!((shown - told).abs() < 5e-3 * told, "{told} mm3/mm, {shown} mm3/mm");
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

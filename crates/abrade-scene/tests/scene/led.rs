//! Surfaces led along a path: where they are, what they do to what they meet, and when a run ends.

use std::f64::consts::{FRAC_PI_4, TAU};
use std::path::PathBuf;

use abrade_report::Summary;
use abrade_scene::{Checked, Precision, load_text};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::moving::{column, ran};

const SCENE: &str = r#"(version: 1, name: "led",
    materials: {"m": (hardness: "0.1 GPa", young: "10 GPa", friction: 0.2)},
    surfaces: {"s": (material: "m", geometry: GEOMETRY, motion: MOTION)},
    bodies: {"b": (shape: Ball(radius: "5 mm"), density: 2500.0, BODY)},
    run: (RUN), outputs: [Energy, History(every: "1 ms")])"#;

const PLATE: &str = r#"HexStrip(length: "12 mm", width: "12 mm", pitch: "0.2 mm")"#;
const CUBE: &str = r#"Cuboid(half_extents: ("10 mm", "10 mm", "10 mm"), pitch: "2 mm")"#;
const RADIUS: f64 = 5e-3;

fn scene(geometry: &str, motion: &str, body: &str, run: &str) -> Checked {
    let text = SCENE.replace("GEOMETRY", geometry).replace("MOTION", motion);
    let text = text.replace("BODY", body).replace("RUN", run);
    load_text("led", text, PathBuf::new(), &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// Fails for a path that drifts, is a step late, is that of the middle of the plate's box, is rounded
/// away in `f32`, or bent by Rapier's rule of turning.
#[test]
fn a_led_surface_is_on_its_path_after_every_step() {
    let away = r#"position: At(point: (1, 0, 0))"#;
    let run = r#"stop: Time(limit: "0.2 s"), step: "1 ms""#;
    let swing = |time: f64| (TAU * 20.0 * time + 0.5).sin();
    let go = r#"Reciprocating(amplitude: ("3 mm", 0, "-1 mm"), frequency: "20 Hz", phase: 0.5)"#;
    let rock = r#"Rocking(axis: (2, 0, 0), angle: "80 deg", frequency: "20 Hz", phase: 0.5)"#;
    for (precision, round) in [(Precision::Double, 1e-12), (Precision::Single, 1e-6)] {
        let (_, folder) = ran(&scene(PLATE, go, away, run), "led_along", precision);
        let [time, x, z] = ["time_s", "s_x_m", "s_z_m"].map(|name| column(&folder, name));
        assert!(time.len() > 190);
        for (i, time) in time.iter().enumerate() {
            assert!((x[i] - 3e-3 * swing(*time)).abs() < round * 3e-3, "{time}: {}", x[i]);
            assert!((z[i] + 1e-3 * swing(*time)).abs() < round * 3e-3, "{time}: {}", z[i]);
        }
        let (outcome, _) = ran(&scene(PLATE, rock, away, run), "led_about", precision);
        let motion = outcome.summary.surfaces["s"].motion.expect("it moves");
        let [x, y, z, w] = motion.rotation_xyzw;
        let found = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
        let angle = 80f64.to_radians() * swing(outcome.summary.simulated);
        let turned = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), angle);
        let place = Vector3::from(motion.position);
        assert!(place.norm() < 0.1 * round, "{place}");
        assert!(found.angle_to(&turned) < 10.0 * round, "{}", found.angle_to(&turned));
    }
}

/// How fast the ball flies down, and the swing of the plate under it.
const SPEED: f64 = 5.0;
const AMPLITUDE: f64 = 5e-3;
const FREQUENCY: f64 = 50.0;

/// The summary of a ball on a plate that goes as `motion` says, met at `time` [s] at `height` [m],
/// in steps of `step` [s].
fn struck(motion: &str, height: f64, time: f64, step: f64) -> Summary {
    // A billionth later, so that the step that ends then is over.
    let from = height + RADIUS + SPEED * time * (1.0 + 1e-9);
    let body =
        format!("position: At(point: (0, 0, {from})), motion: Free(velocity: (0, 0, {}))", -SPEED);
    let run = format!("stop: Time(limit: {}), step: {step}, accuracy: 1e-4", time + 2e-3);
    let name = format!("struck_{}_{:.0}", motion.len(), 1e8 * (time + step));
    let (outcome, _) = ran(&scene(PLATE, motion, &body, &run), &name, Precision::Double);
    outcome.summary
}

/// W [m3] of a ball that meets the plate at an eighth of a period, `time` [s] after the start.
fn worn_in_mid_stroke(time: f64, step: f64) -> f64 {
    let phase = FRAC_PI_4 - TAU * FREQUENCY * time;
    let motion = format!(
        "Reciprocating(amplitude: (0, 0, {AMPLITUDE}), frequency: {FREQUENCY}, phase: {phase})"
    );
    let height = AMPLITUDE * FRAC_PI_4.sin();
    struck(&motion, height, time, step).surfaces["s"].wear_volume
}

/// W [m3] of a ball that meets a plate which moves up at constant `speed` [m/s].
fn worn_at(speed: f64) -> f64 {
    let motion = format!("Kinematic(velocity: (0, 0, {speed}))");
    struck(&motion, 1.6e-3 * speed, 1.6e-3, 4e-4).surfaces["s"].wear_volume
}

/// The plate has its mean velocity of a step: at the beginning of one it is off by half of step *
/// acceleration, half-way by (2 pi f step)^2 / 24 of itself. Fails for a velocity of the step's
/// beginning or end, for one that is a step late, and for one that does not follow the path.
#[test]
fn what_a_strike_in_mid_stroke_is_off_by_falls_with_the_step() {
    let omega = TAU * FREQUENCY;
    let speed = AMPLITUDE * omega * FRAC_PI_4.cos();
    let exact = worn_at(speed);
    let off = |worn: f64| worn / exact - 1.0;
    let chord = |from: f64, to: f64| {
        let place = |time: f64| AMPLITUDE * (omega * time + FRAC_PI_4).sin();
        (place(to) - place(from)) / (to - from)
    };
    let steps = [8e-4, 4e-4, 2e-4];
    let begun = steps.map(|step| off(worn_in_mid_stroke(1.6e-3, step)));
    let between = steps.map(|step| off(worn_in_mid_stroke(1.6e-3 + 0.5 * step, step)));
    println!("at the beginning {begun:?}, half-way {between:?}");
    for (i, step) in steps.into_iter().enumerate() {
        let expected = off(worn_at(chord(0.0, step)));
        assert!((begun[i] - expected).abs() < 3e-4, "{step}: {} {expected}", begun[i]);
        let half = 0.5 * step;
        let expected = off(worn_at(chord(-half, half)));
        assert!((between[i] - expected).abs() < 3e-4, "{step}: {} {expected}", between[i]);
    }
    for pair in begun.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((0.9..1.2).contains(&order), "{begun:?}");
    }
    assert!(between.iter().zip(&begun).all(|(b, a)| b.abs() < 0.2 * a.abs()), "{between:?}");
}

/// The plate's leader works by the impulse times its velocity. Fails for work of the speed before
/// the corner, or of the mean over a step that cuts it, and for a ledger without it.
#[test]
fn what_leads_a_plate_pays_for_the_blow() {
    let points = r#"[(time: "1.5 ms"), (time: "6.5 ms", shift: (0, 0, "10 mm"))]"#;
    let motion = format!("Path(points: {points})");
    let summary = struck(&motion, 2e-4, 1.6e-3, 1e-3);
    let energy = summary.energy.expect("a ledger");
    let mass = 2500.0 * TAU * 2.0 / 3.0 * RADIUS.powi(3);
    let impulse = mass * (summary.bodies["b"].velocity[2] + SPEED);
    let work = impulse * 2.0;
    assert!((energy.external_work / work - 1.0).abs() < 1e-4, "{energy:?} {work}");
    let kept = energy.kinetic + energy.elastic + energy.friction + energy.wear + energy.damping;
    let gap = energy.initial + energy.external_work - kept - energy.history - energy.numerical;
    assert!(gap.abs() < 1e-9 * energy.initial, "{gap} {energy:?}");
    assert!(energy.numerical.abs() < 2e-3 * energy.initial, "{energy:?}");
    // It is worn as if the plate had always moved so.
    let worn = summary.surfaces["s"].wear_volume / worn_at(2.0);
    assert!((worn - 1.0).abs() < 1e-3, "{worn}");
}

/// Fails for a stop rule that takes a ball at rest, or one that moves away slower than the plate
/// comes back, for one that has seen the last of it; and for one that never ends.
#[test]
fn a_run_waits_for_a_surface_that_is_still_to_come() {
    let at_rest = r#"position: At(point: (0, 0, "8 mm"))"#;
    let rises = r#"position: At(point: (0, 0, "8 mm")), motion: Free(velocity: (0, 0, "0.1 m/s"))"#;
    let dwell = r#"Path(points: [(time: "4 ms"), (time: "9 ms", shift: (0, 0, "12 mm"))])"#;
    let swing = r#"Reciprocating(amplitude: (0, 0, "6 mm"), frequency: "50 Hz", phase: "180 deg")"#;
    let led = "Kinematic(velocity: (0, 0, \"2 m/s\"))";
    let run = r#"stop: AllRebounded, step: "0.5 ms""#;
    let cases =
        [(dwell, at_rest), (dwell, rises), (swing, at_rest), (swing, rises), (led, at_rest)];
    for (i, (motion, body)) in cases.into_iter().enumerate() {
        let name = format!("waits_{i}");
        let (outcome, _) = ran(&scene(PLATE, motion, body, run), &name, Precision::Double);
        let summary = outcome.summary;
        assert!(summary.complete && summary.surfaces["s"].wear_volume > 1e-13, "{i}: {summary:?}");
        assert!(summary.bodies["b"].velocity[2] > 1.0 && summary.simulated < 0.1, "{i}");
    }
    let beside = r#"position: At(point: ("30 mm", 0, "8 mm"))"#;
    let (outcome, _) = ran(&scene(PLATE, swing, beside, run), "waits_not", Precision::Double);
    assert!(outcome.summary.simulated < 1e-3, "nothing can meet this ball");
}

/// Fails for a body on a surface that is placed where the surface will be later.
#[test]
fn a_body_lies_where_its_surface_begins() {
    let motion = r#"Path(points: [(time: 0, shift: (0, 0, "7 mm"), rotation: AxisAngle(axis: (1, 0, 0),
        angle: "90 deg")), (time: 1)])"#;
    let body = r#"position: OnSurface(surface: "s", gap: "1 mm")"#;
    let built = scene(PLATE, motion, body, "").build().expect("built");
    let at = built.bodies["b"].state.position.coords;
    assert!((at - Vector3::new(0.0, -6e-3, 7e-3)).norm() < 1e-12, "{at}");
    assert!((built.surfaces["s"].pose.translation.vector.z - 7e-3).abs() < 1e-15);
}

/// Fails for a file whose lengths or quaternion are read in another order or unit.
#[test]
fn a_path_in_a_file_is_that_of_its_points() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("led");
    std::fs::create_dir_all(&folder).expect("a folder");
    let rows = "# t, x, y, z [mm], qx, qy, qz, qw\n0, 0, 0, 0\n0.5, 1, 2, 3, 0, 0, 1, 1\n";
    std::fs::write(folder.join("path.csv"), rows).expect("a file");
    let of = |motion: &str| {
        let text = SCENE.replace("GEOMETRY", CUBE).replace("MOTION", motion);
        let text = text.replace("BODY", "position: At(point: (1, 0, 0))").replace("RUN", "");
        load_text("led", text, folder.clone(), &[]).unwrap_or_else(|error| panic!("{error}"))
    };
    let file = of(r#"Path(file: "path.csv", scale: 1e-3)"#);
    let points = of(r#"Path(points: [(time: 0), (time: 0.5, shift: ("1 mm", "2 mm", "3 mm"),
        rotation: AxisAngle(axis: (0, 0, 1), angle: "90 deg"))])"#);
    for time in [0.0, 0.2, 0.5, 3.0] {
        let [a, b] = [&file, &points].map(|checked| checked.paths["s"].at(time));
        assert!((a.translation.vector - b.translation.vector).norm() < 1e-15, "{time}");
        assert!(a.rotation.angle_to(&b.rotation) < 1e-12, "{time}");
    }
}

/// Fails for a row that is due at the end of a step, and is shown with the next one, which has no
/// force yet, because the sum of the steps is rounded.
#[test]
fn a_history_shows_the_force_at_the_end_of_a_step() {
    let body = r#"position: At(point: (0, 0, "5 mm")), motion: Free(velocity: (0, 0, "-10 mm/s"))"#;
    let text = SCENE.replace("2500.0", "1e8").replace("GEOMETRY", PLATE).replace("BODY", body);
    let text = text.replace("MOTION", "Fixed");
    let text = text.replace("RUN", r#"stop: Time(limit: "5.5 ms"), step: "0.1 ms""#);
    let checked = load_text("led", text, PathBuf::new(), &[]).unwrap_or_else(|e| panic!("{e}"));
    let (_, folder) = ran(&checked, "history", Precision::Double);
    let force = column(&folder, "b_fz_N");
    assert!(force.len() == 6 && force[1..].iter().all(|force| *force > 0.0), "{force:?}");
}

/// Fails for a check that lets a surface turn so far in a step that the short way around is the
/// wrong one.
#[test]
fn a_wide_swing_needs_more_steps() {
    let wide = r#"Rocking(axis: (1, 0, 0), angle: "720 deg", frequency: "10 Hz")"#;
    let text = SCENE.replace("GEOMETRY", PLATE).replace("MOTION", wide).replace("RUN", "");
    let text = text.replace("BODY", "position: At(point: (1, 0, 0))");
    let load = |sets: &[String]| load_text("led", text.clone(), PathBuf::new(), sets);
    let error = load(&[]).expect_err("24 steps in a period").to_string();
    assert!(error.contains("has fewer than 50 steps in a period"), "{error}");
    assert!(load(&["run.step=1.9 ms".to_owned()]).is_ok(), "52 steps in a period");
}

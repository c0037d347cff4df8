//! Surfaces that move: what the words mean, and what a run makes of them.

use std::path::PathBuf;

use abrade_scene::{Checked, Outcome, Precision, Progress, RunOptions, SceneError, load_text, run};
use nalgebra::{Point3, UnitQuaternion, Vector3};

const SCENE: &str = r#"(version: 1, name: "moving",
    materials: {"m": (hardness: "0.1 GPa", young: "10 GPa", friction: 0.2)},
    surfaces: {"s": (material: "m", geometry: GEOMETRY, motion: MOTION,
        position: (0.5, 0, 0), rotation: AxisAngle(axis: (0, 0, 1), angle: "90 deg"))},
    bodies: {"b": (shape: Ball(radius: "5 mm"), density: 2500.0,
        position: InFrame(surface: "s", point: ("1 mm", 0, "20 mm")),
        motion: Free(velocity: (0, 0, "-20 m/s")))},
    run: (stop: Time(limit: "2 ms"), step: "0.1 ms"),
    outputs: [Energy, History(every: "0.1 ms"), Surface(at: End)])"#;

const CUBE: &str = r#"Cuboid(half_extents: ("10 mm", "10 mm", "10 mm"), pitch: "2 mm")"#;

fn load(geometry: &str, motion: &str, sets: &[&str]) -> Result<Checked, SceneError> {
    let text = SCENE.replace("GEOMETRY", geometry).replace("MOTION", motion);
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    load_text("moving", text, PathBuf::new(), &sets)
}

fn checked(geometry: &str, motion: &str) -> Checked {
    load(geometry, motion, &[]).unwrap_or_else(|error| panic!("{error}"))
}

struct Quiet;

impl Progress for Quiet {
    fn advance(&mut self, _: f64, _: Option<f64>) -> bool {
        true
    }
}

/// Runs a scene into a folder of the test's own.
pub(crate) fn ran(checked: &Checked, test: &str, precision: Precision) -> (Outcome, PathBuf) {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("moving").join(test);
    let options = RunOptions { folder: folder.clone(), precision };
    let outcome = run(checked, &options, &mut Quiet).expect("a run");
    assert!(outcome.failure.is_none(), "{:?}", outcome.failure);
    (outcome, folder)
}

/// A column of the history.
pub(crate) fn column(folder: &std::path::Path, name: &str) -> Vec<f64> {
    let text = std::fs::read_to_string(folder.join("history.csv")).expect("a history");
    let mut lines = text.lines();
    let names = lines.next().expect("a header");
    let at = names.split(',').position(|n| n == name).unwrap_or_else(|| panic!("no {name}"));
    let number = |line: &str| line.split(',').nth(at).and_then(|n| n.parse().ok());
    lines.map(|line| number(line).expect("a number")).collect()
}

/// Fails for a mass of the box around the solid, and for a body about the frame's origin.
#[test]
fn a_free_surface_weighs_what_its_mesh_bounds() {
    let tip = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("moving");
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join("tip.obj"), tip).expect("a file");
    let text = SCENE
        .replace("GEOMETRY", r#"Mesh(file: "tip.obj", scale: 0.012)"#)
        .replace("MOTION", "Free(density: 3000, velocity: (1, 2, 3), spin: (4, 5, 6))");
    let built = load_text("moving", text, folder, &[]).expect("a scene").build().expect("built");
    let surface = &built.surfaces["s"];
    let carrier = surface.carrier.expect("a carrier");
    let mass = 3000.0 * 0.012f64.powi(3) / 6.0;
    assert!((carrier.inertia.expect("a mass").mass / mass - 1.0).abs() < 1e-12);
    let centre = Point3::new(0.5 - 0.003, 0.003, 0.003);
    assert!((carrier.state.position - centre).norm() < 1e-12, "{:?}", carrier.state);
    assert_eq!(carrier.state.velocity, Vector3::new(1.0, 2.0, 3.0));
    assert_eq!(carrier.state.spin, Vector3::new(4.0, 5.0, 6.0));
    let frame = carrier.frame(&carrier.state);
    assert!((frame.translation.vector - surface.pose.translation.vector).norm() < 1e-12);
}

/// Fails for a cube that does not feel the blow, or feels it in another frame than the ball's; for
/// energies that forget the cube; and for files that leave it where it was.
#[test]
fn a_ball_gives_a_free_cube_what_it_loses() {
    let checked = checked(CUBE, "Free(density: 500, velocity: (0, 0, \"2 m/s\"))");
    for (precision, round) in [(Precision::Double, 1e-9), (Precision::Single, 1e-5)] {
        let (outcome, folder) = ran(&checked, "free", precision);
        let ball = checked.solids["b"].inertia.mass;
        let cube = 500.0 * 8e-6;
        let summary = &outcome.summary;
        let motion = summary.surfaces["s"].motion.expect("it moves");
        let momentum = Vector3::from(motion.velocity) * cube
            + Vector3::from(summary.bodies["b"].velocity) * ball;
        let before = Vector3::new(0.0, 0.0, 2.0 * cube - 20.0 * ball);
        assert!((momentum - before).norm() < round * 20.0 * ball, "{momentum} {before}");
        let gained = Vector3::from(motion.velocity).z - 2.0;
        assert!(gained < -1.0 && Vector3::from(motion.spin).norm() > 1.0, "{motion:?}");
        let energy = summary.energy.expect("a ledger");
        let initial = 0.5 * ball * 400.0 + 0.5 * cube * 4.0;
        assert!((energy.initial / initial - 1.0).abs() < 1e-6, "{energy:?}");
        let kept = energy.kinetic + energy.elastic + energy.friction + energy.wear;
        assert!((kept + energy.history + energy.numerical - initial).abs() < 1e-5 * initial);
        assert!(energy.external_work.abs() < 1e-5 * initial, "{energy:?}");
        assert!(energy.numerical.abs() < 2e-3 * initial, "{energy:?}");

        let [z, v] = ["s_z_m", "s_vz_m_s"].map(|name| column(&folder, name));
        assert!(z[0].abs() < 1e-12 && (v[0] - 2.0).abs() < 1e-12, "{} {}", z[0], v[0]);
        assert!((v[v.len() - 1] - motion.velocity[2]).abs() < 1e-6);
        let late = summary.simulated - column(&folder, "time_s").pop().expect("a row");
        let end = z[z.len() - 1] + late * motion.velocity[2];
        assert!((end - motion.position[2]).abs() < 1e-7, "{end} {motion:?}");
        let kinetic = column(&folder, "kinetic_J");
        assert!((kinetic[0] / initial - 1.0).abs() < 1e-6);
    }
}

/// Fails for a led surface that the blow moves, one that turns about another point than the origin
/// of its frame, and for a ball that it does not drag along.
#[test]
fn a_led_surface_goes_as_it_is_told() {
    let tube = r#"Cuboid(half_extents: ("10 mm", "20 mm", "10 mm"), pitch: "2 mm")"#;
    let motion = "Kinematic(velocity: (\"3 m/s\", 0, 0), spin: (0, 0, \"200 rad/s\"))";
    let checked = checked(tube, motion);
    let (outcome, folder) = ran(&checked, "led", Precision::Double);
    let summary = &outcome.summary;
    assert!(summary.surfaces["s"].wear_volume > 0.0);
    let motion = summary.surfaces["s"].motion.expect("it moves");
    let place = Vector3::from(motion.position);
    assert!((place - Vector3::new(0.506, 0.0, 0.0)).norm() < 1e-9, "{motion:?}");
    let quarter = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2);
    let turned = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.4) * quarter;
    let [x, y, z, w] = motion.rotation_xyzw;
    let found = UnitQuaternion::new_normalize(nalgebra::Quaternion::new(w, x, y, z));
    assert!(found.angle_to(&turned) < 1e-6, "{motion:?}");
    let dragged = summary.bodies["b"].velocity[0];
    assert!(dragged > 0.1, "{:?}", summary.bodies["b"]);
    let energy = summary.energy.expect("a ledger");
    assert!(energy.external_work != 0.0, "what leads it does work: {energy:?}");
    for (time, x) in column(&folder, "time_s").iter().zip(column(&folder, "s_x_m")) {
        assert!((x - 0.5 - 3.0 * time).abs() < 1e-9, "{time}: {x}");
    }
}

/// Fails for a check that lets a plate have a mass, a name stand for two motions, or a drive press
/// on what runs away.
#[test]
fn what_cannot_move_is_refused() {
    let plate = r#"HexStrip(length: "30 mm", width: "12 mm", pitch: "1 mm")"#;
    let cases = [
        (
            plate,
            "Free(density: 1000)",
            vec![],
            "the surface `s` cannot be free: a plate has no mass",
        ),
        (CUBE, "Free(density: 0)", vec![], "`surfaces.s.motion.density` is out of range"),
        (
            plate,
            "Kinematic(velocity: (1, 0, 0))",
            vec![
                "bodies.b.motion=Drive(indent_to: 5)",
                "bodies.b.position=OnSurface(surface: \"s\")",
            ],
            "`bodies.b` cannot be driven over the surface `s`, which moves",
        ),
    ];
    for (geometry, motion, sets, message) in cases {
        let error = load(geometry, motion, &sets).expect_err(message);
        assert_eq!(error.problems.len(), 1, "{error}");
        assert!(error.to_string().contains(message), "{error}");
    }
    let text = SCENE.replace("GEOMETRY", CUBE).replace("MOTION", "Kinematic()");
    let text = text.replace("\"b\":", "\"s\":");
    let error = load_text("moving", text, PathBuf::new(), &[]).expect_err("one name");
    let message = "a body and a surface that moves are both called `s`";
    assert!(error.to_string().contains(message), "{error}");
}

/// A cube that falls on a body that is fixed.
const FALLING: &str = "Free(density: 500, velocity: (0, 0, \"-5 m/s\"))";
const FLOOR: [&str; 6] = [
    "bodies.b.shape=Cuboid(size: (1, 1, 0.1))",
    "bodies.b.position=At(point: (0.5, 0, -0.075))",
    "bodies.b.motion=Fixed",
    "bodies.b.density=1",
    "surfaces.s.rotation=AxisAngle(axis: (1, 2, 0), angle: \"50 deg\")",
    "run.stop=Time(limit: \"20 ms\")",
];

/// Fails for an error that has the engine's number in the place of a name.
#[test]
fn a_free_cube_that_fails_is_named() {
    let soft = "materials.m.hardness=1 kPa";
    let checked = load(CUBE, FALLING, &[&FLOOR[..], &[soft]].concat());
    let checked = checked.unwrap_or_else(|error| panic!("{error}"));
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("moving/named");
    let options = RunOptions { folder, precision: Precision::Double };
    let failure = run(&checked, &options, &mut Quiet).expect("a run").failure;
    let failure = failure.expect("a crater deeper than the cube").to_string();
    assert!(failure.starts_with("body `s` on surface `s`: "), "{failure}");
}

/// Fails for a floor that needs a density, that falls, or on which nothing wears.
#[test]
fn a_free_cube_wears_on_a_fixed_body() {
    let endless = load(CUBE, FALLING, &[&FLOOR[..], &["run.stop=AllRebounded"]].concat());
    let message = "the run would be over at once: no body can leave a surface";
    assert!(endless.expect_err(message).to_string().contains(message));
    let checked = load(CUBE, FALLING, &FLOOR);
    let checked = checked.unwrap_or_else(|error| panic!("{error}"));
    let (outcome, _) = ran(&checked, "floor", Precision::Double);
    let summary = &outcome.summary;
    assert_eq!(summary.bodies["b"].position, [0.5, 0.0, -0.075]);
    let surface = &summary.surfaces["s"];
    let motion = surface.motion.expect("it moves");
    assert!(surface.wear_volume > 1e-12 && motion.velocity[2] > 0.0, "{surface:?}");
    let left = summary.warnings.iter().filter(|warning| warning.contains("left to the engine"));
    assert_eq!(left.count(), 0, "{:?}", summary.warnings);
}

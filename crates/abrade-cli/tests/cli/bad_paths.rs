//! Paths along which no surface can be led: the whole message.

use super::refused;

const FIXED: &str = "motion: Fixed,";
const FILE: &str = r#"motion: Path(file: "path.csv"),"#;

#[test]
fn a_swing_finer_than_the_steps() {
    refused(
        "a_swing_finer_than_the_steps",
        &[(FIXED, r#"motion: Reciprocating(amplitude: ("5 mm", 0, 0), frequency: "50 Hz"),"#)],
        &[],
        &["run.step=2 ms"],
        r#"error: `surfaces.plate.motion` has fewer than 20 steps in a period
  --> scene.ron:14:67
   |
14 |       motion: Reciprocating(amplitude: ("5 mm", 0, 0), frequency: "50 Hz"),
   |                                                                   ^^^^^^^ a period of 2.000e-2 s
   |
  ::: --set:1:10
   |
 1 | run.step=2 ms
   |          ---- a step of 2.000e-3 s
   |
   = help: `run.step` must be at most 1.000e-3 s

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_swing_without_a_frequency_or_an_axis() {
    refused(
        "a_swing_without_a_frequency_or_an_axis",
        &[(FIXED, r#"motion: Rocking(axis: (0, 0, 0), angle: "5 deg", frequency: "-2 Hz"),"#)],
        &[],
        &[],
        r#"error: `surfaces.plate.motion.axis` has no direction
  --> scene.ron:14:29
   |
14 |       motion: Rocking(axis: (0, 0, 0), angle: "5 deg", frequency: "-2 Hz"),
   |                             ^^^^^^^^^ must be finite and of a length above zero

error: `surfaces.plate.motion.frequency` is out of range
  --> scene.ron:14:67
   |
14 |       motion: Rocking(axis: (0, 0, 0), angle: "5 deg", frequency: "-2 Hz"),
   |                                                                   ^^^^^^^ must be finite and above zero

scene.ron: 2 problems, nothing was run
"#,
    );
}

#[test]
fn points_that_are_no_path() {
    let path = |points: &str| format!("motion: Path(points: [{points}], repeat: true),");
    let still = r#"(time: "1 s"), (time: "1 s")"#;
    refused(
        "points_at_one_time",
        &[(FIXED, path(still).as_str())],
        &[],
        &[],
        r#"error: `surfaces.plate.motion.points.1.time` is out of order
  --> scene.ron:14:51
   |
14 |       motion: Path(points: [(time: "1 s"), (time: "1 s")], repeat: true),
   |                                                   ^^^^^ must be later than the one before

scene.ron: 1 problem, nothing was run
"#,
    );
    let open = r#"(time: 0), (time: 1, shift: (1, 0, 0))"#;
    refused(
        "a_path_that_does_not_close",
        &[(FIXED, path(open).as_str())],
        &[],
        &[],
        r#"error: `surfaces.plate.motion` is no path
  --> scene.ron:14:28
   |
14 |       motion: Path(points: [(time: 0), (time: 1, shift: (1, 0, 0))], repeat: true),
   |                            ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ must end where it begins, since it repeats

scene.ron: 1 problem, nothing was run
"#,
    );
    let round = r#"(time: 0), (time: 1, rotation: AxisAngle(axis: (0, 0, 1), angle: "360 deg"))"#;
    refused(
        "a_full_turn_in_one_leg",
        &[(FIXED, path(round).as_str())],
        &[],
        &[],
        r#"error: `surfaces.plate.motion.points.1` is turned by 360 deg from the point before it
  --> scene.ron:14:60
   |
14 |       motion: Path(points: [(time: 0), (time: 1, rotation: AxisAngle(axis: (0, 0, 1), angle: "360 deg"))], repeat: true),
   |                                                            ^^^^^^^^^ must be below 180 deg: put points between

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_path_in_two_places_or_none() {
    let both = r#"motion: Path(points: [(time: 0)], file: "path.csv"),"#;
    refused(
        "a_path_in_two_places",
        &[(FIXED, both)],
        &[],
        &[],
        r#"error: `surfaces.plate.motion` must have either `points` or `file`
  --> scene.ron:14:15
   |
14 |       motion: Path(points: [(time: 0)], file: "path.csv"),
   |               ^^^^ give one of them

scene.ron: 1 problem, nothing was run
"#,
    );
    refused(
        "a_path_that_is_not_there",
        &[(FIXED, FILE)],
        &[],
        &[],
        r#"error: the path `path.csv` cannot be read: there is no `path.csv` in `{here}`
  --> scene.ron:14:26
   |
14 |       motion: Path(file: "path.csv"),
   |                          ^^^^^^^^^^

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_bad_line_of_a_path() {
    refused(
        "a_bad_line_of_a_path",
        &[(FIXED, FILE)],
        &[("path.csv", "# t, x, y, z\n0, 0, 0, 0\n1, 0, 0\n")],
        &[],
        r#"error: the path `path.csv` has a bad line
  --> path.csv:3:1
   |
 3 | 1, 0, 0
   | ^^^^^^^ has 3 numbers, not t, x, y, z, or these and qx, qy, qz, qw
   |
  ::: scene.ron:14:26
   |
14 |       motion: Path(file: "path.csv"),
   |                          ---------- named here

scene.ron: 1 problem, nothing was run
"#,
    );
    refused(
        "a_line_of_a_path_that_comes_too_late",
        &[(FIXED, FILE)],
        &[("path.csv", "0, 0, 0, 0\n2, 0, 0, 1\n1.5, 0, 0, 0\n")],
        &[],
        r#"error: the path `path.csv` has a bad line
  --> path.csv:3:1
   |
 3 | 1.5, 0, 0, 0
   | ^^^^^^^^^^^^ must be later than the one before
   |
  ::: scene.ron:14:26
   |
14 |       motion: Path(file: "path.csv"),
   |                          ---------- named here

scene.ron: 1 problem, nothing was run
"#,
    );
}

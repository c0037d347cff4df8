//! Copies of a surface that cannot be: the whole message.

use super::refused;

const STRIP: &str = r#"geometry: HexStrip(length: "30 mm", width: "12 mm", pitch: "0.15 mm"),"#;
const BALL: &str = r#"geometry: Sphere(radius: "5 mm", pitch: "2 mm"),"#;
const FIXED: &str = "motion: Fixed,";
const COPIES: &str = r#"motion: Free(density: 7800),
      position: (0, 0, "30 mm"),
      copies: Grid(counts: (3, 2, 1), spacing: ("10 mm", "11 mm", 0)),"#;
const ON_PLATE: &str = r#"OnSurface(surface: "plate", at: ("0 mm", "0 mm"), gap: "1 um")"#;
const AWAY: &str = "At(point: (0, 0, 0))";

/// Refuses copies of a ball with `changes`, by `message`.
fn copies_refused(test: &str, changes: &[(&str, &str)], message: &str) {
    let copied = [(STRIP, BALL), (FIXED, COPIES), (ON_PLATE, AWAY)];
    refused(test, &[&copied[..], changes].concat(), &[], &[], message);
}

#[test]
fn copies_of_no_number() {
    copies_refused(
        "copies_of_no_number",
        &[("(3, 2, 1)", "(3, 0, 1)")],
        r#"error: `surfaces.plate.copies.counts` is out of range
  --> scene.ron:16:28
   |
16 |       copies: Grid(counts: (3, 0, 1), spacing: ("10 mm", "11 mm", 0)),
   |                            ^^^^^^^^^ must be at least 1 along every axis

scene.ron: 1 problem, nothing was run
"#,
    );
}

/// Fails for a check that makes them before it counts them.
#[test]
fn copies_without_number() {
    copies_refused(
        "copies_without_number",
        &[("(3, 2, 1)", "(4000000000, 4000000000, 4000000000)")],
        r#"error: `surfaces.plate.copies.counts` is out of range
  --> scene.ron:16:28
   |
16 |       copies: Grid(counts: (4000000000, 4000000000, 4000000000), spacing: ("10 mm", "11 mm", 0)),
   |                            ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ must be at most 10000 together

scene.ron: 1 problem, nothing was run
"#,
    );
}

/// Fails for a check of the first two alone: these overlap along y.
#[test]
fn copies_inside_each_other() {
    copies_refused(
        "copies_inside_each_other",
        &[("\"11 mm\"", "\"9 mm\"")],
        r#"error: the copies `plate_1` and `plate_4` overlap
  --> scene.ron:16:48
   |
16 |       copies: Grid(counts: (3, 2, 1), spacing: ("10 mm", "9 mm", 0)),
   |                                                ^^^^^^^^^^^^^^^^^^^^ must keep them outside of each other

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn copies_of_what_is_not_free() {
    copies_refused(
        "copies_of_what_is_not_free",
        &[("motion: Free(density: 7800)", "motion: Kinematic()")],
        r#"error: the surface `plate` has copies, and is not free
  --> scene.ron:16:15
   |
14 |       motion: Kinematic(),
   |               --------- expected `Free(..)`
15 |       position: (0, 0, "30 mm"),
16 |       copies: Grid(counts: (3, 2, 1), spacing: ("10 mm", "11 mm", 0)),
   |               ^^^^ is for free surfaces

scene.ron: 1 problem, nothing was run
"#,
    );
}

/// Fails for a check of bodies against the first copy alone.
#[test]
fn a_body_inside_a_copy() {
    copies_refused(
        "a_body_inside_a_copy",
        &[(AWAY, r#"At(point: ("20 mm", "11 mm", "37 mm"))"#)],
        r#"error: the body `ball` starts 1.000e-3 m inside the surface `plate_6`
  --> scene.ron:24:27
   |
24 |       position: At(point: ("20 mm", "11 mm", "37 mm")),
   |                           ^^^^^^^^^^^^^^^^^^^^^^^^^^^ must lie outside of its solid

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_body_in_the_frame_of_many() {
    copies_refused(
        "a_body_in_the_frame_of_many",
        &[(AWAY, r#"InFrame(surface: "plate", point: (0, 0, 1))"#)],
        r#"error: `bodies.ball` cannot lie on the surface `plate`, which has copies
  --> scene.ron:24:34
   |
16 |       copies: Grid(counts: (3, 2, 1), spacing: ("10 mm", "11 mm", 0)),
   |               ---- makes many of it
...
24 |       position: InFrame(surface: "plate", point: (0, 0, 1)),
   |                                  ^^^^^^^ must name one surface

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn copies_with_the_name_of_a_body() {
    copies_refused(
        "copies_with_the_name_of_a_body",
        &[("\"ball\": (", "\"plate_5\": (")],
        r#"error: the surface `plate` has a copy `plate_5`, and so has the scene
 --> scene.ron:9:5
  |
9 |     "plate": (
  |     ^^^^^^^ rename the surface

scene.ron: 1 problem, nothing was run
"#,
    );
}

//! Surfaces that cannot move as they are told: the whole message.

use super::refused;

const FIXED: &str = "motion: Fixed,";
const LED: &str = "motion: Kinematic(velocity: (1, 0, 0)),";

#[test]
fn a_plate_that_is_free() {
    refused(
        "a_plate_that_is_free",
        &[(FIXED, "motion: Free(density: 7800.0),")],
        &[],
        &[],
        r#"error: the surface `plate` cannot be free: a plate has no mass
  --> scene.ron:14:15
   |
11 |       geometry: HexStrip(length: "30 mm", width: "12 mm", pitch: "0.15 mm"),
   |                 -------- bounds no solid
...
14 |       motion: Free(density: 7800.0),
   |               ^^^^ is for solids
   |
   = help: a `Cuboid(..)` is a plate with a mass

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_word_of_another_motion() {
    refused(
        "a_word_of_another_motion",
        &[(FIXED, "motion: Kinematic(speed: (1, 0, 0)),")],
        &[],
        &[],
        r#"error: unknown field `speed` in `surfaces.plate.motion`
  --> scene.ron:14:25
   |
14 |       motion: Kinematic(speed: (1, 0, 0)),
   |                         ^^^^^ expected `velocity` or `spin`

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_drive_over_a_plate_that_moves() {
    let impact = r#"Impact(speed: "35 m/s", angle: "45 deg")"#;
    refused(
        "a_drive_over_a_plate_that_moves",
        &[(FIXED, LED), (impact, "Drive(indent_to: 5)")],
        &[],
        &[],
        r#"error: `bodies.ball` cannot be driven over the surface `plate`, which moves
  --> scene.ron:24:15
   |
14 |       motion: Kinematic(velocity: (1, 0, 0)),
   |               --------- moves the surface
...
24 |       motion: Drive(indent_to: 5),
   |               ^^^^^ is for surfaces at rest

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_body_named_like_a_surface_that_moves() {
    refused(
        "a_body_named_like_a_surface_that_moves",
        &[(FIXED, LED), ("\"ball\": (", "\"plate\": (")],
        &[],
        &[],
        r#"error: a body and a surface that moves are both called `plate`
  --> scene.ron:14:15
   |
14 |       motion: Kinematic(velocity: (1, 0, 0)),
   |               ^^^^^^^^^ this surface moves
...
19 |     "plate": (
   |     ------- and so does this body
   |
   = help: rename one

scene.ron: 1 problem, nothing was run
"#,
    );
}

//! Words that a scene does not have, and forms that are not RON: the whole message.

use super::refused;

#[test]
fn a_misspelt_field() {
    refused(
        "a_misspelt_field",
        &[("hardness", "hardnes")],
        &[],
        &[],
        r#"error: unknown field `hardnes` in `materials.plate`
 --> scene.ron:6:15
  |
6 |     "plate": (hardnes: "6.6 GPa", shear_ratio: 0.25, young: "200 GPa", poisson: 0.3, friction: 0.5),
  |               ^^^^^^^ expected `hardness`, `shear_ratio`, `young`, `poisson` or `friction`
  |
  = help: did you mean `hardness`?

scene.ron: 1 problem, nothing was run
"#,
    );
}

/// Fails for a scene whose misspelt words are told one by one, and for a field that must be given and is called
/// missing after its misspelt name was told.
#[test]
fn misspelt_fields_are_told_together() {
    refused(
        "misspelt_fields_are_told_together",
        &[
            ("friction", "frction"),
            ("pitch:", "pich:"),
            ("removal: All,", "removal: All, // \u{b5}"),
            ("speed", "sped"),
        ],
        &[],
        &[],
        r#"error: unknown field `frction` in `materials.plate`
 --> scene.ron:6:87
  |
6 |     "plate": (hardness: "6.6 GPa", shear_ratio: 0.25, young: "200 GPa", poisson: 0.3, frction: 0.5),
  |                                                                                       ^^^^^^^ expected `hardness`, `shear_ratio`, `young`, `poisson` or `friction`
  |
  = help: did you mean `friction`?

error: unknown field `pich` in `surfaces.plate.geometry`
  --> scene.ron:11:59
   |
11 |       geometry: HexStrip(length: "30 mm", width: "12 mm", pich: "0.15 mm"),
   |                                                           ^^^^ expected `length`, `width`, `pitch`, `nodes` or `rest_area`
   |
   = help: did you mean `pitch`?

error: unknown field `sped` in `bodies.ball.motion`
  --> scene.ron:24:22
   |
24 |       motion: Impact(sped: "35 m/s", angle: "45 deg"),
   |                      ^^^^ expected `speed`, `angle`, `azimuth` or `spin`
   |
   = help: did you mean `speed`?

scene.ron: 3 problems, nothing was run
"#,
    );
}

/// Fails for a fault that is told a line above its own, or beside its place, because misspelt fields before it take
/// lines or bytes with them.
#[test]
fn a_fault_below_a_misspelt_field_keeps_its_place() {
    refused(
        "a_fault_below_a_misspelt_field_keeps_its_place",
        &[
            ("removal: All,", "remval: All,"),
            ("stop: AllRebounded", "stp: \"\u{b5}\u{b5}\", stop: AllRebounded(3)"),
        ],
        &[],
        &[],
        r#"error: unknown field `remval` in `surfaces.plate`
  --> scene.ron:15:7
   |
15 |       remval: All,
   |       ^^^^^^ expected `material`, `geometry`, `flow`, `elastic`, `hardness_map`, `regions`, `motion`, `removal`, `density`, `restitution`, `adhesion`, `archard`, `position`, `rotation` or `copies`
   |
   = help: did you mean `removal`?

error: unknown field `stp` in `run`
  --> scene.ron:28:9
   |
28 |   run: (stp: "µµ", stop: AllRebounded(3), resolve: Auto, accuracy: 1e-3),
   |         ^^^ expected `stop`, `resolve`, `accuracy` or `step`
   |
   = help: did you mean `stop`?

error: the scene is not RON
  --> scene.ron:28:38
   |
28 |   run: (stp: "µµ", stop: AllRebounded(3), resolve: Auto, accuracy: 1e-3),
   |                                      ^ expected comma
   |
   = help: this variant has no fields

scene.ron: 3 problems, nothing was run
"#,
    );
}

#[test]
fn an_unknown_variant() {
    refused(
        "an_unknown_variant",
        &[("Ball(radius", "Bal(radius")],
        &[],
        &[],
        r#"error: `bodies.ball.shape` cannot be `Bal`
  --> scene.ron:20:14
   |
20 |       shape: Bal(radius: "3 mm"),
   |              ^^^ expected `Ball`, `Cuboid`, `Polyhedron`, `ConvexHull`, `Clump` or `Grain`
   |
   = help: did you mean `Ball`?

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_wrong_unit() {
    refused(
        "a_wrong_unit",
        &[(r#""35 m/s""#, r#""35 mm""#)],
        &[],
        &[],
        r#"error: `bodies.ball.motion.speed`: `mm` does not measure a speed
  --> scene.ron:24:29
   |
24 |       motion: Impact(speed: "35 mm", angle: "45 deg"),
   |                             ^^^^^^^ expected a speed in m/s, cm/s, mm/s or km/h

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_unit_in_the_wrong_case() {
    refused(
        "a_unit_in_the_wrong_case",
        &[(r#""6.6 GPa""#, r#""6.6 Gpa""#)],
        &[],
        &[],
        r#"error: `materials.plate.hardness`: `Gpa` does not measure a hardness
 --> scene.ron:6:25
  |
6 |     "plate": (hardness: "6.6 Gpa", shear_ratio: 0.25, young: "200 GPa", poisson: 0.3, friction: 0.5),
  |                         ^^^^^^^^^ expected a hardness in Pa, kPa, MPa, GPa or HV
  |
  = help: did you mean `GPa`?

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_quoted_number_without_a_unit() {
    refused(
        "a_quoted_number_without_a_unit",
        &[(r#""45 deg""#, r#""45""#)],
        &[],
        &[],
        r#"error: `bodies.ball.motion.angle`: `45` has no unit
  --> scene.ron:24:46
   |
24 |       motion: Impact(speed: "35 m/s", angle: "45"),
   |                                              ^^^^ expected an angle in rad, deg or °

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_unit_without_quotes() {
    refused(
        "a_unit_without_quotes",
        &[(r#""45 deg""#, "45 deg")],
        &[],
        &[],
        r#"error: the scene is not RON
  --> scene.ron:24:49
   |
24 |       motion: Impact(speed: "35 m/s", angle: 45 deg),
   |                                                 ^ expected comma
   |
   = help: a number with a unit is quoted, as in "45 deg"

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_newer_version() {
    refused(
        "a_newer_version",
        &[("version: 1", "version: 2")],
        &[],
        &[],
        r#"error: the scene is of version 2, which is newer than this program
 --> scene.ron:2:12
  |
2 |   version: 2,
  |            ^ this program reads version 1

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_missing_field() {
    refused(
        "a_missing_field",
        &[("density: 2500.0,", "")],
        &[],
        &[],
        r#"error: nothing gives a mass to `bodies.ball`
  --> scene.ron:19:5
   |
19 |     "ball": (
   |     ^^^^^^ `density` must be given

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_variant_that_needs_parentheses() {
    refused(
        "a_variant_that_needs_parentheses",
        &[("Foundation()", "Foundation")],
        &[],
        &[],
        r#"error: `surfaces.plate.elastic` has the wrong form
  --> scene.ron:13:16
   |
13 |       elastic: Foundation,
   |                ^^^^^^^^^^ expected `Foundation(..)`
   |
   = help: `Foundation()` leaves every field at its default; one without a default must be given

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_variant_that_has_none() {
    refused(
        "a_variant_that_has_none",
        &[("motion: Fixed", "motion: Fixed()")],
        &[],
        &[],
        r#"error: the scene is not RON
  --> scene.ron:14:20
   |
14 |       motion: Fixed(),
   |                    ^ expected comma
   |
   = help: this variant has no fields and is written without parentheses

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn an_unclosed_scene() {
    refused(
        "an_unclosed_scene",
        &[("Report ],\n)", "Report ],\n")],
        &[],
        &[],
        r#"error: the scene is not RON
  --> scene.ron:29:81
   |
29 |   outputs: [ History(every: "1 us"), Surface(at: End), Picture, Energy, Report ],
   |                                                                                 ^ unexpected end of RON

scene.ron: 1 problem, nothing was run
"#,
    );
}

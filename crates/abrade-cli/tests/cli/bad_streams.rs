//! Streams that cannot be: the whole message.

use super::refused;

/// The stream of the scene, before it is spoilt.
const STREAM: &str = r#"streams: {
    "grit": (
      shape: Ball(radius: "1 mm"),
      density: 2650.0,
      count: 20,
      every: "1 ms",
      position: At(point: (0, 0, "30 mm")),
      motion: Free(velocity: (0, 0, "-20 m/s")),
      spread: "2 mm",
    ),
  },"#;

/// Refuses the stream with `changes`, by `message`.
fn stream_refused(test: &str, changes: &[(&str, &str)], message: &str) {
    let all = [&[("streams: {},", STREAM)][..], changes].concat();
    refused(test, &all, &[], &[], message);
}

#[test]
fn a_stream_of_no_bodies() {
    stream_refused(
        "a_stream_of_no_bodies",
        &[("count: 20", "count: 0"), (r#"every: "1 ms""#, "every: 0")],
        r#"error: `streams.grit.count` is out of range
  --> scene.ron:31:14
   |
31 |       count: 0,
   |              ^ must be between 1 and 100000

error: `streams.grit.every` is out of range
  --> scene.ron:32:14
   |
32 |       every: 0,
   |              ^ must be finite and above zero

scene.ron: 2 problems, nothing was run
"#,
    );
}

#[test]
fn a_stream_that_lies() {
    stream_refused(
        "a_stream_that_lies",
        &[(r#"Free(velocity: (0, 0, "-20 m/s"))"#, "Free()")],
        r#"error: `streams.grit` has no speed, so its bodies lie in one place
  --> scene.ron:34:15
   |
34 |       motion: Free(),
   |               ^^^^ must have a speed above zero

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_stream_that_is_driven() {
    stream_refused(
        "a_stream_that_is_driven",
        &[(r#"Free(velocity: (0, 0, "-20 m/s"))"#, "Drive(indent_to: 5)")],
        r#"error: `streams.grit` does not fly
  --> scene.ron:34:15
   |
34 |       motion: Drive(indent_to: 5),
   |               ^^^^^ expected `Free(..)` or `Impact(..)`

scene.ron: 1 problem, nothing was run
"#,
    );
}

/// Fails for a check that looks at the first body alone.
#[test]
fn a_stream_that_comes_through_the_plate() {
    stream_refused(
        "a_stream_that_comes_through_the_plate",
        &[(r#"(0, 0, "-20 m/s")"#, r#"(0, 0, "20 m/s")"#)],
        r#"error: the body `grit_03` starts 1.100e-2 m inside the surface `plate`
  --> scene.ron:33:27
   |
33 |       position: At(point: (0, 0, "30 mm")),
   |                           ^^^^^^^^^^^^^^^ must lie above the surface

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_stream_with_the_name_of_a_body() {
    stream_refused(
        "a_stream_with_the_name_of_a_body",
        &[("\"ball\": (", "\"grit_07\": (")],
        r#"error: the stream `streams.grit` has a body `grit_07`, and so has the scene
  --> scene.ron:28:5
   |
28 |     "grit": (
   |     ^^^^^^ rename the stream

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_word_that_streams_have_not() {
    stream_refused(
        "a_word_that_streams_have_not",
        &[("position: At", "at: At")],
        r#"error: unknown field `at` in `streams.grit`
  --> scene.ron:33:7
   |
33 |       at: At(point: (0, 0, "30 mm")),
   |       ^^ expected `shape`, `density`, `count`, `every`, `position`, `motion`, `spread` or `seed`

scene.ron: 1 problem, nothing was run
"#,
    );
}

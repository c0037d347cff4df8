//! Streams that cannot be: the whole message.

use super::{Folder, SCENE, refused};

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

/// What is said of the scene with `changes`.
fn said(test: &str, changes: &[(&str, &str)]) -> String {
    let mut text = SCENE.to_owned();
    for (old, new) in changes {
        assert!(text.contains(old), "{old}");
        text = text.replacen(old, new, 1);
    }
    let folder = Folder::new(test);
    folder.write("scene.ron", &text);
    folder.abrade(&["check", "scene.ron"]).err
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

/// Fails for a check that looks at the first body alone, or at bodies before they have their size.
#[test]
fn a_stream_of_which_a_body_starts_in_the_plate() {
    let changes = [
        (r#"(0, 0, "30 mm")"#, r#"(0, 0, "3.2 mm")"#),
        (r#"spread: "2 mm","#, r#"sizes: Uniform(from: "1 mm", to: "7 mm"),"#),
    ];
    let all = [&[("streams: {},", STREAM)][..], &changes].concat();
    let said = said("a_stream_of_which_a_body_starts_in_the_plate", &all);
    assert!(said.contains("m inside the surface `plate`"), "{said}");
    assert!(!said.contains("`grit_01`"), "{said}");
}

/// Fails for two ways at once to say when bodies come, or none.
#[test]
fn a_stream_that_comes_twice_or_never() {
    for every in ["", r#"every: "1 ms", rate: "1 kHz","#] {
        let all = [("streams: {},", STREAM), (r#"every: "1 ms","#, every)];
        let said = said("a_stream_that_comes_twice_or_never", &all);
        assert!(said.contains("give one of `every`, `rate` and `mass_rate`"), "{said}");
    }
}

/// Fails for cut-offs that no draw can meet: the run would wait for one for ever.
#[test]
fn sizes_that_nothing_has() {
    for (sizes, message) in [
        (r#"Normal(mean: "5 mm", deviation: "1 mm", from: "1 mm", to: "2 mm")"#, "sizes.mean"),
        (r#"LogNormal(median: "1 mm", deviation: 1e300, from: "1 mm", to: "2 mm")"#, "deviation"),
        (r#"Uniform(from: "3 mm", to: "2 mm")"#, "sizes.to"),
        ("Sieves(fractions: [])", "holds no mass"),
    ] {
        let with = format!("sizes: {sizes},");
        let all = [("streams: {},", STREAM), (r#"spread: "2 mm","#, with.as_str())];
        let said = said("sizes_that_nothing_has", &all);
        assert!(said.contains(message), "{sizes}: {said}");
    }
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
   |       ^^ expected `shape`, `shapes`, `shares`, `sizes`, `density`, `count`, `every`, `rate`, `mass_rate`, `position`, `motion`, `spread`, `divergence` or `seed`
   |
   = help: did you mean `rate`?

scene.ron: 1 problem, nothing was run
"#,
    );
}

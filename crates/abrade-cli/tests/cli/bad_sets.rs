//! `--set` arguments that do not fit, and output folders: the whole message.

use super::{Folder, refused};

#[test]
fn an_unknown_set_path() {
    refused(
        "an_unknown_set_path",
        &[],
        &[],
        &["bodies.ball.motion.sped=30 m/s"],
        r#"error: unknown field `sped` in `bodies.ball.motion`
 --> --set:1:20
  |
1 | bodies.ball.motion.sped=30 m/s
  |                    ^^^^ expected `speed`, `angle`, `azimuth` or `spin`
  |
  = help: did you mean `speed`?

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_set_path_through_an_unknown_name() {
    refused(
        "a_set_path_through_an_unknown_name",
        &[],
        &[],
        &["bodies.bal.motion.speed=30 m/s"],
        r#"error: the path `bodies.bal.motion.speed` leads nowhere: no `bal` in `bodies`
 --> --set:1:8
  |
1 | bodies.bal.motion.speed=30 m/s
  |        ^^^ expected `ball`
  |
  = help: did you mean `ball`?

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_set_value_with_a_wrong_unit() {
    refused(
        "a_set_value_with_a_wrong_unit",
        &[],
        &[],
        &["bodies.ball.motion.speed=30 deg"],
        r#"error: `bodies.ball.motion.speed`: `deg` does not measure a speed
 --> --set:1:26
  |
1 | bodies.ball.motion.speed=30 deg
  |                          ^^^^^^ expected a speed in m/s, cm/s, mm/s or km/h

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_set_value_out_of_range() {
    refused(
        "a_set_value_out_of_range",
        &[],
        &[],
        &["bodies.ball.position.gap=-1 mm", "run.accuracy=-1"],
        r#"error: the body `ball` starts 1.000e-3 m inside the surface `plate`
 --> --set:1:26
  |
1 | bodies.ball.position.gap=-1 mm
  |                          ^^^^^ must lie above the surface

error: `run.accuracy` is out of range
 --> --set:1:14
  |
1 | run.accuracy=-1
  |              ^^ must be between 0.000001 and 0.5

scene.ron: 2 problems, nothing was run
"#,
    );
}

#[test]
fn a_set_argument_without_a_value() {
    refused(
        "a_set_argument_without_a_value",
        &[],
        &[],
        &["bodies.ball.motion.speed"],
        r#"error: `--set` takes PATH=VALUE
 --> --set:1:1
  |
1 | bodies.ball.motion.speed
  | ^^^^^^^^^^^^^^^^^^^^^^^^ expected a `=`

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_set_value_that_is_not_ron() {
    refused(
        "a_set_value_that_is_not_ron",
        &[],
        &[],
        &["bodies.ball.motion.speed=(3"],
        r#"error: the value that `--set` gives for `bodies.ball.motion.speed` is not RON
 --> --set:1:26
  |
1 | bodies.ball.motion.speed=(3
  |                          ^^ expected a value, such as 1.5, "2 mm" or (1.0, 0.0, 0.0)

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn an_unwritable_output_folder() {
    let folder = Folder::new("an_unwritable_output_folder");
    let said = folder.abrade(&["run", "scene.ron", "--out", "scene.ron/results"]);
    assert_eq!(
        said.err,
        "error: the output folder `scene.ron/results` cannot be written to: Not a directory (os error 20)\n"
    );
    assert_eq!(said.code, Some(2));
    assert_eq!(folder.files(), ["scene.ron"]);
}

/// Fails for a file that is told as missing without the folder that was looked in, and for names that are alike by
/// their endings alone or are the one that was given.
#[test]
fn a_scene_that_is_not_there() {
    let folder = Folder::new("a_scene_that_is_not_there");
    folder.write("scent.ron", "");
    // Its name is there, what it leads to is not.
    #[cfg(unix)]
    std::os::unix::fs::symlink("nowhere.ron", folder.0.join("lost.ron")).unwrap();
    let here = folder.0.display();
    for (name, why) in [
        ("x.ron", format!("there is no `x.ron` in `{here}`")),
        (
            "scena.ron",
            format!(
                "there is no `scena.ron` in `{here}`; did you mean `scene.ron` or `scent.ron`?"
            ),
        ),
        ("none/x.ron", format!("there is no folder `{here}/none`")),
        ("lost.ron", format!("there is no `lost.ron` in `{here}`")),
    ] {
        let said = folder.abrade(&["run", name]);
        let message = format!(
            "error: the scene cannot be read: {why}\n --> {name}\n\n{name}: 1 problem, nothing was run\n"
        );
        assert_eq!((said.code, said.err), (Some(2), message));
    }
}

//! The `abrade` command as its users see it.

mod adhesive;
mod bad_copies;
mod bad_hardness;
mod bad_motions;
mod bad_paths;
mod bad_sets;
mod bad_solids;
mod bad_streams;
mod bad_values;
mod bad_words;
mod commands;
mod earlier;
mod laws;
mod laws_beside;
mod notes;
mod studies;
mod views;

use std::path::{Path, PathBuf};
use std::process::Command;

/// The scene that the tests change.
const SCENE: &str = include_str!("impact.ron");

/// A folder of a test's own, with the scene in it as `scene.ron`.
struct Folder(PathBuf);

/// What a command said.
struct Said {
    code: Option<i32>,
    out: String,
    err: String,
}

impl Folder {
    fn new(test: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
        if path.exists() {
            std::fs::remove_dir_all(&path).unwrap();
        }
        std::fs::create_dir_all(&path).unwrap();
        let folder = Self(path);
        folder.write("scene.ron", SCENE);
        folder
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.0.join(name), text).unwrap();
    }

    fn files(&self) -> Vec<String> {
        let entries = std::fs::read_dir(&self.0).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    fn abrade(&self, arguments: &[&str]) -> Said {
        let mut command = Command::new(env!("CARGO_BIN_EXE_abrade"));
        let output = command.current_dir(&self.0).args(arguments).output().unwrap();
        Said {
            code: output.status.code(),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        }
    }
}

/// Checks and runs the scene with `changes` (old, new), beside `files` (name, text), with `sets`: it
/// must be refused with `message`, in which `{here}` is the folder, and exit code 2, and nothing left behind.
fn refused(
    test: &str,
    changes: &[(&str, &str)],
    files: &[(&str, &str)],
    sets: &[&str],
    message: &str,
) {
    let folder = Folder::new(test);
    let mut text = SCENE.to_owned();
    for (old, new) in changes {
        assert!(text.contains(old), "{old}");
        text = text.replacen(old, new, 1);
    }
    folder.write("scene.ron", &text);
    for (name, text) in files {
        folder.write(name, text);
    }
    let before = folder.files();
    let message = message.replace("{here}", &folder.0.display().to_string());
    for command in ["check", "run"] {
        let mut arguments = vec![command, "scene.ron"];
        sets.iter().for_each(|set| arguments.extend(["--set", set]));
        let said = folder.abrade(&arguments);
        assert_eq!(said.err, message, "\n{}", said.err);
        assert_eq!((said.code, said.out.as_str()), (Some(2), ""));
    }
    assert_eq!(folder.files(), before);
}

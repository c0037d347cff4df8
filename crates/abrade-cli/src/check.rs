//! `abrade check`: whether files are as the commands that read them want them, and how large they are.

use std::path::Path;

use anyhow::anyhow;

use crate::arguments::CheckArguments;
use crate::failure::Failure;
use crate::kind::{self, Read};
use crate::say::say;
use crate::{adhesive_text, scene_text, study_text};

/// Checks every file; tells the sound ones on the output and the others where errors go.
pub(crate) fn check(arguments: &CheckArguments) -> Result<(), Failure> {
    let CheckArguments { files, sets } = arguments;
    if let [path] = files.as_slice() {
        return match kind::any(path, sets)? {
            Read::Scene(checked) => say(&scene_text::rows(&checked)),
            Read::Erosion(file) => say(&study_text::rows(&file)),
            Read::Asperities(file) => say(&adhesive_text::rows(&file)),
            Read::Map(file) => say(&adhesive_text::rows_of_map(&file)),
        };
    }
    let mut bad = 0;
    for path in files {
        match kind::any(path, sets) {
            Ok(read) => say(&line(path, &read))?,
            Err(failure) => {
                failure.print();
                bad += 1;
            }
        }
    }
    match bad {
        0 => Ok(()),
        _ => Err(Failure::Input(anyhow!("{bad} of {} files cannot be used", files.len()))),
    }
}

fn line(path: &Path, read: &Read) -> String {
    let (name, text) = match read {
        Read::Scene(checked) => (&checked.scene.name, scene_text::line(checked)),
        Read::Erosion(file) => (&file.name, study_text::line(file)),
        Read::Asperities(file) => (&file.name, adhesive_text::line(file)),
        Read::Map(file) => (&file.name, adhesive_text::line_of_map(file)),
    };
    format!("{}: {name}: {text}\n", path.display())
}

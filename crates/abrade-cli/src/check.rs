//! `abrade check`: whether files are as the commands that read them want them, and how large they are.

use std::path::Path;

use abrade_report::quantity_text::count;
use abrade_study::adhesive;
use anyhow::anyhow;

use crate::arguments::CheckArguments;
use crate::failure::Failure;
use crate::kind::{self, Read};
use crate::say::say;
use crate::study::failure;
use crate::{scene_text, study_text};

/// Checks every file; tells the sound ones on the output and the others where errors go.
pub(crate) fn check(arguments: &CheckArguments) -> Result<(), Failure> {
    let CheckArguments { files, sets } = arguments;
    if let [path] = files.as_slice() {
        return match kind::any(path, sets)? {
            Read::Scene(checked) => say(&scene_text::rows(&checked)),
            Read::Erosion(file) => say(&study_text::rows(&file)),
            read => say(&line(path, &read)?),
        };
    }
    let mut bad = 0;
    for path in files {
        match kind::any(path, sets).and_then(|read| line(path, &read)) {
            Ok(line) => say(&line)?,
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

fn line(path: &Path, read: &Read) -> Result<String, Failure> {
    let (name, text) = match read {
        Read::Scene(checked) => (&checked.scene.name, scene_text::line(checked)),
        Read::Erosion(file) => (&file.name, study_text::line(file)),
        Read::Asperities(file) => {
            let elements = adhesive::element_count(file).map_err(failure)?;
            let elements = count(elements, "element", "elements");
            (&file.name, format!("two asperities, {elements}"))
        }
        Read::Map(file) => {
            let cases = count(file.cases().len(), "case", "cases");
            (&file.name, format!("map of two asperities, {cases}"))
        }
    };
    Ok(format!("{}: {name}: {text}\n", path.display()))
}

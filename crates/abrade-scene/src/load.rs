//! From a scene file and its `--set` arguments to a checked scene, or every problem in it.

use std::path::{Path, PathBuf};

use crate::check::{self, Checked};
use crate::document::{self, Document, FileKind};
use crate::problem::SceneError;
use crate::scene::{Scene, VERSION};

const SCENE: FileKind = FileKind { name: "scene", version: VERSION };

/// Reads the scene file at `path`, applies the `sets` (`PATH=VALUE`) in order, and checks it.
/// Files that the scene names are looked for beside it.
///
/// # Errors
/// Everything that is wrong with it, as far as it can be seen at once.
pub fn load(path: &Path, sets: &[String]) -> Result<Checked, SceneError> {
    let folder = path.parent().map(Path::to_owned).unwrap_or_default();
    check(Document::load(path, sets, SCENE)?, folder)
}

/// [`load`] for a scene's text; `name` serves messages, `folder` is where its files lie.
///
/// # Errors
/// Everything that is wrong with it, as far as it can be seen at once.
pub fn load_text(
    name: &str,
    text: String,
    folder: PathBuf,
    sets: &[String],
) -> Result<Checked, SceneError> {
    check(Document::read(name, text, sets, SCENE)?, folder)
}

fn check(document: Document<Scene>, folder: PathBuf) -> Result<Checked, SceneError> {
    let (scene, mut patched, tree, mut problems) = document.into_parts();
    match check::check(scene, folder, &mut patched, &tree) {
        Ok(checked) if problems.is_empty() => Ok(checked),
        Ok(_) => Err(document::refused(patched, problems)),
        Err(found) => {
            problems.extend(found);
            Err(document::refused(patched, problems))
        }
    }
}

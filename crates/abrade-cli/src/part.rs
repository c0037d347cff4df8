//! Files that are no scene, but part of one: meshes and clumps.

use std::path::Path;

use abrade_report::quantity_text::count;
use abrade_scene::clump;

/// What the file or the folder at `path` is, and where a scene names it; none for anything else.
pub(crate) fn told(path: &Path) -> Option<String> {
    let (place, end) = (path.display(), path.extension().unwrap_or_default());
    let file = path.file_name()?.to_string_lossy();
    let is = |known: &str| end.eq_ignore_ascii_case(known);
    // What is no file can be read once, and was.
    if is("ron") || !(path.is_file() || path.is_dir()) {
        return None;
    }
    if is("stl") || is("obj") {
        return Some(format!(
            "{place} is a mesh: a scene takes it as a surface with `geometry: Mesh(file: \"{file}\")`, and its \
             hull as a body with `shape: ConvexHull(file: \"{file}\")`"
        ));
    }
    let clump = clump::read(path).ok()?;
    let spheres = count(clump.spheres.len(), "sphere", "spheres");
    Some(format!(
        "{place} is no scene: its numbers are those of a clump of {spheres}, which a scene takes as a body with \
         `shape: Clump(file: \"{file}\")` and `abrade clump` looks over"
    ))
}

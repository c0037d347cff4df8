//! The files of the repository. Links to folders are not followed: what they lead to is read
//! where it lies. Build and run folders and hidden ones are left out.

use std::fs;
use std::path::{Path, PathBuf};

const LEFT_OUT: [&str; 2] = ["target", "runs"];

/// A file: its path from the root of the repository, with `/` between the parts.
#[derive(Clone, Debug)]
pub struct File {
    pub name: String,
    pub text: String,
}

/// The root of the repository.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The files under `folder` whose names end in `ending`, by name.
pub fn files(folder: &str, ending: &str) -> Vec<File> {
    let mut paths = Vec::new();
    collect(&root().join(folder), &mut paths);
    paths.sort();
    let names = paths.iter().map(|path| name(path));
    names.filter(|name| name.ends_with(ending)).map(|name| read(&name)).collect()
}

/// The names of everything under `folder`, whatever it is.
pub fn names(folder: &str) -> Vec<String> {
    let mut paths = Vec::new();
    collect(&root().join(folder), &mut paths);
    paths.sort();
    paths.iter().map(|path| name(path)).collect()
}

/// One file, which must be there.
pub fn read(name: &str) -> File {
    let text = fs::read_to_string(root().join(name))
        .unwrap_or_else(|error| panic!("{name} cannot be read: {error}"));
    File { name: name.into(), text }
}

fn name(path: &Path) -> String {
    let inside = path.strip_prefix(root()).expect("a path below the root");
    let parts: Vec<_> = inside.iter().map(|part| part.to_string_lossy()).collect();
    parts.join("/")
}

fn collect(folder: &Path, paths: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let (path, kind) = (entry.path(), entry.file_type().expect("the kind of a file"));
        let name = entry.file_name().to_string_lossy().into_owned();
        if name.starts_with('.') || kind.is_symlink() {
            continue;
        }
        if kind.is_file() {
            paths.push(path);
        } else if kind.is_dir() && !LEFT_OUT.contains(&name.as_str()) {
            collect(&path, paths);
        }
    }
}

mod tests {
    use super::*;

    /// Fails for a walk that finds nothing, or that goes through the link of the f64 package.
    #[test]
    fn the_walk_reads_every_source_once() {
        let names: Vec<_> = files("crates", ".rs").into_iter().map(|file| file.name).collect();
        assert!(names.contains(&"crates/abrade/src/lib.rs".to_owned()));
        assert!(names.contains(&"crates/abrade-rapier3d/src/scalar.rs".to_owned()));
        assert!(!names.iter().any(|name| name.starts_with("crates/abrade-rapier3d-f64/src/")));
    }
}

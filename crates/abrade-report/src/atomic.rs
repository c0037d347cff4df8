//! Files that are whole or not there: written under a temporary name in the same folder, then
//! renamed. A rename within a folder is one act of the file system; across folders it may not be.

use std::collections::hash_map::RandomState;
use std::fs::{self, File};
use std::hash::{BuildHasher as _, Hasher as _};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::error::{FileAction, ReportError};

/// Writes `bytes` to `path`; whatever was there is replaced only by the whole.
///
/// # Errors
/// The file system refuses; then nothing is left of the attempt.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), ReportError> {
    let mut file = PartialFile::create(path)?;
    match file.write_all(bytes) {
        Ok(()) => file.finish(),
        Err(source) => {
            file.discard();
            Err(ReportError::File { action: FileAction::Write, path: path.to_owned(), source })
        }
    }
}

/// A name that no other process has, on this machine or on another one that writes to the same folder.
pub fn process_name() -> &'static str {
    static NAME: OnceLock<String> = OnceLock::new();
    // Each process has random keys.
    let random = || RandomState::new().build_hasher().finish();
    NAME.get_or_init(|| format!("{}-{:016x}", process::id(), random()))
}

/// A file that grows under a temporary name, `<name>.<process>-<count>.partial`, until
/// [`PartialFile::finish`]. Dropped unfinished it stays under that name, so that what a broken run
/// wrote can still be read.
#[derive(Debug)]
pub struct PartialFile {
    file: BufWriter<File>,
    partial: PathBuf,
    path: PathBuf,
}

/// Two writers of the same file must not share a temporary name.
static COUNT: AtomicU64 = AtomicU64::new(0);

impl PartialFile {
    /// Opens a temporary file beside `path`.
    ///
    /// # Errors
    /// `path` has no file name, or its folder cannot be written to.
    pub fn create(path: &Path) -> Result<Self, ReportError> {
        let no_name = || ReportError::NoFileName { path: path.to_owned() };
        let mut name = path.file_name().ok_or_else(no_name)?.to_owned();
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        name.push(format!(".{}-{count}.partial", process_name()));
        let partial = path.with_file_name(name);
        let file =
            File::create(&partial).map_err(ReportError::file(FileAction::Create, &partial))?;
        Ok(Self { file: BufWriter::new(file), partial, path: path.to_owned() })
    }

    /// The final name.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Brings everything to the disk and gives the file its final name.
    ///
    /// # Errors
    /// The disk is full, or the rename is refused; then nothing is left of the attempt.
    pub fn finish(mut self) -> Result<(), ReportError> {
        let done = self
            .file
            .flush()
            .and_then(|()| self.file.get_ref().sync_all())
            .map_err(ReportError::file(FileAction::Write, &self.path))
            .and_then(|()| {
                fs::rename(&self.partial, &self.path)
                    .map_err(ReportError::file(FileAction::Rename, &self.path))
            });
        if done.is_err() {
            self.discard();
        }
        done
    }

    /// Removes the temporary file. A failure to do so is not reported: the error that led here is.
    fn discard(self) {
        let _ = fs::remove_file(&self.partial);
    }
}

impl Write for PartialFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).expect("the folder exists");
        entries.map(|e| e.expect("readable").file_name().to_string_lossy().into_owned()).collect()
    }

    /// A program that opened the final name at once would show the half file.
    #[test]
    fn the_old_file_stays_until_the_new_one_is_whole() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("summary.json");
        write(&path, b"old").expect("writable");
        let mut file = PartialFile::create(&path).expect("writable");
        file.write_all(b"new, half").expect("writable");
        file.flush().expect("writable");
        assert_eq!(fs::read(&path).expect("there"), b"old");
        file.finish().expect("renamed");
        assert_eq!(fs::read(&path).expect("there"), b"new, half");
        assert_eq!(names(folder.path()), ["summary.json"]);
    }

    /// A program that forgot to clean up would leave the temporary file behind; one that wrapped
    /// the error loosely would not name the file.
    #[test]
    fn a_refused_rename_names_the_file_and_leaves_nothing() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("taken");
        fs::create_dir(&path).expect("writable");
        let error = write(&path, b"x").expect_err("a folder is in the way");
        assert!(matches!(&error, ReportError::File { action: FileAction::Rename, .. }));
        assert!(error.to_string().contains("taken"), "{error}");
        assert_eq!(names(folder.path()), ["taken"]);
    }

    /// A program that created missing folders in silence would hide a mistyped path.
    #[test]
    fn a_missing_folder_is_an_error() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let error = write(&folder.path().join("no/such/file"), b"x").expect_err("no folder");
        assert!(matches!(error, ReportError::File { action: FileAction::Create, .. }));
    }
}

//! `.pvd`: ParaView's list of the files of a time series.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use crate::atomic;
use crate::error::{FileAction, ReportError};

/// A time series `<stem>_0000.vtp`, `<stem>_0001.vtp`.. and its list `<stem>.pvd`, in one folder.
///
/// ```
/// use std::path::Path;
/// let mut series = abrade_report::Series::new(Path::new("runs/ball"), "surface");
/// let path = series.next_path();
/// assert_eq!(path, Path::new("runs/ball/surface_0000.vtp"));
/// // write the file, then:
/// series.push(0.0);
/// assert_eq!(series.next_path(), Path::new("runs/ball/surface_0001.vtp"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    folder: PathBuf,
    stem: String,
    times: Vec<f64>,
}

impl Series {
    /// An empty series in `folder`.
    pub fn new(folder: &Path, stem: &str) -> Self {
        Self { folder: folder.to_owned(), stem: stem.to_owned(), times: Vec::new() }
    }

    /// Where the next file belongs.
    pub fn next_path(&self) -> PathBuf {
        self.folder.join(self.file_name(self.times.len()))
    }

    /// Tells that the next file is written, and shows the instant `time` [s].
    pub fn push(&mut self, time: f64) {
        self.times.push(time);
    }

    /// Writes the list of all files pushed so far, in place of an earlier list.
    ///
    /// # Errors
    /// The file system refuses.
    pub fn write(&self) -> Result<(), ReportError> {
        atomic::write(&self.folder.join(format!("{}.pvd", self.stem)), self.text().as_bytes())
    }

    /// The instants [s] and files of the list at `path`, in its order.
    ///
    /// # Errors
    /// The file system refuses, or the list is not as [`Series::write`] leaves it.
    pub fn read(path: &Path) -> Result<Vec<(f64, PathBuf)>, ReportError> {
        let text = fs::read_to_string(path).map_err(ReportError::file(FileAction::Read, path))?;
        let entry = |element: &str| {
            let value = |name: &str| element.split_once(name)?.1.split('"').next();
            let time = value("timestep=\"")?.parse().ok().filter(|time: &f64| time.is_finite())?;
            Some((time, path.with_file_name(unescape(value("file=\"")?))))
        };
        let entries = text.split("<DataSet ").skip(1).map(entry).collect::<Option<_>>();
        let missing = || ReportError::Damaged { path: path.into(), missing: "<DataSet".into() };
        entries.ok_or_else(missing)
    }

    fn file_name(&self, number: usize) -> String {
        format!("{}_{number:04}.vtp", self.stem)
    }

    fn text(&self) -> String {
        let mut text = String::from(
            "<?xml version=\"1.0\"?>\n\
             <VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n\
             <Collection>\n",
        );
        for (number, time) in self.times.iter().enumerate() {
            let file = escape(&self.file_name(number));
            let line =
                writeln!(text, "<DataSet timestep=\"{time:e}\" part=\"0\" file=\"{file}\"/>");
            line.expect("a string takes every text");
        }
        text.push_str("</Collection>\n</VTKFile>\n");
        text
    }
}

/// The text that [`escape`] made safe.
fn unescape(text: &str) -> String {
    let marks = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&#39;", "'"), ("&amp;", "&")];
    marks.iter().fold(text.to_owned(), |text, (escaped, mark)| text.replace(escaped, mark))
}

/// Text as it may stand inside an element or a quoted attribute of XML and HTML.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            other => out.push(other),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A program that rounded times to print them, or numbered from one, would let ParaView show
    /// another instant than the one written.
    #[test]
    fn a_list_names_its_files_with_their_times() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let mut series = Series::new(folder.path(), "surface");
        series.push(0.0);
        series.push(1.25e-6);
        series.write().expect("writable");
        let text = fs::read_to_string(folder.path().join("surface.pvd")).expect("there");
        let first = text.find("timestep=\"0e0\" part=\"0\" file=\"surface_0000.vtp\"");
        let second = text.find("timestep=\"1.25e-6\" part=\"0\" file=\"surface_0001.vtp\"");
        assert!(first.expect("the first file") < second.expect("the second file"), "{text}");
    }

    /// A reader that left the marks of XML in names would look for files that are not there; one that
    /// skipped an entry it cannot read would shift all later ones.
    #[test]
    fn a_list_reads_back_with_its_folder() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let mut series = Series::new(folder.path(), "surface_a&amp<b>");
        let (first, time) = (series.next_path(), 0.1 + 0.2);
        series.push(0.0);
        let second = series.next_path();
        series.push(time);
        series.write().expect("writable");
        let path = folder.path().join("surface_a&amp<b>.pvd");
        let read = Series::read(&path).expect("readable");
        assert_eq!(read, [(0.0, first), (time, second)]);
        let text = fs::read_to_string(&path).expect("there").replace("0e0", "soon");
        fs::write(&path, text).expect("writable");
        assert!(matches!(Series::read(&path), Err(ReportError::Damaged { .. })));
    }

    /// A program that pasted names as they are would break the page, or let a scene's name run.
    #[test]
    fn marks_of_the_language_are_escaped() {
        assert_eq!(escape("<a b=\"c\">&'"), "&lt;a b=&quot;c&quot;&gt;&amp;&#39;");
    }
}

//! Heights of a ground from a CSV file: numbers in lines, separated by commas, semicolons, tabs or
//! blanks; what follows a `#` is a comment.

use std::path::Path;

use thiserror::Error;

/// A file of heights that cannot be used.
#[derive(Clone, Debug, PartialEq, Error)]
pub(crate) enum HeightsTrouble {
    /// It cannot be read.
    #[error("the heights `{file}` cannot be read: {reason}")]
    Unreadable { file: String, reason: String },
    /// A word is not a finite number.
    #[error("`{word}` is not a finite number")]
    NotANumber { word: String, line: Line },
}

/// A line of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Line {
    /// The file, with its folder.
    pub(crate) file: String,
    /// From 1.
    pub(crate) number: usize,
    pub(crate) text: String,
}

/// Rows of heights, and the lines they stand in.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Heights {
    pub(crate) rows: Vec<Vec<f64>>,
    pub(crate) lines: Vec<Line>,
}

/// Reads `file`, which lies in `folder`; heights are multiplied by `scale`.
pub(crate) fn read(folder: &Path, file: &str, scale: f64) -> Result<Heights, HeightsTrouble> {
    let bytes = std::fs::read(folder.join(file)).map_err(|error| {
        let reason = error.kind().to_string();
        HeightsTrouble::Unreadable { file: file.to_owned(), reason }
    })?;
    let path = folder.join(file).display().to_string();
    parse(&path, &String::from_utf8_lossy(&bytes), scale)
}

fn parse(file: &str, text: &str, scale: f64) -> Result<Heights, HeightsTrouble> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut heights = Heights::default();
    for (i, whole) in text.lines().enumerate() {
        let text = whole.trim_end().to_owned();
        let line = Line { file: file.to_owned(), number: i + 1, text };
        let said = whole.split('#').next().unwrap_or_default();
        let separator = |c: char| c.is_whitespace() || matches!(c, ',' | ';');
        let words = said.split(separator).filter(|word| !word.is_empty());
        let mut row = Vec::new();
        for word in words {
            match word.parse::<f64>() {
                Ok(height) if height.is_finite() => row.push(height * scale),
                _ => return Err(HeightsTrouble::NotANumber { word: word.to_owned(), line }),
            }
        }
        if !row.is_empty() {
            heights.rows.push(row);
            heights.lines.push(line);
        }
    }
    Ok(heights)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a reader that counts rows instead of lines, or reads a comment.
    #[test]
    fn rows_know_their_lines() {
        let heights =
            parse("a.csv", "# two rows\n1, 2;3\n\n4\t5 6 # last\n", 0.5).expect("heights");
        assert_eq!(heights.rows, [[0.5, 1.0, 1.5], [2.0, 2.5, 3.0]]);
        assert_eq!(heights.lines.iter().map(|line| line.number).collect::<Vec<_>>(), [2, 4]);
        let error = parse("a.csv", "1 2\n3 x\n", 1.0).expect_err("no number");
        let line = Line { file: "a.csv".into(), number: 2, text: "3 x".into() };
        assert_eq!(error, HeightsTrouble::NotANumber { word: "x".into(), line });
    }
}

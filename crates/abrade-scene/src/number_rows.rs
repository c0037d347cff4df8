//! Rows of numbers from a CSV file: heights of a ground, hardnesses of places. Numbers in a line are
//! separated by commas, semicolons, tabs or blanks; what follows a `#` is a comment.

use std::path::Path;

use abrade_report::quantity_text::count;
use thiserror::Error;

use crate::unread::unread;

/// A file of rows that cannot be used.
#[derive(Clone, Debug, PartialEq, Error)]
pub(crate) enum RowsTrouble {
    /// It cannot be read.
    #[error("the {what} `{file}` cannot be read: {reason}")]
    Unreadable { what: &'static str, file: String, reason: String },
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

/// Rows of numbers, and the lines they stand in.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Rows {
    pub(crate) rows: Vec<Vec<f64>>,
    pub(crate) lines: Vec<Line>,
}

/// Reads `file`, which holds `what` and lies in `folder`.
pub(crate) fn read(folder: &Path, what: &'static str, file: &str) -> Result<Rows, RowsTrouble> {
    let path = folder.join(file);
    let bytes = std::fs::read(&path).map_err(|error| {
        let reason = unread(&path, &error);
        RowsTrouble::Unreadable { what, file: file.to_owned(), reason }
    })?;
    parse(&path.display().to_string(), &String::from_utf8_lossy(&bytes))
}

/// Two numbers of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberPair {
    /// The numbers.
    pub numbers: [f64; 2],
    /// Line and file, in words.
    pub place: String,
}

/// Pairs of numbers from `file`, which holds `what` and lies in `folder`: for files of other rooms.
///
/// # Errors
/// What is wrong with it, in words, with line and file: it cannot be read, or a line is not two finite numbers.
pub fn number_pairs(
    folder: &Path,
    what: &'static str,
    file: &str,
) -> Result<Vec<NumberPair>, String> {
    let rows = read(folder, what, file).map_err(|trouble| match &trouble {
        RowsTrouble::NotANumber { line, .. } => format!("{}: {trouble}", line.place()),
        RowsTrouble::Unreadable { .. } => trouble.to_string(),
    });
    pairs(&rows?)
}

impl Line {
    fn place(&self) -> String {
        format!("line {} of `{}`", self.number, self.file)
    }
}

fn pairs(found: &Rows) -> Result<Vec<NumberPair>, String> {
    let pair = |(row, line): (&Vec<f64>, &Line)| match row[..] {
        [x, y] => Ok(NumberPair { numbers: [x, y], place: line.place() }),
        _ => {
            let numbers = count(row.len(), "number", "numbers");
            Err(format!("{} has {numbers}, not 2", line.place()))
        }
    };
    found.rows.iter().zip(&found.lines).map(pair).collect()
}

fn parse(file: &str, text: &str) -> Result<Rows, RowsTrouble> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut rows = Rows::default();
    for (i, whole) in text.lines().enumerate() {
        let text = whole.trim_end().to_owned();
        let line = Line { file: file.to_owned(), number: i + 1, text };
        let said = whole.split('#').next().unwrap_or_default();
        let separator = |c: char| c.is_whitespace() || matches!(c, ',' | ';');
        let words = said.split(separator).filter(|word| !word.is_empty());
        let mut row = Vec::new();
        for word in words {
            match word.parse::<f64>() {
                Ok(number) if number.is_finite() => row.push(number),
                _ => return Err(RowsTrouble::NotANumber { word: word.to_owned(), line }),
            }
        }
        if !row.is_empty() {
            rows.rows.push(row);
            rows.lines.push(line);
        }
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a line of another length that is cut, or a fault without its line.
    #[test]
    fn pairs_are_two_numbers_a_line() {
        let of = |text: &str| pairs(&parse("line.csv", text).expect("rows"));
        let pair = |numbers: [f64; 2], line: usize| {
            let place = format!("line {line} of `line.csv`");
            NumberPair { numbers, place }
        };
        assert_eq!(of("0, 1\n\n2 3"), Ok(vec![pair([0.0, 1.0], 1), pair([2.0, 3.0], 3)]));
        assert_eq!(of("0 1\n2"), Err("line 2 of `line.csv` has 1 number, not 2".into()));
    }

    /// Fails for a reader that counts rows instead of lines, or reads a comment.
    #[test]
    fn rows_know_their_lines() {
        let rows = parse("a.csv", "# two rows\n1, 2;3\n\n4\t5 6 # last\n").expect("rows");
        assert_eq!(rows.rows, [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
        assert_eq!(rows.lines.iter().map(|line| line.number).collect::<Vec<_>>(), [2, 4]);
        let error = parse("a.csv", "1 2\n3 x\n").expect_err("no number");
        let line = Line { file: "a.csv".into(), number: 2, text: "3 x".into() };
        assert_eq!(error, RowsTrouble::NotANumber { word: "x".into(), line });
    }
}

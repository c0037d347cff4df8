//! A page of texts, tables and pictures that needs no other file: what a study found. No scripts; every
//! text is escaped.

use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use crate::atomic;
use crate::error::ReportError;
use crate::page::document;
use crate::pvd::escape;

/// A page.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sheet {
    /// Headline.
    pub title: String,
    /// A line below it.
    pub subtitle: String,
    /// What is on it.
    pub parts: Vec<Part>,
}

/// A part of a page.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// A heading and sentences below it, each a line of a list.
    Text {
        /// Heading.
        heading: String,
        /// The sentences.
        lines: Vec<String>,
    },
    /// A table.
    Table {
        /// Heading.
        heading: String,
        /// A sentence about it.
        note: String,
        /// Names of the columns.
        head: Vec<String>,
        /// Rows, the first cell of each being its name.
        rows: Vec<Vec<String>>,
    },
    /// A picture.
    Picture {
        /// Bytes of a PNG file.
        png: Vec<u8>,
        /// What it shows, for those who cannot see it.
        alt: String,
    },
}

impl Sheet {
    /// The page as text.
    pub fn to_html(&self) -> String {
        let title = escape(&self.title);
        let subtitle = escape(&self.subtitle);
        let parts: String = self.parts.iter().map(Part::to_html).collect();
        document(&title, &format!("<h1>{title}</h1>\n<p class=\"sub\">{subtitle}</p>\n{parts}"))
    }

    /// Writes the page to `path`.
    ///
    /// # Errors
    /// The file system refuses.
    pub fn write(&self, path: &Path) -> Result<(), ReportError> {
        atomic::write(path, self.to_html().as_bytes())
    }
}

impl Part {
    fn to_html(&self) -> String {
        match self {
            Self::Text { heading, lines } => {
                let lines: String =
                    lines.iter().map(|line| format!("<li>{}</li>\n", escape(line))).collect();
                format!(
                    "<section class=\"wide\"><h2>{}</h2>\n<ul>\n{lines}</ul></section>\n",
                    escape(heading)
                )
            }
            Self::Table { heading, note, head, rows } => {
                let cells = |row: &[String], tag: &str| {
                    let cell = |text: &String| format!("<{tag}>{}</{tag}>", escape(text));
                    row.iter().map(cell).collect::<String>()
                };
                let line = |row: &Vec<String>| match row.split_first() {
                    Some((name, rest)) => {
                        format!("<tr><th>{}</th>{}</tr>\n", escape(name), cells(rest, "td"))
                    }
                    None => String::new(),
                };
                let rows: String = rows.iter().map(line).collect();
                format!(
                    "<section class=\"wide\"><h2>{}</h2>\n<p class=\"note\">{}</p>\n<div class=\"scroll\">\
                     <table>\n<tr class=\"head\">{}</tr>\n{rows}</table></div></section>\n",
                    escape(heading),
                    escape(note),
                    cells(head, "th"),
                )
            }
            Self::Picture { png, alt } => {
                let data = STANDARD.encode(png);
                format!("<img src=\"data:image/png;base64,{data}\" alt=\"{}\">\n", escape(alt))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a name that becomes markup, or a picture in a file of its own.
    #[test]
    fn texts_are_escaped_and_pictures_are_inside() {
        let sheet = Sheet {
            title: "a < b".into(),
            subtitle: "c & d".into(),
            parts: vec![
                Part::Text { heading: "<h>".into(), lines: vec!["<script>".into()] },
                Part::Table {
                    heading: "t".into(),
                    note: String::new(),
                    head: vec!["grain".into(), "wear".into()],
                    rows: vec![vec!["<i>".into(), "1".into()]],
                },
                Part::Picture { png: vec![1, 2, 3], alt: "\"quoted\"".into() },
            ],
        };
        let html = sheet.to_html();
        assert!(!html.contains("<script>") && !html.contains("<i>") && html.contains("&lt;i&gt;"));
        assert!(html.contains("<th>&lt;i&gt;</th><td>1</td>"));
        assert!(html.contains("base64,AQID\"") && html.contains("&quot;quoted&quot;"));
    }
}

//! A scene's text after patches, which still knows where each byte came from: from the file, or
//! from the argument that patched it.

use std::ops::Range;

use crate::problem::{Mark, Source};

/// A stretch of the patched text and its origin.
#[derive(Clone, Debug, PartialEq)]
struct Stretch {
    length: usize,
    source: usize,
    origin: Range<usize>,
}

/// New text, and the part of its source that it stands for.
pub(crate) struct Piece {
    pub(crate) text: String,
    pub(crate) origin: Range<usize>,
}

/// A text made of pieces of several sources.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Patched {
    /// What the text is, in messages: `scene`.
    pub(crate) kind: &'static str,
    pub(crate) text: String,
    pub(crate) sources: Vec<Source>,
    stretches: Vec<Stretch>,
}

impl Patched {
    pub(crate) fn new(kind: &'static str, name: String, text: String) -> Self {
        let stretch = Stretch { length: text.len(), source: 0, origin: 0..text.len() };
        let source = Source { name, text: text.clone(), first_line: 1 };
        Self { kind, text, sources: vec![source], stretches: vec![stretch] }
    }

    /// Adds a source; the index is its name in marks.
    pub(crate) fn add_source(&mut self, source: Source) -> usize {
        self.sources.push(source);
        self.sources.len() - 1
    }

    /// Puts `pieces` of a source in the place of `range`.
    pub(crate) fn replace(&mut self, range: Range<usize>, source: usize, pieces: Vec<Piece>) {
        let mut after = self.cut(range.end);
        self.cut(range.start);
        let mut kept = Vec::new();
        let mut start = 0;
        for stretch in &self.stretches {
            if start < range.start {
                kept.push(stretch.clone());
            }
            start += stretch.length;
        }
        let text: String = pieces.iter().map(|piece| piece.text.as_str()).collect();
        kept.extend(pieces.into_iter().map(|piece| Stretch {
            length: piece.text.len(),
            source,
            origin: piece.origin,
        }));
        kept.append(&mut after);
        self.stretches = kept;
        self.text.replace_range(range, &text);
    }

    /// Makes a stretch begin at `at`; returns the stretches from there on.
    fn cut(&mut self, at: usize) -> Vec<Stretch> {
        let mut start = 0;
        for i in 0..self.stretches.len() {
            let stretch = self.stretches[i].clone();
            let inside = at.saturating_sub(start);
            if inside == 0 {
                return self.stretches[i..].to_vec();
            }
            if inside < stretch.length {
                let [left, right] = stretch.split(inside);
                self.stretches.splice(i..=i, [left, right]);
                return self.stretches[i + 1..].to_vec();
            }
            start += stretch.length;
        }
        Vec::new()
    }

    /// A mark where `range` of the patched text came from.
    pub(crate) fn mark(&self, range: Range<usize>, label: impl Into<String>) -> Mark {
        let (source, first) = self.origin(range.start);
        let (end_source, last) = self.origin(range.end.saturating_sub(1).max(range.start));
        let text = &self.sources[source].text;
        let start = floor(text, first.start);
        let end = if end_source == source && last.end > start { last.end } else { first.end };
        Mark { source, range: start..ceil(text, end.max(start)), label: label.into() }
    }

    /// Source and bytes that the byte at `at` came from.
    fn origin(&self, at: usize) -> (usize, Range<usize>) {
        let mut start = 0;
        for stretch in &self.stretches {
            if at < start + stretch.length {
                return (stretch.source, stretch.byte(at - start));
            }
            start += stretch.length;
        }
        let end = self.sources[0].text.len();
        (0, end..end)
    }
}

impl Stretch {
    /// True when the text is its origin's, byte for byte.
    fn is_verbatim(&self) -> bool {
        self.length == self.origin.len()
    }

    fn byte(&self, at: usize) -> Range<usize> {
        match self.is_verbatim() {
            true => self.origin.start + at..self.origin.start + at + 1,
            false => self.origin.clone(),
        }
    }

    fn split(self, at: usize) -> [Self; 2] {
        let (left, right) = match self.is_verbatim() {
            true => {
                let middle = self.origin.start + at;
                (self.origin.start..middle, middle..self.origin.end)
            }
            false => (self.origin.clone(), self.origin.clone()),
        };
        [
            Self { length: at, origin: left, ..self.clone() },
            Self { length: self.length - at, origin: right, ..self },
        ]
    }
}

fn floor(text: &str, at: usize) -> usize {
    text.floor_char_boundary(at)
}

fn ceil(text: &str, at: usize) -> usize {
    text.ceil_char_boundary(at)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn marked(patched: &Patched, needle: &str) -> (usize, String) {
        let at = patched.text.find(needle).unwrap();
        let mark = patched.mark(at..at + needle.len(), "");
        (mark.source, patched.sources[mark.source].text[mark.range].to_owned())
    }

    #[test]
    fn a_place_in_the_patched_text_leads_to_its_source() {
        let mut patched = Patched::new("scene", "file".into(), "(a: 1, b: µ, c: 3)".into());
        let text = "b=30 deg".to_owned();
        let argument = patched.add_source(Source { name: "--set".into(), text, first_line: 1 });
        let at = patched.text.find('µ').unwrap();
        let piece = Piece { text: "\"30 deg\"".into(), origin: 2..8 };
        patched.replace(at..at + 'µ'.len_utf8(), argument, vec![piece]);

        assert_eq!(patched.text, "(a: 1, b: \"30 deg\", c: 3)");
        assert_eq!(marked(&patched, "a: 1"), (0, "a: 1".into()));
        assert_eq!(marked(&patched, "c: 3"), (0, "c: 3".into()));
        assert_eq!(marked(&patched, "\"30 deg\""), (argument, "30 deg".into()));
    }
}

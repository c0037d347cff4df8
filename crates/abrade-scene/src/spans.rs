//! Where each value of a RON text stands: a tree of nodes with byte spans, and look-up by path.
//!
//! The deserialiser knows a value but not its place; this knows the place but not the meaning. It
//! accepts slightly more than RON does, so that whatever RON reads can be found.

mod lexer;
mod parser;
mod path;
mod top;

use std::ops::Range;

pub(crate) use parser::parse;
pub use path::path;
pub(crate) use path::{ScenePath, Segment};
pub use top::field_names;

/// A value and its place in the text.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Node {
    pub(crate) span: Range<usize>,
    pub(crate) kind: Kind,
}

/// What a value is made of.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Kind {
    /// A number, string, character or boolean.
    Scalar,
    /// A bare word, such as an enum variant without fields.
    Word,
    /// `(a: 1)` or `Name(a: 1)`; also anything with nothing between its parentheses.
    Struct { name: Option<Range<usize>>, inside: Range<usize>, entries: Vec<Entry> },
    /// `{"a": 1}`.
    Map { inside: Range<usize>, entries: Vec<Entry> },
    /// `[1, 2]`, `(1, 2)` or `Name(1, 2)`.
    List { name: Option<Range<usize>>, items: Vec<Node> },
}

/// A named value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entry {
    pub(crate) key: Range<usize>,
    pub(crate) value: Node,
}

/// A value found by its path.
#[derive(Clone, Debug)]
pub(crate) struct Found<'a> {
    pub(crate) node: &'a Node,
    /// The name or key it stands under, if it has one.
    pub(crate) key: Option<Range<usize>>,
    /// How many segments of the path were found.
    pub(crate) depth: usize,
}

impl Found<'_> {
    /// The part of the text to mark: the value, or its name if it has several lines.
    pub(crate) fn place(&self, text: &str) -> Range<usize> {
        let head = self.node.head(text);
        let cut = head.len() == 1 && self.node.span.len() > 1;
        match &self.key {
            Some(key) if cut => key.clone(),
            _ => head,
        }
    }
}

impl Node {
    /// The value at `path`, or the last one on the way to it.
    pub(crate) fn find(&self, text: &str, path: &[Segment]) -> Found<'_> {
        let mut found = Found { node: self.inner(text), key: None, depth: 0 };
        while let Some(segment) = path.get(found.depth) {
            let Some((key, node)) = found.node.child(text, &segment.name) else { break };
            found = Found { node: node.inner(text), key, depth: found.depth + 1 };
        }
        found
    }

    /// Names of the values directly inside.
    pub(crate) fn names<'a>(&self, text: &'a str) -> Vec<&'a str> {
        self.entries().iter().map(|entry| name_of(text, &entry.key)).collect()
    }

    /// Named values directly inside.
    pub(crate) fn entries(&self) -> &[Entry] {
        match &self.kind {
            Kind::Struct { entries, .. } | Kind::Map { entries, .. } => entries,
            _ => &[],
        }
    }

    /// Values directly inside, named or not.
    pub(crate) fn children(&self) -> Box<dyn Iterator<Item = &Node> + '_> {
        match &self.kind {
            Kind::List { items, .. } => Box::new(items.iter()),
            _ => Box::new(self.entries().iter().map(|entry| &entry.value)),
        }
    }

    /// The part of the value to mark: the variant's name, or the whole value if it is short.
    pub(crate) fn head(&self, text: &str) -> Range<usize> {
        match &self.kind {
            Kind::Struct { name: Some(name), .. } | Kind::List { name: Some(name), .. } => {
                name.clone()
            }
            _ if text[self.span.clone()].contains('\n') => self.span.start..self.span.start + 1,
            _ => self.span.clone(),
        }
    }

    /// What `Some(..)` holds, or the node itself.
    fn inner(&self, text: &str) -> &Self {
        match &self.kind {
            Kind::List { name: Some(name), items } if &text[name.clone()] == "Some" => {
                items.first().map_or(self, |item| item.inner(text))
            }
            _ => self,
        }
    }

    fn child(&self, text: &str, name: &str) -> Option<(Option<Range<usize>>, &Self)> {
        if let Kind::List { items, .. } = &self.kind {
            let node = items.get(name.parse::<usize>().ok()?)?;
            return Some((None, node));
        }
        let entry = self.entries().iter().find(|entry| name_of(text, &entry.key) == name)?;
        Some((Some(entry.key.clone()), &entry.value))
    }
}

/// The name written at `key`: a bare word, or a quoted key without its quotes.
pub(crate) fn name_of<'a>(text: &'a str, key: &Range<usize>) -> &'a str {
    let word = &text[key.clone()];
    let bare = word.strip_prefix("r#").unwrap_or(word);
    bare.trim_matches('#').trim_matches('"')
}

#[cfg(test)]
mod tests;

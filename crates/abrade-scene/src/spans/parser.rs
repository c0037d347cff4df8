//! From RON text to the tree of spans.

use super::lexer::Cursor;
use super::{Entry, Kind, Node};

/// Values nested deeper than this are refused, as RON itself does.
const DEPTH_LIMIT: usize = 128;

/// Where a text stops being RON.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Trouble {
    pub(crate) at: usize,
    pub(crate) expected: &'static str,
}

/// The tree of a text that holds one value.
pub(crate) fn parse(text: &str) -> Result<Node, Trouble> {
    let mut parser = Parser { text, cursor: Cursor::new(text), depth: 0 };
    parser.cursor.skip_blank();
    let node = parser.value()?;
    parser.cursor.skip_blank();
    match parser.cursor.peek() {
        None => Ok(node),
        Some(_) => parser.fail("the end of the text"),
    }
}

struct Parser<'a> {
    text: &'a str,
    cursor: Cursor<'a>,
    depth: usize,
}

impl Parser<'_> {
    fn fail<T>(&self, expected: &'static str) -> Result<T, Trouble> {
        Err(Trouble { at: self.cursor.at, expected })
    }

    fn value(&mut self) -> Result<Node, Trouble> {
        if self.depth == DEPTH_LIMIT {
            return self.fail("values nested less deeply");
        }
        self.depth += 1;
        let node = self.value_inside();
        self.depth -= 1;
        node
    }

    fn value_inside(&mut self) -> Result<Node, Trouble> {
        let start = self.cursor.at;
        let kind = if self.cursor.eat("[") {
            let items = self.items("]", "`,` or `]`")?;
            Kind::List { name: None, items }
        } else if self.cursor.eat("{") {
            self.map()?
        } else if self.cursor.eat("(") {
            self.group(None)?
        } else {
            return self.leaf();
        };
        Ok(Node { span: start..self.cursor.at, kind })
    }

    /// A number, a string, a word, or a word with a group behind it.
    fn leaf(&mut self) -> Result<Node, Trouble> {
        match self.cursor.quoted() {
            Ok(Some(span)) => return Ok(Node { span, kind: Kind::Scalar }),
            Ok(None) => {}
            Err(()) => return self.fail("a closing quote"),
        }
        if let Some(span) = self.cursor.number() {
            return Ok(Node { span, kind: Kind::Scalar });
        }
        let Some(name) = self.cursor.word() else {
            return self.fail("a value");
        };
        let end = self.cursor.at;
        self.cursor.skip_blank();
        if self.cursor.eat("(") {
            let kind = self.group(Some(name.clone()))?;
            return Ok(Node { span: name.start..self.cursor.at, kind });
        }
        self.cursor.at = end;
        let kind = match &self.text[name.clone()] {
            "true" | "false" | "inf" | "NaN" => Kind::Scalar,
            _ => Kind::Word,
        };
        Ok(Node { span: name, kind })
    }

    /// What follows an opening parenthesis.
    fn group(&mut self, name: Option<std::ops::Range<usize>>) -> Result<Kind, Trouble> {
        let inside = self.cursor.at;
        self.cursor.skip_blank();
        let first = self.cursor.at;
        let named = self.cursor.word().is_some() && {
            self.cursor.skip_blank();
            self.cursor.rest().starts_with(':')
        };
        self.cursor.at = first;
        if !named && self.cursor.peek() != Some(')') {
            let items = self.items(")", "`,` or `)`")?;
            return Ok(Kind::List { name, items });
        }
        let entries = self.entries(")", "`,` or `)`", |parser| match parser.cursor.word() {
            Some(key) => Ok(key),
            None => parser.fail("a field name"),
        })?;
        Ok(Kind::Struct { name, inside: inside..self.cursor.at - 1, entries })
    }

    fn map(&mut self) -> Result<Kind, Trouble> {
        let inside = self.cursor.at;
        let entries = self.entries("}", "`,` or `}`", |parser| Ok(parser.value()?.span))?;
        Ok(Kind::Map { inside: inside..self.cursor.at - 1, entries })
    }

    fn items(&mut self, close: &'static str, expected: &'static str) -> Result<Vec<Node>, Trouble> {
        let mut items = Vec::new();
        self.cursor.skip_blank();
        while !self.cursor.eat(close) {
            items.push(self.value()?);
            self.separator(close, expected)?;
        }
        Ok(items)
    }

    fn entries(
        &mut self,
        close: &'static str,
        expected: &'static str,
        key: impl Fn(&mut Self) -> Result<std::ops::Range<usize>, Trouble>,
    ) -> Result<Vec<Entry>, Trouble> {
        let mut entries = Vec::new();
        self.cursor.skip_blank();
        while !self.cursor.eat(close) {
            let key = key(self)?;
            self.cursor.skip_blank();
            if !self.cursor.eat(":") {
                return self.fail("`:`");
            }
            self.cursor.skip_blank();
            entries.push(Entry { key, value: self.value()? });
            self.separator(close, expected)?;
        }
        Ok(entries)
    }

    /// A comma, or nothing before the closing character.
    fn separator(&mut self, close: &'static str, expected: &'static str) -> Result<(), Trouble> {
        self.cursor.skip_blank();
        if self.cursor.eat(",") {
            self.cursor.skip_blank();
        } else if !self.cursor.rest().starts_with(close) {
            return self.fail(expected);
        }
        Ok(())
    }
}

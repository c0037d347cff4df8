//! A cursor over RON text: blanks, comments, words, numbers, strings.

use std::ops::Range;

/// Reads a text from its start to its end. Always stands on a character boundary.
pub(super) struct Cursor<'a> {
    text: &'a str,
    pub(super) at: usize,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { text, at: 0 }
    }

    pub(super) fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    pub(super) fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    /// Steps over `expected` if it stands here.
    pub(super) fn eat(&mut self, expected: &str) -> bool {
        let here = self.rest().starts_with(expected);
        if here {
            self.at += expected.len();
        }
        here
    }

    /// Steps over characters as long as `belongs` holds.
    pub(super) fn eat_while(&mut self, belongs: impl Fn(char) -> bool) -> Range<usize> {
        let start = self.at;
        let rest = self.rest();
        self.at += rest.find(|c| !belongs(c)).unwrap_or(rest.len());
        start..self.at
    }

    /// Steps over blanks, comments and `#![..]` attributes.
    pub(super) fn skip_blank(&mut self) {
        loop {
            let before = self.at;
            self.eat_while(char::is_whitespace);
            if self.rest().starts_with("//") {
                self.eat_while(|c| c != '\n');
            } else if self.rest().starts_with("/*") {
                self.skip_block_comment();
            } else if self.rest().starts_with("#!") {
                self.eat_while(|c| c != ']');
                self.eat("]");
            }
            if self.at == before {
                return;
            }
        }
    }

    fn skip_block_comment(&mut self) {
        let mut depth = 0usize;
        while let Some(c) = self.peek() {
            if self.eat("/*") {
                depth += 1;
            } else if self.eat("*/") {
                depth -= 1;
                if depth == 0 {
                    return;
                }
            } else {
                self.at += c.len_utf8();
            }
        }
    }

    /// A bare word (`r#word` included), if one stands here.
    pub(super) fn word(&mut self) -> Option<Range<usize>> {
        let start = self.at;
        self.eat("r#");
        match self.peek() {
            Some(c) if c.is_alphabetic() || c == '_' => {
                self.eat_while(|c| c.is_alphanumeric() || c == '_');
                Some(start..self.at)
            }
            _ => {
                self.at = start;
                None
            }
        }
    }

    /// A number, if one stands here.
    pub(super) fn number(&mut self) -> Option<Range<usize>> {
        let start = self.at;
        let first = self.peek()?;
        if !(first.is_ascii_digit() || matches!(first, '+' | '-' | '.')) {
            return None;
        }
        self.at += 1;
        let mut before = first;
        while let Some(c) = self.peek() {
            let sign = matches!(c, '+' | '-') && matches!(before, 'e' | 'E');
            if !(c.is_ascii_alphanumeric() || matches!(c, '.' | '_') || sign) {
                break;
            }
            self.at += 1;
            before = c;
        }
        Some(start..self.at)
    }

    /// A string, byte string or character, raw ones included, if one stands here; `Err` if it is
    /// not closed.
    pub(super) fn quoted(&mut self) -> Result<Option<Range<usize>>, ()> {
        let start = self.at;
        self.eat("b");
        if self.eat("\"") {
            return self.close('"', start);
        }
        if self.eat("'") {
            return self.close('\'', start);
        }
        if self.eat("r") {
            let hashes = self.eat_while(|c| c == '#').len();
            if self.eat("\"") {
                let end = format!("\"{}", "#".repeat(hashes));
                let length = self.rest().find(&end).ok_or(())?;
                self.at += length + end.len();
                return Ok(Some(start..self.at));
            }
        }
        self.at = start;
        Ok(None)
    }

    fn close(&mut self, quote: char, start: usize) -> Result<Option<Range<usize>>, ()> {
        while let Some(c) = self.peek() {
            self.at += c.len_utf8();
            if c == quote {
                return Ok(Some(start..self.at));
            }
            if c == '\\' {
                self.at += self.peek().map_or(0, char::len_utf8);
            }
        }
        Err(())
    }
}

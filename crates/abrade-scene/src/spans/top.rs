//! The names of a text's own fields, of one too that is not RON everywhere.

use super::lexer::Cursor;

/// Names of the fields directly inside the outermost parentheses, as far as the text can be read.
pub fn field_names(text: &str) -> Vec<&str> {
    let (mut cursor, mut depth, mut names) = (Cursor::new(text), 0usize, Vec::new());
    loop {
        cursor.skip_blank();
        match cursor.quoted() {
            Ok(Some(_)) => continue,
            Ok(None) => {}
            Err(()) => return names,
        }
        if let Some(word) = cursor.word() {
            cursor.skip_blank();
            if depth == 1 && cursor.eat(":") {
                names.push(&text[word]);
            }
            continue;
        }
        let Some(c) = cursor.peek() else { return names };
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        cursor.at += c.len_utf8();
    }
}

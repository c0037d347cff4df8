//! Rust sources as the checks see them: text in comments and literals is blanked out, lines keep
//! their numbers, and test code is told from library code.

/// `text` with the inside of comments, strings and characters replaced by blanks.
pub fn code(text: &str) -> String {
    let bytes = text.as_bytes();
    let mut out = bytes.to_vec();
    let mut at = 0;
    while at < bytes.len() {
        let end = match bytes[at] {
            b'/' if bytes[at..].starts_with(b"//") => find(bytes, at, b"\n"),
            b'/' if bytes[at..].starts_with(b"/*") => end_of_block(bytes, at),
            b'"' => end_of_string(bytes, at),
            b'r' if starts_raw(bytes, at) => end_of_raw(bytes, at),
            b'\'' => end_of_character(bytes, at),
            _ => {
                at += 1;
                continue;
            }
        };
        // A tick alone opens a lifetime, which is code.
        let blanked = if end == at + 1 { end..end } else { at..end };
        for byte in &mut out[blanked] {
            if *byte != b'\n' {
                *byte = b' ';
            }
        }
        at = end;
    }
    String::from_utf8(out).expect("whole literals and comments are blanked")
}

/// Lines (from 0) of code that only tests see: items under `#[cfg(test)]`.
pub fn test_lines(code: &str) -> Vec<bool> {
    let lines: Vec<&str> = code.lines().collect();
    let mut test = vec![false; lines.len()];
    let mut at = 0;
    while at < lines.len() {
        if !lines[at].contains("#[cfg(test)]") {
            at += 1;
            continue;
        }
        let (mut depth, mut opened) = (0, false);
        while at < lines.len() {
            test[at] = true;
            for c in lines[at].chars() {
                depth += match c {
                    '{' => 1,
                    '}' => -1,
                    _ => 0,
                };
                opened |= c == '{';
            }
            let ends_here = if opened { depth == 0 } else { lines[at].contains(';') };
            at += 1;
            if ends_here {
                break;
            }
        }
    }
    test
}

/// True for files that hold nothing but tests, examples or benches.
pub fn is_test_file(name: &str) -> bool {
    let parts: Vec<&str> = name.split('/').collect();
    let folders = ["tests", "examples", "benches"];
    parts.iter().any(|part| folders.contains(part)) || name.ends_with("/tests.rs")
}

/// Lines (from 0) of `code` in which `word` stands by itself, not as a part of a longer name.
pub fn lines_with_word(code: &str, word: &str) -> Vec<usize> {
    let part = |c: char| c.is_alphanumeric() || c == '_';
    let alone = |line: &str| {
        line.match_indices(word).any(|(at, _)| {
            let before = line[..at].chars().next_back();
            let after = line[at + word.len()..].chars().next();
            !before.is_some_and(part) && !after.is_some_and(part)
        })
    };
    code.lines().enumerate().filter(|(_, line)| alone(line)).map(|(i, _)| i).collect()
}

fn find(bytes: &[u8], from: usize, what: &[u8]) -> usize {
    let found = bytes[from..].windows(what.len()).position(|window| window == what);
    found.map_or(bytes.len(), |at| from + at)
}

fn end_of_block(bytes: &[u8], from: usize) -> usize {
    let (mut at, mut depth) = (from, 0);
    while at < bytes.len() {
        if bytes[at..].starts_with(b"/*") {
            depth += 1;
            at += 2;
        } else if bytes[at..].starts_with(b"*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                break;
            }
        } else {
            at += 1;
        }
    }
    at
}

fn end_of_string(bytes: &[u8], from: usize) -> usize {
    let mut at = from + 1;
    while at < bytes.len() && bytes[at] != b'"' {
        at += if bytes[at] == b'\\' { 2 } else { 1 };
    }
    (at + 1).min(bytes.len())
}

/// True at the `r` of `r"` or `r#..#"` that is not the end of a name.
fn starts_raw(bytes: &[u8], at: usize) -> bool {
    let name = |b: u8| b.is_ascii_alphanumeric() || b == b'_';
    let inside_name = at > 0 && name(bytes[at - 1]) && bytes[at - 1] != b'b';
    let quote = bytes[at + 1..].iter().find(|b| **b != b'#');
    !inside_name && quote == Some(&b'"')
}

fn end_of_raw(bytes: &[u8], at: usize) -> usize {
    let hashes = bytes[at + 1..].iter().take_while(|b| **b == b'#').count();
    let close: Vec<u8> = [vec![b'"'], vec![b'#'; hashes]].concat();
    (find(bytes, at + 2 + hashes, &close) + close.len()).min(bytes.len())
}

/// The end of a character, or of the tick alone where it opens a lifetime.
fn end_of_character(bytes: &[u8], at: usize) -> usize {
    match bytes.get(at + 1) {
        Some(b'\\') => (find(bytes, at + 3, b"'") + 1).min(bytes.len()),
        Some(_) => {
            let character = std::str::from_utf8(&bytes[at + 1..]).expect("text");
            let width = character.chars().next().map_or(1, char::len_utf8);
            let closed = bytes.get(at + 1 + width) == Some(&b'\'');
            if closed { at + 2 + width } else { at + 1 }
        }
        None => at + 1,
    }
}

mod tests {
    use super::*;

    /// Fails for a reader that takes text for code, or code for text.
    #[test]
    fn comments_and_literals_are_blanked() {
        let text = "a(\"rapier \\\" b\"); // rapier\n/* x /* y */ rapier\n */ 'r'; '\\''; f::<'a>(r#\"rapier\"\nq\"#) rapier";
        let code = code(text);
        assert_eq!(code.lines().count(), text.lines().count());
        assert_eq!(lines_with_word(&code, "rapier"), [3]);
        assert!(code.contains("f::<'a>("), "{code}");
    }

    /// Fails for a mask that ends with the first brace or goes on to the end of the file.
    #[test]
    fn test_modules_are_told_from_code() {
        let code = "fn a() {}\n#[cfg(test)]\nmod tests {\n  fn b() { }\n}\nfn c() {}\n#[cfg(test)]\nmod more;\nfn d() {}";
        let test = test_lines(code);
        assert_eq!(test, [false, true, true, true, true, false, true, true, false]);
    }

    /// Fails for a search that finds parts of names.
    #[test]
    fn words_are_whole() {
        let code = "rapier3d\nabrade_rapier\nrapier::math\n(rapier)";
        assert_eq!(lines_with_word(code, "rapier"), [2, 3]);
    }
}

//! Rust source with all text blanked that is not product code: comments, literals, and items under
//! `#[cfg(test)]`.
//!
//! Spaces replace blanked characters and line breaks remain, so positions equal those in the
//! source.

/// Returns the code of a source, with positions unchanged.
pub fn product_code(source: &str) -> String {
    let mut text = without_comments_and_literals(source);
    while let Some(start) = position(&text, &TEST_ATTRIBUTE, 0) {
        let end = end_of_item(&text, start + TEST_ATTRIBUTE.len());
        blank(&mut text, start, end);
    }
    text.into_iter().collect()
}

const TEST_ATTRIBUTE: [char; 12] = ['#', '[', 'c', 'f', 'g', '(', 't', 'e', 's', 't', ')', ']'];

fn without_comments_and_literals(source: &str) -> Vec<char> {
    let mut text: Vec<char> = source.chars().collect();
    let mut at = 0;
    while at < text.len() {
        let end = match (text[at], text.get(at + 1)) {
            ('/', Some('/')) => text[at..]
                .iter()
                .position(|c| *c == '\n')
                .map_or(text.len(), |length| at + length),
            ('/', Some('*')) => end_of_comment(&text, at),
            ('"', _) => end_of_string(&text, at),
            ('r', Some('"' | '#')) if at == 0 || !is_word(text[at - 1]) || text[at - 1] == 'b' => {
                end_of_raw_string(&text, at)
            }
            ('\'', _) => end_of_character(&text, at),
            _ => at,
        };
        blank(&mut text, at, end);
        at = end.max(at + 1);
    }
    text
}

pub fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn blank(text: &mut [char], start: usize, end: usize) {
    text[start..end]
        .iter_mut()
        .filter(|c| **c != '\n')
        .for_each(|c| *c = ' ');
}

fn position(text: &[char], pattern: &[char], from: usize) -> Option<usize> {
    (from..text.len()).find(|at| text[*at..].starts_with(pattern))
}

/// Block comments nest.
fn end_of_comment(text: &[char], start: usize) -> usize {
    let (mut depth, mut at) = (0, start);
    while at < text.len() {
        match (text[at], text.get(at + 1)) {
            ('/', Some('*')) => (depth, at) = (depth + 1, at + 2),
            ('*', Some('/')) => (depth, at) = (depth - 1, at + 2),
            _ => at += 1,
        }
        if depth == 0 {
            return at;
        }
    }
    text.len()
}

fn end_of_string(text: &[char], start: usize) -> usize {
    let mut at = start + 1;
    while at < text.len() && text[at] != '"' {
        at += if text[at] == '\\' { 2 } else { 1 };
    }
    (at + 1).min(text.len())
}

/// `r"..."` or `r#"..."#`; `start` itself for `r#name`.
fn end_of_raw_string(text: &[char], start: usize) -> usize {
    let hashes = text[start + 1..].iter().take_while(|c| **c == '#').count();
    let open = start + 1 + hashes;
    if text.get(open) != Some(&'"') {
        return start;
    }
    let mut close = vec!['"'];
    close.extend(std::iter::repeat_n('#', hashes));
    position(text, &close, open + 1).map_or(text.len(), |at| at + close.len())
}

/// `'x'` or `'\n'`; `start` itself for a lifetime.
fn end_of_character(text: &[char], start: usize) -> usize {
    match (text.get(start + 1), text.get(start + 2)) {
        // An escaped quote has two characters, so the search for the closing one starts behind it.
        (Some('\\'), Some(_)) => position(text, &['\''], start + 3).map_or(text.len(), |at| at + 1),
        (Some(_), Some('\'')) => start + 3,
        _ => start,
    }
}

/// End of the item that starts at a position: behind its closing brace with what may follow, or
/// behind its semicolon.
fn end_of_item(text: &[char], start: usize) -> usize {
    let mut depth = 0;
    for (at, c) in text.iter().enumerate().skip(start) {
        match c {
            '{' | '(' | '[' => depth += 1,
            '}' | ')' | ']' => depth -= 1,
            _ => {}
        }
        if depth == 0 && (*c == '}' || *c == ';') {
            return if text.get(at + 1) == Some(&';') {
                at + 2
            } else {
                at + 1
            };
        }
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::product_code;

    #[test]
    fn comments_and_literals_are_removed_and_code_remains() {
        let source = "a(); // crate::x\nb(\"crate::\\\"y\", r#\"crate::\"z\"#, '\\'', '\"', 'q'); /* crate::/* */u */ let r#type: &'static str = c;";
        let code = product_code(source);
        assert!(!code.contains("crate"), "{code}");
        assert!(
            code.contains("a();")
                && code.contains("b(")
                && code.contains("let r#type: &'static str = c;"),
            "{code}"
        );
        assert_eq!(code.chars().count(), source.chars().count());
    }

    #[test]
    fn test_items_are_removed_and_later_code_remains() {
        let code = product_code(
            "#[cfg(test)]\nmod tests { fn f() { g([1]); } }\n#[cfg(test)]\nuse crate::{a, b};\nuse crate::plant;",
        );
        assert_eq!(code.trim(), "use crate::plant;");
        assert_eq!(code.matches('\n').count(), 4);
    }
}

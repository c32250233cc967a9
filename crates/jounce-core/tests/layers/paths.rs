//! Module paths that begin at the root of the crate: `crate::name`, `crate::{name, name}`,
//! `super::super::name`.

use super::blanking::{is_word, product_code};

/// Use of a top-level module.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Use {
    /// Name behind the root.
    pub name: String,
    /// Line of the source, from 1.
    pub line: usize,
}

/// Returns the uses in the source of a module `depth` modules below the root.
pub fn uses(source: &str, depth: usize) -> Vec<Use> {
    let code: Vec<char> = product_code(source).chars().collect();
    let words = words(&code);
    let mut uses_found = Vec::new();
    for (i, (start, word)) in words.iter().enumerate() {
        let continues = i > 0 && is_joined(&code, &words[i - 1], *start);
        let roots = match word.as_str() {
            "crate" => 1,
            // The first `depth` of a chain of `super` lead to the root.
            "super" if !continues && supers(&code, &words[i..]) >= depth => depth,
            _ => continue,
        };
        let line = 1 + code[..*start].iter().filter(|c| **c == '\n').count();
        let last = &words[i + roots - 1];
        let names = names_behind(&code, last.0 + last.1.chars().count());
        uses_found.extend(names.into_iter().map(|name| Use { name, line }));
    }
    uses_found
}

/// Identifiers with their positions.
fn words(code: &[char]) -> Vec<(usize, String)> {
    let mut words: Vec<(usize, String)> = Vec::new();
    for (at, c) in code.iter().enumerate().filter(|(_, c)| is_word(**c)) {
        match words.last_mut() {
            Some((start, word)) if *start + word.chars().count() == at => word.push(*c),
            _ => words.push((at, c.to_string())),
        }
    }
    words
}

/// True where only `::` lies between a word and the position of the next.
fn is_joined(code: &[char], before: &(usize, String), next: usize) -> bool {
    let between: String = code[before.0 + before.1.chars().count()..next]
        .iter()
        .collect();
    between.split_whitespace().collect::<String>() == "::"
}

/// Length of the chain `super::super::..` at the start of the words.
fn supers(code: &[char], words: &[(usize, String)]) -> usize {
    let linked = words
        .windows(2)
        .take_while(|pair| pair[1].1 == "super" && is_joined(code, &pair[0], pair[1].0))
        .count();
    1 + linked
}

/// First names behind the `::` at a position: one, or all of a `{..}` group.
fn names_behind(code: &[char], position: usize) -> Vec<String> {
    let rest: String = code[position..].iter().collect();
    let Some(rest) = rest.trim_start().strip_prefix("::").map(str::trim_start) else {
        return Vec::new();
    };
    match rest.strip_prefix('{') {
        Some(group) => first_names(group),
        None => vec![first_name(rest)],
    }
}

/// First names of the members of a group, without its opening brace.
fn first_names(group: &str) -> Vec<String> {
    let (mut depth, mut members) = (0, vec![String::new()]);
    for c in group.chars() {
        match c {
            '}' if depth == 0 => break,
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => members.push(String::new()),
            _ => {}
        }
        if let Some(member) = members.last_mut().filter(|_| depth == 0 && c != ',') {
            member.push(c);
        }
    }
    members
        .iter()
        .map(|member| first_name(member.trim()))
        .filter(|name| !name.is_empty())
        .collect()
}

/// Name at the start; a glob is returned as it is.
fn first_name(text: &str) -> String {
    let text = text.strip_prefix("r#").unwrap_or(text);
    if text.starts_with('*') {
        "*".to_owned()
    } else {
        text.chars().take_while(|c| is_word(*c)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::uses;

    fn names(source: &str, depth: usize) -> Vec<String> {
        uses(source, depth)
            .into_iter()
            .map(|uses_found| uses_found.name)
            .collect()
    }

    #[test]
    fn finds_every_spelling_of_a_path_from_the_root() {
        assert_eq!(names("use crate::plant::Pair;", 2), ["plant"]);
        assert_eq!(
            names(
                "use crate::{plant::{Pair, Tone}, spec, integrate::{self}};",
                2
            ),
            ["plant", "spec", "integrate"]
        );
        assert_eq!(
            names(
                "fn f(x: &crate :: spec::Spec) -> Vec<crate::plant::Pair> {}",
                2
            ),
            ["spec", "plant"]
        );
        assert_eq!(names("pub use crate::*;", 2), ["*"]);
        assert_eq!(
            names("pub(crate) fn f() { super::g(); crates::h(); }", 2),
            Vec::<String>::new()
        );
    }

    #[test]
    fn follows_super_up_to_the_root_and_no_further() {
        assert_eq!(names("use super::super::spec::Spec;", 2), ["spec"]);
        assert_eq!(names("use super::kernel::Kernel;", 2), Vec::<String>::new());
        assert_eq!(names("use super::spec::Spec;", 1), ["spec"]);
        assert_eq!(
            names("use super::{contact, plant as p};", 1),
            ["contact", "plant"]
        );
    }

    #[test]
    fn reports_the_line() {
        assert_eq!(uses("//! crate::a\n\nuse crate::b;", 2)[0].line, 3);
    }
}

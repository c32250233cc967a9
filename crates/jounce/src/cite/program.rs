//! The citation of jounce itself: that of `CITATION.cff`.

use super::Citation;
use jounce_spec::bibliography::PublicationKind;

/// The file that names the title, the version, the authors and the address.
const FILE: &str = include_str!("../../CITATION.cff");

/// Returns the citation of the program.
pub(super) fn citation(reasons: Vec<String>) -> Citation {
    let citation = Citation {
        key: "jounce".to_owned(),
        kind: PublicationKind::Other,
        reasons,
        authors: authors(FILE),
        title: value(FILE, "title").to_owned(),
        container: String::new(),
        volume: String::new(),
        number: String::new(),
        pages: String::new(),
        year: None,
        publisher: String::new(),
        doi: value(FILE, "doi").to_owned(),
        url: value(FILE, "url").to_owned(),
        version: value(FILE, "version").to_owned(),
        text: String::new(),
        bibtex: String::new(),
    };
    citation.printed()
}

/// Returns the text of a key at the left margin, without quotes; empty without the key.
fn value<'a>(file: &'a str, key: &str) -> &'a str {
    let value = |line: &'a str| line.strip_prefix(key)?.strip_prefix(": ");
    unquoted(file.lines().find_map(value).unwrap_or_default())
}

/// Returns the authors, each `Family, Given`, or the name of a group.
fn authors(file: &str) -> Vec<String> {
    let from = file.lines().skip_while(|line| *line != "authors:").skip(1);
    let lines = from.take_while(|line| line.starts_with([' ', '-']));
    let mut authors: Vec<String> = Vec::new();
    for line in lines {
        let field = line.trim_start_matches([' ', '-']);
        let Some((key, name)) = field.split_once(": ") else {
            continue;
        };
        match (key, authors.last_mut()) {
            ("name" | "family-names", _) => authors.push(unquoted(name).to_owned()),
            ("given-names", Some(author)) => *author += &format!(", {}", unquoted(name)),
            _ => {}
        }
    }
    authors
}

fn unquoted(text: &str) -> &str {
    text.trim().trim_matches('"')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_program_is_cited_as_its_file_says() {
        let citation = citation(Vec::new());
        assert_eq!(citation.version, env!("CARGO_PKG_VERSION"));
        for text in [&citation.title, &citation.url, &citation.authors[0]] {
            assert!(!text.is_empty() && FILE.contains(text.as_str()), "{text}");
        }
        let count = FILE.matches("- name: ").count() + FILE.matches("- family-names: ").count();
        assert_eq!(citation.authors.len(), count);
    }

    #[test]
    fn persons_have_two_names() {
        let file = "title: a\nauthors:\n  - family-names: Doe\n    given-names: J.\n    orcid: x\n  - name: \"the b\"\nurl: c\n";
        assert_eq!(authors(file), ["Doe, J.", "the b"]);
        assert_eq!(value(file, "url"), "c");
    }
}

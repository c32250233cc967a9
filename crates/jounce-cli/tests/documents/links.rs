//! Links and pictures of a document.

use super::root;
use std::path::Path;

/// A link or picture of a document.
#[derive(Debug, PartialEq, Eq)]
pub struct Link {
    /// Words in the brackets: the text, or the alternative text of a picture.
    pub words: String,
    /// Target in the parentheses.
    pub target: String,
    /// True for a picture.
    pub is_picture: bool,
}

/// The links of a document outside its code.
pub fn links(markdown: &str) -> Vec<Link> {
    let text = without_code(markdown);
    let mut found = Vec::new();
    for (at, _) in text.match_indices("](") {
        let target = text[at + 2..].split(')').next().unwrap_or_default();
        let Some(start) = text[..at].rfind('[') else {
            continue;
        };
        found.push(Link {
            words: text[start + 1..at].to_owned(),
            target: target.to_owned(),
            is_picture: text[..start].ends_with('!'),
        });
    }
    found
}

/// Why a link leads nowhere, or a picture has no alternative text.
pub fn fault(document: &str, link: &Link) -> Option<String> {
    if link.is_picture && link.words.split_whitespace().count() < 3 {
        return Some(format!(
            "{document}: the picture {} has no alternative text",
            link.target
        ));
    }
    if link.target.starts_with("https://") {
        return None;
    }
    let (file, heading) = link.target.split_once('#').unwrap_or((&link.target, ""));
    let folder = Path::new(document).parent().unwrap_or(Path::new(""));
    let path = if file.is_empty() {
        root().join(document)
    } else {
        root().join(folder).join(file)
    };
    if !path.exists() {
        return Some(format!("{document}: there is no {}", link.target));
    }
    let has_heading = heading.is_empty()
        || std::fs::read_to_string(&path)
            .is_ok_and(|page| anchors(&page).contains(&heading.to_owned()));
    (!has_heading).then(|| format!("{document}: {} has no heading of this name", link.target))
}

/// Names of the headings of a page, as mdbook makes them.
fn anchors(page: &str) -> Vec<String> {
    let headings = page.lines().filter(|line| line.starts_with('#'));
    let name = |heading: &str| {
        let letters = heading.trim_start_matches('#').trim().chars();
        letters
            .filter_map(|c| match c {
                ' ' => Some('-'),
                '_' | '-' => Some(c),
                _ => c.is_alphanumeric().then(|| c.to_ascii_lowercase()),
            })
            .collect()
    };
    headings.map(name).collect()
}

fn without_code(markdown: &str) -> String {
    let mut is_code = false;
    let mut text = String::new();
    for line in markdown.lines() {
        if line.trim_start().starts_with("```") {
            is_code = !is_code;
        } else if !is_code {
            let words = line.split('`').step_by(2);
            text.extend(words.chain(["\n"]));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{Link, anchors, fault, links};

    fn link(words: &str, target: &str, is_picture: bool) -> Link {
        let (words, target) = (words.to_owned(), target.to_owned());
        Link {
            words,
            target,
            is_picture,
        }
    }

    #[test]
    fn finds_links_and_pictures_outside_code() {
        let markdown = "[a](b.md) `[c](d)`\n```text\n[e](f)\n```\n![g h](i.svg)\n";
        let expected = [link("a", "b.md", false), link("g h", "i.svg", true)];
        assert_eq!(links(markdown), expected);
    }

    #[test]
    fn a_missing_file_a_missing_heading_and_a_bare_picture_are_faults() {
        let fault_of =
            |words, target, is_picture| fault("README.md", &link(words, target, is_picture));
        assert_eq!(fault_of("x", "LICENSE-MIT", false), None);
        assert_eq!(fault_of("x", "book/src/spec.md#errors", false), None);
        assert_eq!(fault_of("x", "https://example.org", false), None);
        assert!(fault_of("x", "no-such.md", false).is_some());
        assert!(fault_of("x", "book/src/spec.md#no-such", false).is_some());
        assert!(fault_of("", "LICENSE-MIT", true).is_some());
        assert_eq!(anchors("## Keys of `[a.b]`, two\n"), ["keys-of-ab-two"]);
    }
}

//! A citation as one line of text.

use super::Citation;

/// Returns the citation: authors, title, journal with volume and pages, year, DOI.
pub(super) fn line(citation: &Citation) -> String {
    let authors: Vec<String> = citation
        .authors
        .iter()
        .map(|name| given_first(name))
        .collect();
    let mut parts = vec![join(&authors), citation.title.clone()];
    parts.push(issue(citation));
    parts.push(citation.publisher.clone());
    let version = &citation.version;
    if !version.is_empty() {
        parts.push(format!("version {version}"));
    }
    parts.push(citation.url.clone());
    parts.retain(|part| !part.is_empty());
    let mut line = parts.join(", ");
    if let Some(year) = citation.year {
        line += &format!(" ({year})");
    }
    if !citation.doi.is_empty() {
        line += &format!(", https://doi.org/{}", citation.doi);
    }
    line
}

/// Returns `Journal 12(3), 45–67`, without the parts that are missing.
fn issue(citation: &Citation) -> String {
    let mut issue = citation.container.clone();
    if !citation.volume.is_empty() {
        issue += &format!(" {}", citation.volume);
    }
    if !citation.number.is_empty() {
        issue += &format!("({})", citation.number);
    }
    if !citation.pages.is_empty() {
        issue += &format!(", {}", citation.pages);
    }
    issue
}

/// Returns `Given Family` of `Family, Given`.
fn given_first(name: &str) -> String {
    match name.split_once(", ") {
        Some((family, given)) => format!("{given} {family}"),
        None => name.to_owned(),
    }
}

/// Returns `A, B and C`.
fn join(names: &[String]) -> String {
    match names {
        [before @ .., last] if !before.is_empty() => format!("{} and {last}", before.join(", ")),
        names => names.concat(),
    }
}

//! A citation as an entry of BibTeX, in ASCII.

use super::Citation;
use jounce_spec::bibliography::PublicationKind;

/// Characters of the bibliography outside ASCII, in the notation of TeX.
const TEX: &[(char, &str)] = &[
    ('\u{2013}', "--"),
    ('á', "{\\'a}"),
    ('ê', "{\\^e}"),
    ('í', "{\\'\\i}"),
    ('ó', "{\\'o}"),
    ('ö', "{\\\"o}"),
    ('ü', "{\\\"u}"),
    ('š', "{\\v s}"),
    ('&', "\\&"),
    ('%', "\\%"),
    ('#', "\\#"),
    ('_', "\\_"),
];

/// Returns the entry, one field a line.
pub(super) fn entry(citation: &Citation) -> String {
    let (kind, container) = match citation.kind {
        PublicationKind::Article => ("article", "journal"),
        PublicationKind::Book => ("book", "booktitle"),
        PublicationKind::Collection => ("inproceedings", "booktitle"),
        PublicationKind::Other => ("misc", "howpublished"),
    };
    let names = citation
        .authors
        .iter()
        .map(|name| match name.contains(", ") {
            true => tex(name),
            // Braces keep a name without parts in one piece.
            false => format!("{{{}}}", tex(name)),
        });
    let version = match citation.version.as_str() {
        "" => String::new(),
        version => format!("Version {version}"),
    };
    let year = citation
        .year
        .map_or_else(String::new, |year| year.to_string());
    let fields = [
        ("author", names.collect::<Vec<_>>().join(" and ")),
        // Double braces keep the capitals of the title.
        ("title", format!("{{{}}}", tex(&citation.title))),
        (container, tex(&citation.container)),
        ("volume", tex(&citation.volume)),
        ("number", tex(&citation.number)),
        ("pages", tex(&citation.pages)),
        ("publisher", tex(&citation.publisher)),
        ("year", year),
        ("doi", citation.doi.clone()),
        ("url", citation.url.clone()),
        ("note", tex(&version)),
    ];
    let mut entry = format!("@{kind}{{{},\n", citation.key);
    for (name, value) in fields.iter().filter(|(_, value)| !value.is_empty()) {
        entry += &format!("  {name} = {{{value}}},\n");
    }
    entry + "}\n"
}

/// Returns a text in the notation of TeX.
fn tex(text: &str) -> String {
    let written = |character: char| {
        let known = TEX.iter().find(|(known, _)| *known == character);
        known.map_or_else(|| character.to_string(), |(_, tex)| (*tex).to_owned())
    };
    text.chars().map(written).collect()
}

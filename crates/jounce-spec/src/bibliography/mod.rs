//! Publications behind the specs, models and methods of jounce: one entry for each.
//!
//! An entry has a DOI only where it is known. The page `howto/cite.md` of the book names the DOIs
//! that no other source has confirmed.

mod harvesters;
mod methods;
mod models;

/// Kind of a publication, as in BibTeX.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum PublicationKind {
    /// Article of a journal.
    Article,
    /// Book.
    Book,
    /// Paper in the proceedings of a conference, or chapter of a collection.
    Collection,
    /// Any other publication.
    Other,
}

/// Publication.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Publication {
    /// Key in BibTeX and in `[source]` of a spec.
    pub key: &'static str,
    /// Kind.
    pub kind: PublicationKind,
    /// Authors, each `Family, Given`.
    pub authors: &'static [&'static str],
    /// Title.
    pub title: &'static str,
    /// Journal or collection; empty for a book.
    pub container: &'static str,
    /// Volume; empty without one.
    pub volume: &'static str,
    /// Issue within the volume; empty without one.
    pub number: &'static str,
    /// Pages, or the number of the article; empty without.
    pub pages: &'static str,
    /// Year.
    pub year: u16,
    /// Publisher of a book; empty for an article.
    pub publisher: &'static str,
    /// DOI; empty where it is not known.
    pub doi: &'static str,
}

/// An article; the entries fill the fields that they have.
const ARTICLE: Publication = Publication {
    key: "",
    kind: PublicationKind::Article,
    authors: &[],
    title: "",
    container: "",
    volume: "",
    number: "",
    pages: "",
    year: 0,
    publisher: "",
    doi: "",
};

/// A book.
const BOOK: Publication = Publication {
    kind: PublicationKind::Book,
    ..ARTICLE
};

/// A paper in a collection.
const COLLECTION: Publication = Publication {
    kind: PublicationKind::Collection,
    ..ARTICLE
};

/// Returns all publications.
pub fn publications() -> impl Iterator<Item = &'static Publication> {
    [harvesters::ENTRIES, models::ENTRIES, methods::ENTRIES]
        .into_iter()
        .flatten()
}

/// Returns the publication with a key.
pub fn publication(key: &str) -> Option<&'static Publication> {
    publications().find(|publication| publication.key == key)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_entry_has_what_its_kind_needs() {
        for entry in publications() {
            let key = entry.key;
            assert!(!key.is_empty() && !entry.title.is_empty(), "{key}");
            assert!((1850..2100).contains(&entry.year), "{key}: {}", entry.year);
            let is_other = entry.kind == PublicationKind::Other;
            assert!(is_other || !entry.authors.is_empty(), "{key}");
            let is_book = entry.kind == PublicationKind::Book;
            assert_eq!(is_book || is_other, entry.container.is_empty(), "{key}");
            assert!(!is_book || !entry.publisher.is_empty(), "{key}");
            for author in entry.authors {
                assert_eq!(author.matches(", ").count(), 1, "{key}: {author}");
            }
        }
    }

    #[test]
    fn keys_and_identifiers_are_unique() {
        let (mut keys, mut identifiers) = (BTreeSet::new(), BTreeSet::new());
        for entry in publications() {
            assert!(keys.insert(entry.key), "{} is written twice", entry.key);
            let is_new = entry.doi.is_empty() || identifiers.insert(entry.doi);
            assert!(is_new, "{}: {} is written twice", entry.key, entry.doi);
            let is_valid =
                entry.doi.is_empty() || entry.doi.starts_with("10.") && entry.doi.contains('/');
            assert!(is_valid, "{}: {}", entry.key, entry.doi);
        }
    }

    /// The article number of a paper in Smart Materials and Structures holds its issue, and its DOI
    /// the volume and both: a slip of one digit fails.
    #[test]
    fn identifiers_of_numbered_articles_match_their_volumes() {
        let numbered = publications().filter(|one| one.doi.starts_with("10.1088/0964-1726/"));
        let mut count = 0;
        for entry in numbered {
            let pages = entry.pages.split('\u{2013}').next().unwrap();
            let issue: u8 = entry.number.parse().unwrap();
            let (volume, pages) = (
                entry.volume,
                match pages.len() {
                    6 => pages,
                    _ => "001",
                },
            );
            assert_eq!(
                entry.doi,
                format!("10.1088/0964-1726/{volume}/{issue}/{pages}")
            );
            assert!(
                pages == "001" || pages.starts_with(&format!("{issue:02}")[..2]),
                "{}",
                entry.key
            );
            count += 1;
        }
        assert_eq!(count, 6);
    }
}

//! Citations of a spec.

use super::{bibtex, text};
use jounce_spec::bibliography::{Publication, PublicationKind};
use serde::Serialize;

/// Citations of a spec.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct CiteResult {
    /// Citations; jounce itself is the first.
    pub citations: Vec<Citation>,
}

/// A publication, or the program, with the reasons to cite it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Citation {
    /// Key in BibTeX.
    pub key: String,
    /// Kind: `article`, `book`, `collection` or `other`.
    pub kind: PublicationKind,
    /// Why the spec uses it.
    pub reasons: Vec<String>,
    /// Authors, each `Family, Given`, or a name that has no such parts.
    pub authors: Vec<String>,
    /// Title.
    pub title: String,
    /// Journal or collection; empty for others.
    pub container: String,
    /// Volume; empty without one.
    pub volume: String,
    /// Issue; empty without one.
    pub number: String,
    /// Pages, or the number of the article; empty without.
    pub pages: String,
    /// Year; `None` for the program.
    pub year: Option<u16>,
    /// Publisher; empty for an article.
    pub publisher: String,
    /// DOI; empty where it is not known.
    pub doi: String,
    /// Address; empty for a publication.
    pub url: String,
    /// Version of the program; empty for a publication.
    pub version: String,
    /// The citation in one line of text.
    pub text: String,
    /// The citation as an entry of BibTeX, in ASCII.
    pub bibtex: String,
}

impl CiteResult {
    /// Returns all citations as a file of BibTeX.
    pub fn bibtex(&self) -> String {
        let entries: Vec<&str> = self
            .citations
            .iter()
            .map(|one| one.bibtex.as_str())
            .collect();
        entries.join("\n")
    }
}

impl Citation {
    /// Returns the citation of a publication.
    pub(super) fn of(publication: &Publication, reasons: Vec<String>) -> Self {
        let citation = Self {
            key: publication.key.to_owned(),
            kind: publication.kind,
            reasons,
            authors: (publication.authors.iter())
                .map(|author| (*author).to_owned())
                .collect(),
            title: publication.title.to_owned(),
            container: publication.container.to_owned(),
            volume: publication.volume.to_owned(),
            number: publication.number.to_owned(),
            pages: publication.pages.to_owned(),
            year: Some(publication.year),
            publisher: publication.publisher.to_owned(),
            doi: publication.doi.to_owned(),
            url: String::new(),
            version: String::new(),
            text: String::new(),
            bibtex: String::new(),
        };
        citation.printed()
    }

    /// Returns the citation with its text and its entry of BibTeX.
    pub(super) fn printed(self) -> Self {
        Self {
            text: text::line(&self),
            bibtex: bibtex::entry(&self),
            ..self
        }
    }
}

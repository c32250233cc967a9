//! A chapter of the report that is computed elsewhere.

use super::{NamedFigure, NamedTable, ReproduceError};
use crate::report::Document;

/// Words, tables and figures under one heading.
#[derive(Debug, Clone, PartialEq)]
pub struct Chapter {
    /// The heading.
    pub heading: String,
    /// What stands above the tables and figures.
    pub paragraphs: Vec<String>,
    /// Tables that are shown; a table without a caption is only written to its files.
    pub tables: Vec<NamedTable>,
    /// Figures.
    pub figures: Vec<NamedFigure>,
}

impl Chapter {
    pub(super) fn write(&self, page: &mut Document) -> Result<(), ReproduceError> {
        page.section(&self.heading);
        self.paragraphs.iter().for_each(|text| page.paragraph(text));
        for named in self.tables.iter().filter(|table| !table.caption.is_empty()) {
            page.table(&named.caption, &named.table, named.digits);
        }
        for named in &self.figures {
            page.figure(&named.figure, &named.caption)?;
        }
        Ok(())
    }
}

//! Chapter of the report from another crate.

use super::{NamedFigure, NamedTable, ReproduceError};
use jounce_plot::report::Document;

/// Paragraphs, tables and figures under one heading.
#[derive(Debug, Clone, PartialEq)]
pub struct Chapter {
    /// Heading of the chapter.
    pub heading: String,
    /// Text above the tables and figures.
    pub paragraphs: Vec<String>,
    /// Tables of the chapter; a table without a caption is written to its files and not shown.
    pub tables: Vec<NamedTable>,
    /// Figures of the chapter.
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

//! HTML file with the table of a study and its charts. It needs no server and no other file.
//!
//! The file holds the table as JSON ([`jounce::Table::to_page_element`]), and script and style of the page
//! from `page/study.js` and `page/study.css`. Its content-security policy permits no foreign content.

use jounce::{Error, StudyFolder};

const PAGE: &str = include_str!("../page/study.html");
const SCRIPT: &str = include_str!("../page/study.js");
const STYLE: &str = include_str!("../page/study.css");

/// Returns the page of a finished study under a title. Its table is written if it is missing.
///
/// # Errors
/// [`Error::Study`]: parts that are missing or damaged, a folder that cannot be written.
pub fn study_page(folder: &StudyFolder, title: &str) -> Result<String, Error> {
    let (table, manifest) = folder.merged()?;
    let title = title.replace('&', "&amp;").replace('<', "&lt;");
    // The data come last: what they hold is not replaced.
    Ok(PAGE
        .replace("<!--title-->", &title)
        .replace("<!--style-->", STYLE.trim_end())
        .replace("<!--script-->", SCRIPT.trim_end())
        .replace("<!--table-->", &table.to_page_element(&manifest)))
}

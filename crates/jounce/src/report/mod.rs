//! Reports: one HTML file that holds everything it shows, opens without a network and prints well.
//!
//! [`Document`] has the blocks that a report is made of: headings, paragraphs, tables, figures (inline SVG) and verdicts on claims. It has no scripts
//! and loads nothing; colours follow the reader's light or dark setting, and paper is always light.
mod html;
mod numbers;

pub use html::{Document, Verdict};

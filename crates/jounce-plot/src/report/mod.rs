//! Reports: one self-contained HTML file that opens without a network and can be printed.
//!
//! [`Document`] provides the blocks of a report: headings, paragraphs, tables, figures (inline SVG)
//! and verdicts on claims. It has no scripts and loads no other file. Colours follow the reader's
//! light or dark setting; printed pages are always light.
mod html;
mod numbers;

pub use html::{Document, Verdict};

//! Self-contained HTML document, built from blocks.

use std::fmt::Write as _;
use std::path::Path;

use super::numbers::cell;
use crate::{Figure, PictureError, escape};
use jounce_io::store::{self, StoreError};
use jounce_io::table::{Table, Values};

const STYLE: &str = include_str!("style.css");

/// Report under construction. Texts are plain; text between backticks is formatted as code.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    title: String,
    body: String,
    sections: Vec<String>,
}

/// Verdict on a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The claim holds.
    Holds,
    /// The claim does not hold.
    DoesNotHold,
    /// The evidence is inconclusive.
    Open,
}

impl Verdict {
    /// Returns the text of the badge.
    pub fn words(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::DoesNotHold => "does not hold",
            Self::Open => "open",
        }
    }

    fn class(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::DoesNotHold => "fails",
            Self::Open => "open",
        }
    }
}

impl Document {
    /// Creates an empty report.
    pub fn new(title: &str) -> Self {
        Self {
            title: title.to_owned(),
            body: String::new(),
            sections: Vec::new(),
        }
    }

    /// Starts a section; sections are listed at the top.
    pub fn section(&mut self, heading: &str) {
        self.sections.push(heading.to_owned());
        let _ = writeln!(
            self.body,
            "<h2 id=\"s{}\">{}</h2>",
            self.sections.len(),
            inline(heading)
        );
    }

    /// Starts a subsection.
    pub fn subsection(&mut self, heading: &str) {
        let _ = writeln!(self.body, "<h3>{}</h3>", inline(heading));
    }

    /// Adds a paragraph.
    pub fn paragraph(&mut self, text: &str) {
        let _ = writeln!(self.body, "<p>{}</p>", inline(text));
    }

    /// Adds a list of points.
    pub fn list(&mut self, points: &[&str]) {
        let points: String = points
            .iter()
            .map(|point| format!("<li>{}</li>\n", inline(point)))
            .collect();
        let _ = writeln!(self.body, "<ul>\n{points}</ul>");
    }

    /// Adds a table under a caption, with `digits` significant digits for real numbers. The header
    /// of a column is its description, or its name without one, and its unit.
    pub fn table(&mut self, caption: &str, table: &Table, digits: usize) {
        let _ = write!(
            self.body,
            "<div class=\"wide\"><table>\n<caption>{}</caption>\n<thead><tr>",
            inline(caption)
        );
        for column in table.columns() {
            let heading = if column.about.is_empty() {
                &column.name
            } else {
                &column.about
            };
            let unit = if column.unit.is_empty() {
                String::new()
            } else {
                format!(" <span class=\"unit\">({})</span>", escape(&column.unit))
            };
            let _ = write!(
                self.body,
                "<th{}>{}{unit}</th>",
                side(&column.values),
                inline(heading)
            );
        }
        self.body.push_str("</tr></thead>\n<tbody>\n");
        for row in 0..table.rows() {
            self.body.push_str("<tr>");
            for column in table.columns() {
                let _ = write!(
                    self.body,
                    "<td{}>{}</td>",
                    side(&column.values),
                    cell(&column.values, row, digits)
                );
            }
            self.body.push_str("</tr>\n");
        }
        self.body.push_str("</tbody></table></div>\n");
    }

    /// Adds a figure with a caption, as inline SVG.
    ///
    /// # Errors
    /// The figure cannot be drawn.
    pub fn figure(&mut self, figure: &Figure, caption: &str) -> Result<(), PictureError> {
        let _ = writeln!(
            self.body,
            "<figure>\n{}<figcaption>{}</figcaption>\n</figure>",
            figure.to_svg()?,
            inline(caption)
        );
        Ok(())
    }

    /// Adds a claim with its verdict and evidence.
    pub fn claim(&mut self, claim: &str, verdict: Verdict, evidence: &str) {
        let _ = writeln!(
            self.body,
            "<div class=\"claim\"><p><span class=\"badge {}\">{}</span> {}</p><p class=\"evidence\">{}</p></div>",
            verdict.class(),
            verdict.words(),
            inline(claim),
            inline(evidence)
        );
    }

    /// Returns the complete document.
    pub fn to_html(&self) -> String {
        let title = escape(&self.title);
        let entry = |(index, heading): (usize, &String)| {
            format!(
                "<li><a href=\"#s{}\">{}</a></li>\n",
                index + 1,
                inline(heading)
            )
        };
        let contents: String = self.sections.iter().enumerate().map(entry).collect();
        let contents = if self.sections.len() > 1 {
            format!("<nav><ul>\n{contents}</ul></nav>\n")
        } else {
            String::new()
        };
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n<title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>{title}</h1>\n\
             {contents}{}</main>\n</body>\n</html>\n",
            self.body
        )
    }

    /// Writes the document atomically.
    ///
    /// # Errors
    /// The path is not writable.
    pub fn write(&self, path: &Path) -> Result<(), StoreError> {
        store::write(path, self.to_html().as_bytes())
    }
}

/// Aligns numbers right and words left.
fn side(values: &Values) -> &'static str {
    if matches!(values, Values::Text(_) | Values::Flag(_)) {
        " class=\"words\""
    } else {
        ""
    }
}

/// Escapes text and formats parts between backticks as code.
fn inline(text: &str) -> String {
    let parts: Vec<_> = escape(text).split('`').map(str::to_owned).collect();
    if parts.len() % 2 == 0 {
        return parts.join("`");
    }
    parts
        .iter()
        .enumerate()
        .map(|(i, part)| {
            if i % 2 == 1 {
                format!("<code>{part}</code>")
            } else {
                part.clone()
            }
        })
        .collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::{Axis, Panel, Series};
    use jounce_io::table::Column;

    fn report() -> Document {
        let mut report = Document::new("Report on <harvester> & co");
        report.section("Modes");
        report.paragraph("Set `stop.tip.gap=\"0.5 mm\"`; 1 < 2 & <script>alert('x')</script>.");
        let columns = vec![
            Column::new("mode", "", "Mode", vec![1_u64, 2]),
            Column::new("frequency_hz", "Hz", "Model", vec![8.669_057, f64::NAN]),
            Column::new("note", "", "", vec!["<b>".to_owned(), String::new()]),
        ];
        report.table("Table 2", &Table::new(columns).unwrap(), 4);
        report.section("Figures");
        let panel = Panel::new(Axis::linear("Time", "s"), Axis::linear("Voltage", "V"))
            .with(Series::line(vec![0.0, 1.0], vec![0.0, 1.0]));
        report
            .figure(&Figure::new("Voltage").with(panel), "The voltage.")
            .unwrap();
        report.subsection("Claims");
        report.list(&["one", "two"]);
        report.claim(
            "S2 linear is best near resonance",
            Verdict::Holds,
            "peak at 8.71 Hz",
        );
        report.claim("S4", Verdict::DoesNotHold, "");
        report
    }

    #[test]
    fn the_document_is_well_formed_and_escaped() {
        let html = report().to_html();
        // Except for its first line and the unclosed <meta>, the HTML must also be valid XML: no
        // stray markup.
        let xml = html
            .replacen("<!DOCTYPE html>", "", 1)
            .replace("scale=1\">", "scale=1\"/>")
            .replace("utf-8\">", "utf-8\"/>")
            .replace("dark\">", "dark\"/>");
        let document = resvg::usvg::roxmltree::Document::parse(&xml).unwrap();
        let texts = |name: &str| {
            let elements = document
                .descendants()
                .filter(|node| node.has_tag_name(name));
            elements
                .map(|node| {
                    node.descendants()
                        .filter_map(|n| n.text().filter(|_| n.is_text()))
                        .collect::<String>()
                })
                .collect::<Vec<_>>()
        };
        assert_eq!(texts("h1"), ["Report on <harvester> & co"]);
        assert_eq!(texts("td"), ["1", "8.669", "<b>", "2", "–", ""]);
        assert_eq!(texts("th"), ["Mode", "Model (Hz)", "note"]);
        assert_eq!(texts("code"), ["stop.tip.gap=\"0.5 mm\""]);
        assert_eq!(texts("a"), ["Modes", "Figures"]);
        assert!(
            html.contains("<span class=\"badge holds\">holds</span>")
                && html.contains("<span class=\"badge fails\">does not hold</span>")
        );
    }

    #[test]
    fn nothing_is_run_or_loaded() {
        let html = report().to_html();
        assert!(
            !html.contains("<script")
                && !html.contains("src=")
                && !html.contains("@import")
                && !html.contains("url(")
        );
        let links = html.matches("http").count();
        assert_eq!(
            links,
            html.matches("http://www.w3.org/2000/svg").count(),
            "only the name of the SVG format looks like an address"
        );
    }

    #[test]
    fn a_lone_backtick_stays() {
        assert_eq!(inline("a ` b"), "a ` b");
        assert_eq!(inline("`a`"), "<code>a</code>");
    }
}

//! LabVIEW measurement files (LVM): text with a header of the file and a header of each segment.
//!
//! Source: National Instruments, "LabVIEW Measurement File (LVM) Format". The stamps of the data win over the header: programs that thin out
//! a record often leave its `Delta_X` and `Samples` behind.

use std::fs::File;
use std::io::{BufReader, Read as _};
use std::path::Path;

use super::contents::Found;
use super::decibels::Decibels;
use super::error::Damage;
use super::raw::{Column, Raw, Stamps};
use super::shelf::Shelf;
use super::text::{Delimiter, Layout, Rows, columns, decoded};
use crate::recording::{Finding, FindingKind, Over, Place, Series};

const HEAD_BYTES: u64 = 1 << 18;
/// How far a step of the header may lie from that of the stamps, relative.
const SAME_STEP: f64 = 1e-3;

pub(super) fn read(path: &Path, shelf: &Shelf) -> Result<Found, Damage> {
    let told = |fault: std::io::Error| Damage::new(fault.to_string());
    let mut head = Vec::new();
    File::open(path).map_err(told)?.take(HEAD_BYTES).read_to_end(&mut head).map_err(told)?;
    let (head, _) = decoded(&head);
    let header = Header::read(&head)?;
    let file = File::open(path).map_err(told)?;
    let size = file.metadata().map_err(told)?.len();
    let Rows { columns, findings } = columns(BufReader::with_capacity(1 << 20, file), size, &header.layout, shelf)?;
    header.segment(columns, findings).map(Found::from)
}

/// What the two headers say.
struct Header {
    layout: Layout,
    x_columns: String,
    samples: Option<usize>,
    step: Option<f64>,
    start: f64,
    units: Vec<String>,
}

impl Header {
    fn read(head: &str) -> Result<Self, Damage> {
        let lines: Vec<&str> = head.lines().collect();
        let heads = lines.iter().position(|line| line.starts_with("X_Value"));
        let heads = heads
            .ok_or_else(|| Damage::at(Place::Line(lines.len()), "no line of column heads (X_Value ...) follows; was the file cut?"))?;
        let separator = if value(&lines[..heads], "Separator") == Some("Comma") { b',' } else { b'\t' };
        let decimal_comma = value(&lines[..heads], "Decimal_Separator") == Some(",");
        let delimiter = Delimiter::Byte(separator);
        let number = |text: &str| text.trim().replace(',', ".").parse::<f64>().ok();
        let fields = |key: &str| -> Vec<String> {
            let line = lines[..heads].iter().rev().find(|line| line.split(char::from(separator)).next() == Some(key));
            line.map(|line| line.split(char::from(separator)).skip(1).map(|field| field.trim().to_owned()).collect()).unwrap_or_default()
        };
        let mut names: Vec<String> = lines[heads].split(char::from(separator)).map(|name| name.trim().to_owned()).collect();
        while names.len() > 1 && names.last().is_some_and(|name| name.is_empty() || name == "Comment") {
            names.pop();
        }
        Ok(Self {
            x_columns: value(&lines[..heads], "X_Columns").unwrap_or("One").to_owned(),
            samples: fields("Samples").first().and_then(|text| text.parse().ok()),
            step: fields("Delta_X").first().and_then(|text| number(text)),
            start: fields("X0").first().and_then(|text| number(text)).unwrap_or(0.0),
            units: fields("Y_Unit_Label"),
            layout: Layout {
                delimiter,
                decimal_comma,
                skip: heads + 1,
                heads: names.into_iter().map(|name| (name, String::new())).collect(),
                doubts: Vec::new(),
            },
        })
    }

    /// The columns as one data set.
    fn segment(&self, columns: Vec<Column>, mut findings: Vec<Finding>) -> Result<Raw, Damage> {
        let rows = columns.first().map_or(0, |column| column.values.count());
        let is_x = |column: &Column| column.name == "X_Value";
        let (x, mut columns): (Vec<Column>, Vec<Column>) = columns.into_iter().partition(is_x);
        let x = x.into_iter().next().map_or_else(|| Vec::new().into(), |column| column.values);
        if columns.is_empty() || rows < 2 {
            return Err(Damage::at(
                Place::Line(self.layout.skip),
                format!("{rows} rows of {} channels follow; at least two rows of one are due", columns.len()),
            ));
        }
        for (column, unit) in columns.iter_mut().zip(&self.units) {
            column.unit.clone_from(unit);
        }
        if let Some(samples) = self.samples.filter(|samples| *samples != rows) {
            let about = format!("the header says {samples} samples, {rows} follow");
            findings.push(Finding::new(FindingKind::HeaderDisagrees, samples.abs_diff(rows), None, about));
        }
        let mut whole = true;
        x.each(|x| whole &= x.is_finite())?;
        let stamps = if self.x_columns == "No" || !whole {
            let step = self.step.ok_or_else(|| Damage::new("neither a column X_Value nor a Delta_X tells when the samples were taken"))?;
            Stamps::Even { start: self.start, step }
        } else {
            findings.extend(self.rescaled(x.count(), x.ends()?));
            Stamps::Given(x)
        };
        let over = if columns.iter().all(|column| column.name.contains("FFT")) { Over::Frequency } else { Over::Time };
        if over == Over::Frequency {
            let about = "the channels are spectra by their names; the first column is taken as frequency in Hz, whatever X_Dimension says";
            findings.push(Finding::new(FindingKind::HeaderDisagrees, 1, None, about.to_owned()));
            // An amplitude is never negative: such a spectrum holds levels.
            for column in &mut columns {
                let mut negative = false;
                column.values.each(|x| negative |= x < 0.0)?;
                let levels = Decibels::meant(&column.unit).filter(|_| negative);
                findings.extend(levels.map(|levels| column.made_linear(levels)));
            }
        }
        Ok(Raw { title: String::new(), over, stamps, columns, findings })
    }

    /// A step of the header that is not that of the stamps.
    fn rescaled(&self, count: usize, ends: Option<(f64, f64)>) -> Option<Finding> {
        let (first, last) = ends?;
        let step = (last - first) / (count - 1) as f64;
        let told = self.step.filter(|told| (told / step - 1.0).abs() > SAME_STEP)?;
        let about = format!(
            "the header says Delta_X = {told:.6e}, the stamps are {step:.6e} apart ({:.4} times as much); the stamps are used",
            step / told
        );
        Some(Finding::new(FindingKind::RescaledStamps, count, Some(Place::Line(self.layout.skip + 1)), about))
    }
}

/// The first value of a key of the header.
fn value<'a>(lines: &[&'a str], key: &str) -> Option<&'a str> {
    let line = lines.iter().find(|line| line.starts_with(key) && line[key.len()..].starts_with(['\t', ',']))?;
    line[key.len() + 1..].split('\t').next().map(str::trim)
}

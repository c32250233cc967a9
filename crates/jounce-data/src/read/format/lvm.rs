//! LabVIEW measurement files (LVM): text with a header of the file and a header of each segment.
//!
//! With `X_Columns` `Multi`, a column of times precedes each channel. Header entries of a channel
//! are above its values, not above its times.
//!
//! Source: National Instruments, "LabVIEW Measurement File (LVM) Format". If the stamps agree with
//! `Delta_X` within their digits, `Delta_X` is the step. Otherwise the stamps are used: programs
//! that decimate a record often leave its `Delta_X` and `Samples` unchanged.

use std::fs::File;
use std::io::{BufReader, Read as _};
use std::path::Path;

use super::text::{
    ColumnHead, Delimiter, Preamble, Rows, TextLayout, columns, complete_lines, decoded, line_end,
};
use crate::read::column::numbers::ColumnNumbers;
use crate::read::column::raw::{Header as HeaderTime, Rate, Raw, RawColumn, TimeStamps};
use crate::read::column::samples::SampleStore;
use crate::read::contents::FormatContents;
use crate::read::error::Damage;
use crate::read::heading::decibels::Decibels;
use crate::recording::{Issue, IssueKind, IssuePlace, Over, Series};

const HEAD_BYTES: u64 = 1 << 18;
/// Headings of a time column and of a comment column.
const X_VALUE: &str = "X_Value";
const COMMENT: &str = "Comment";
/// Maximum relative difference between the steps of header and stamps.
const SAME_STEP: f64 = 1e-3;

pub(in crate::read) fn read(path: &Path, store: &SampleStore) -> Result<FormatContents, Damage> {
    let io_error = |fault: std::io::Error| Damage::new(fault.to_string());
    let mut head = Vec::new();
    File::open(path)
        .map_err(io_error)?
        .take(HEAD_BYTES)
        .read_to_end(&mut head)
        .map_err(io_error)?;
    let end = line_end(&head);
    let (head, _) = decoded(&head);
    let header = Header::read(&head, end)?;
    let file = File::open(path).map_err(io_error)?;
    let size = file.metadata().map_err(io_error)?.len();
    let Rows { columns, issues } = columns(
        BufReader::with_capacity(1 << 20, file),
        size,
        &header.layout,
        store,
    )?;
    let (sets, issues) = header.sets(columns, issues, store)?;
    Ok(FormatContents {
        sets,
        shapes: Vec::new(),
        issues,
    })
}

/// Channels with their column numbers.
type Members = Vec<(usize, RawColumn)>;

/// Contents of the two headers.
struct Header {
    layout: TextLayout,
    /// Keys of the segment with their values, one for each data column.
    fields: Vec<(String, Vec<String>)>,
    x_columns: String,
}

impl Header {
    fn read(head: &str, end: u8) -> Result<Self, Damage> {
        let lines = complete_lines(head, end, true);
        let heads = lines.iter().position(|line| line.starts_with(X_VALUE));
        let heads = heads.ok_or_else(|| {
            Damage::at(
                IssuePlace::Line(lines.len()),
                "no line of column headings (X_Value ...) follows; is the file truncated?",
            )
        })?;
        let separator = if value(&lines[..heads], "Separator") == Some("Comma") {
            ','
        } else {
            '\t'
        };
        let decimal_comma = value(&lines[..heads], "Decimal_Separator") == Some(",");
        let parts = |line: &str| -> Vec<String> {
            line.split(separator)
                .map(|field| field.trim().to_owned())
                .collect()
        };
        let mut names = parts(lines[heads]);
        while names.len() > 1 && names.last().is_some_and(String::is_empty) {
            names.pop();
        }
        let min_fields = names
            .iter()
            .rposition(|name| name != COMMENT && !name.is_empty())
            .map_or(1, |last| last + 1);
        let head = |name: String| ColumnHead {
            blank: name == COMMENT || name.is_empty(),
            name,
            ..ColumnHead::default()
        };
        let segment = lines[..heads]
            .iter()
            .rposition(|line| line.split(separator).next() == Some("Channels"))
            .unwrap_or(0);
        let field = |line: &&str| {
            let fields = parts(line);
            (fields.first().cloned().unwrap_or_default(), fields)
        };
        Ok(Self {
            x_columns: value(&lines[..heads], "X_Columns")
                .unwrap_or("One")
                .to_owned(),
            fields: lines[segment..heads].iter().map(field).collect(),
            layout: TextLayout {
                delimiter: Delimiter::Byte(separator as u8),
                decimal_comma,
                line_end: end,
                skip: heads + 1,
                min_fields,
                heads: names.into_iter().map(head).collect(),
                preamble: Preamble::default(),
                issues: Vec::new(),
            },
        })
    }

    /// Returns the value of a key for a column. It is normally in that column; some programs
    /// reserve no columns for times and write the values consecutively.
    fn value(&self, key: &str, column: usize) -> Option<&str> {
        let (_, fields) = self.fields.iter().rev().find(|(name, _)| name == key)?;
        let names = || {
            self.layout
                .heads
                .iter()
                .map(|head| head.name.as_str())
                .enumerate()
        };
        let packed = names().any(|(k, name)| {
            k > 0 && name == X_VALUE && fields.get(k).is_some_and(|field| !field.is_empty())
        });
        let channel = names()
            .take(column)
            .filter(|(_, name)| *name != X_VALUE)
            .count()
            + 1;
        fields
            .get(if packed { channel } else { column })
            .map(String::as_str)
            .filter(|text| !text.is_empty())
    }

    fn number(&self, key: &str, column: usize) -> Option<f64> {
        // A value shared by all channels may be given once.
        let text = self.value(key, column).or_else(|| self.value(key, 1))?;
        text.replace(',', ".")
            .parse::<f64>()
            .ok()
            .filter(|number| number.is_finite())
    }

    /// Groups channels by their times: one set for channels that share them.
    fn sets(
        &self,
        columns: Vec<RawColumn>,
        issues: Vec<Issue>,
        store: &SampleStore,
    ) -> Result<(Vec<Raw>, Vec<Issue>), Damage> {
        let rows = columns.first().map_or(0, |column| column.values.count());
        let channels = columns
            .iter()
            .filter(|column| {
                column.name != X_VALUE && column.name != COMMENT && !column.name.is_empty()
            })
            .count();
        if channels == 0 || rows < 2 {
            let why = format!(
                "{rows} rows of {channels} channels follow; at least two rows of one channel are \
                needed"
            );
            return Err(Damage::at(IssuePlace::Line(self.layout.skip), why));
        }
        let mut groups: Vec<(Option<ColumnNumbers>, Members)> = vec![(None, Vec::new())];
        for (k, mut column) in columns.into_iter().enumerate() {
            match column.name.as_str() {
                X_VALUE => groups.push((Some(column.values), Vec::new())),
                COMMENT | "" => {}
                _ => {
                    column.unit = self.value("Y_Unit_Label", k).unwrap_or_default().to_owned();
                    if let Some((_, members)) = groups.last_mut() {
                        members.push((k, column));
                    }
                }
            }
        }
        let mut sets: Vec<(Option<ColumnNumbers>, Members)> = Vec::new();
        for (x, members) in groups
            .into_iter()
            .filter(|(_, members)| !members.is_empty())
        {
            let mut matching = None;
            for (at, (other, _)) in sets.iter().enumerate() {
                let equal = match (&x, other) {
                    (Some(a), Some(b)) => a.equals(b)?,
                    (a, b) => a.is_none() && b.is_none(),
                };
                matching = matching.or(equal.then_some(at));
            }
            match matching.and_then(|at| sets.get_mut(at)) {
                Some((_, all)) => all.extend(members),
                None => sets.push((x, members)),
            }
        }
        let (is_single_set, mut issues) = (sets.len() == 1, issues);
        let mut found = Vec::new();
        for (x, members) in sets {
            let set_issues = if is_single_set {
                std::mem::take(&mut issues)
            } else {
                Vec::new()
            };
            found.push(self.set(x, members, set_issues, store)?);
        }
        Ok((found, issues))
    }

    /// Builds the set of channels over one time column.
    fn set(
        &self,
        x: Option<ColumnNumbers>,
        members: Members,
        mut issues: Vec<Issue>,
        store: &SampleStore,
    ) -> Result<Raw, Damage> {
        let first = members.first().map_or(1, |(k, _)| *k);
        let (x, members) = trim_padding(x, members, store)?;
        let rows = members
            .first()
            .map_or(0, |(_, column)| column.values.count());
        let mut columns: Vec<RawColumn> = members.into_iter().map(|(_, column)| column).collect();
        if rows < 2 {
            let name = columns
                .first()
                .map_or(String::new(), |column| column.name.clone());
            return Err(Damage::at(
                IssuePlace::Line(self.layout.skip),
                format!("{rows} rows of {name} follow; at least two are needed"),
            ));
        }
        if let Some(samples) = self
            .value("Samples", first)
            .and_then(|text| text.parse::<usize>().ok())
            .filter(|samples| *samples != rows)
        {
            let message = format!("the header specifies {samples} samples, but {rows} follow");
            issues.push(Issue::new(
                IssueKind::HeaderDisagrees,
                samples.abs_diff(rows),
                None,
                message,
            ));
        }
        let step = self.number("Delta_X", first).filter(|step| *step > 0.0);
        let start = self.number("X0", first).unwrap_or(0.0);
        let is_complete = x.as_ref().map(is_finite).transpose()?.unwrap_or(false);
        let stamps = match (x.filter(|_| self.x_columns != "No" && is_complete), step) {
            (Some(x), Some(step)) => {
                issues.extend(self.rescaling_issue(step, x.count(), x.first_and_last()?));
                // Of two steps that agree with the stamps, use the one set in the header.
                let rate = Rate {
                    source: format!("Delta_X = {step}"),
                    rate_hz: 1.0 / step,
                };
                if issues
                    .iter()
                    .any(|issue| issue.kind == IssueKind::RescaledStamps)
                {
                    TimeStamps::Explicit(x)
                } else {
                    TimeStamps::Header(HeaderTime {
                        rate,
                        start,
                        stamps: Some(x),
                    })
                }
            }
            (Some(x), None) => TimeStamps::Explicit(x),
            (None, Some(step)) => TimeStamps::Even { start, step },
            (None, None) => {
                return Err(Damage::new(
                    "neither a column X_Value nor a Delta_X gives the sampling times",
                ));
            }
        };
        let over = if columns.iter().all(|column| column.name.contains("FFT")) {
            Over::Frequency
        } else {
            Over::Time
        };
        if over == Over::Frequency {
            issues.extend(convert_levels(&mut columns)?);
        }
        Ok(Raw {
            title: String::new(),
            over,
            stamps,
            columns,
            issues,
        })
    }

    /// Reports a step of the header that differs from the step of the stamps.
    fn rescaling_issue(
        &self,
        stated_step: f64,
        count: usize,
        ends: Option<(f64, f64)>,
    ) -> Option<Issue> {
        let (first, last) = ends?;
        let step = (last - first) / (count - 1) as f64;
        let stated_step =
            Some(stated_step).filter(|stated_step| (stated_step / step - 1.0).abs() > SAME_STEP)?;
        let message = format!(
            "the header specifies Delta_X = {stated_step:.6e}, but the stamps are {step:.6e} apart \
            ({:.4} times as much); the stamps are used",
            step / stated_step
        );
        Some(Issue::new(
            IssueKind::RescaledStamps,
            count,
            Some(IssuePlace::Line(self.layout.skip + 1)),
            message,
        ))
    }
}

/// Converts spectra in levels to linear values, and reports spectra.
fn convert_levels(columns: &mut [RawColumn]) -> Result<Vec<Issue>, Damage> {
    let message = "the channels are spectra by their names; the first column is used as frequency \
        in Hz, whatever X_Dimension specifies";
    let mut issues = vec![Issue::new(
        IssueKind::HeaderDisagrees,
        1,
        None,
        message.to_owned(),
    )];
    // Amplitudes are never negative, so a spectrum with negative values contains levels.
    for column in columns {
        let mut negative = false;
        column.values.each(|x| negative |= x < 0.0)?;
        let levels = Decibels::read_or_linear(&column.unit).filter(|_| negative);
        issues.extend(levels.map(|levels| column.convert_levels(levels)));
    }
    Ok(issues)
}

fn is_finite(x: &ColumnNumbers) -> Result<bool, Damage> {
    let mut is_finite = true;
    x.each(|x| is_finite &= x.is_finite())?;
    Ok(is_finite)
}

/// Cuts channels at the row where their time column ends; lengths of channels may differ.
fn trim_padding(
    x: Option<ColumnNumbers>,
    members: Members,
    store: &SampleStore,
) -> Result<(Option<ColumnNumbers>, Members), Damage> {
    let Some(times) = x else {
        return Ok((None, members));
    };
    let (mut number, mut last) = (0, 0);
    times.each(|t| {
        number += 1;
        last = if t.is_finite() { number } else { last };
    })?;
    // Without any time, the header gives the times of all samples.
    if last == number || last == 0 {
        return Ok((Some(times), members));
    }
    let truncate = |numbers: ColumnNumbers| -> Result<ColumnNumbers, Damage> {
        let (mut truncated, mut remaining, mut result) = (store.column(), last, Ok(()));
        numbers.each(|x| {
            if remaining > 0 && result.is_ok() {
                result = truncated.push(x);
                remaining -= 1;
            }
        })?;
        result?;
        Ok(truncated)
    };
    let truncate_column = |(k, column): (usize, RawColumn)| {
        let imaginary = column.imaginary.map(truncate).transpose()?;
        Ok((
            k,
            RawColumn {
                values: truncate(column.values)?,
                imaginary,
                ..RawColumn::new(&column.name, &column.unit, Vec::new().into())
            },
        ))
    };
    Ok((
        Some(truncate(times)?),
        members
            .into_iter()
            .map(truncate_column)
            .collect::<Result<_, Damage>>()?,
    ))
}

/// Returns the first value of a key of the header.
fn value<'a>(lines: &[&'a str], key: &str) -> Option<&'a str> {
    let line = lines
        .iter()
        .find(|line| line.starts_with(key) && line[key.len()..].starts_with(['\t', ',']))?;
    line[key.len() + 1..].split('\t').next().map(str::trim)
}

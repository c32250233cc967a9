//! Groups the channels of a file by their times.

use super::header::{COMMENT, Header, X_VALUE};
use crate::read::column::numbers::ColumnNumbers;
use crate::read::column::raw::{Header as HeaderTime, Rate, Raw, RawColumn, TimeStamps};
use crate::read::column::samples::SampleStore;
use crate::read::error::Damage;
use crate::read::heading::decibels::Decibels;
use crate::recording::{Issue, IssueKind, IssuePlace, Over, Series as _};

/// Maximum relative difference between the steps of header and stamps.
const SAME_STEP: f64 = 1e-3;

/// Channels with their column numbers.
type Members = Vec<(usize, RawColumn)>;

/// Channels that follow a column of times, with these times.
type Group = (Option<ColumnNumbers>, Members);

impl Header {
    /// Groups channels by their times: one set for channels that share them.
    pub(super) fn sets(
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
        let mut groups: Vec<Group> = vec![(None, Vec::new())];
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
        let sets = merged(groups)?;
        let (is_single_set, mut issues) = (sets.len() == 1, issues);
        let mut found = Vec::new();
        for group in sets {
            let set_issues = if is_single_set {
                std::mem::take(&mut issues)
            } else {
                Vec::new()
            };
            found.push(self.set(group, set_issues, store)?);
        }
        Ok((found, issues))
    }

    /// Builds the set of channels over one time column.
    fn set(
        &self,
        (x, members): Group,
        mut issues: Vec<Issue>,
        store: &SampleStore,
    ) -> Result<Raw, Damage> {
        let first = members.first().map_or(1, |(k, _)| *k);
        let (x, members) = trim_padding((x, members), store)?;
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
        issues.extend(self.count_issue(first, rows));
        let stamps = self.stamps(x, first, &mut issues)?;
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

    /// Reports a number of samples in the header that differs from the number of rows.
    fn count_issue(&self, column: usize, rows: usize) -> Option<Issue> {
        let samples = self
            .value("Samples", column)
            .and_then(|text| text.parse::<usize>().ok())
            .filter(|samples| *samples != rows)?;
        let message = format!("the header specifies {samples} samples, but {rows} follow");
        Some(Issue::new(
            IssueKind::HeaderDisagrees,
            samples.abs_diff(rows),
            None,
            message,
        ))
    }

    /// Sampling times of the channel in a column, from their stamps and the header.
    fn stamps(
        &self,
        x: Option<ColumnNumbers>,
        column: usize,
        issues: &mut Vec<Issue>,
    ) -> Result<TimeStamps, Damage> {
        let step = self.number("Delta_X", column).filter(|step| *step > 0.0);
        let start = self.number("X0", column).unwrap_or(0.0);
        let is_complete = x.as_ref().map(is_finite).transpose()?.unwrap_or(false);
        match (x.filter(|_| self.x_columns != "No" && is_complete), step) {
            (Some(x), Some(step)) => {
                let rescaled = self.rescaling_issue(step, x.count(), x.first_and_last()?);
                if rescaled.is_some() {
                    issues.extend(rescaled);
                    return Ok(TimeStamps::Explicit(x));
                }
                // Of two steps that agree with the stamps, use the one set in the header.
                let rate = Rate {
                    source: format!("Delta_X = {step}"),
                    rate_hz: 1.0 / step,
                };
                Ok(TimeStamps::Header(HeaderTime {
                    rate,
                    start,
                    stamps: Some(x),
                }))
            }
            (Some(x), None) => Ok(TimeStamps::Explicit(x)),
            (None, Some(step)) => Ok(TimeStamps::Even { start, step }),
            (None, None) => Err(Damage::new(
                "neither a column X_Value nor a Delta_X gives the sampling times",
            )),
        }
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

/// Merges the groups of channels over equal times.
fn merged(groups: Vec<Group>) -> Result<Vec<Group>, Damage> {
    let mut sets: Vec<Group> = Vec::new();
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
    Ok(sets)
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
fn trim_padding((x, members): Group, store: &SampleStore) -> Result<Group, Damage> {
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

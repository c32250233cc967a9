//! Header of data set 58: eleven lines of fixed columns.

use super::blocks::Block;
use crate::read::error::Damage;
use crate::recording::IssuePlace;

/// Kind of a function and layout of its numbers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Header {
    pub title: String,
    pub function: u32,
    pub response: Dof,
    pub reference: Dof,
    pub is_double: bool,
    pub complex: bool,
    pub points: usize,
    pub is_uniform: bool,
    pub start: f64,
    pub step: f64,
    pub abscissa: Axis,
    pub ordinate: Axis,
    pub denominator: Axis,
}

/// Name, node and direction of a degree of freedom.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Dof {
    pub name: String,
    pub node: i64,
    pub direction: i64,
}

/// Quantity of an axis.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axis {
    pub kind: u32,
    pub label: String,
    pub unit: String,
}

/// Header lines of data set 58.
pub(super) const LINES: usize = 11;

impl Header {
    pub(super) fn read(block: &Block) -> Result<Self, Damage> {
        let damage = |line: usize, why: String| {
            Damage::at(
                IssuePlace::Byte(block.start),
                format!("line {} of the data set: {why}", line + 1),
            )
        };
        if block.lines.len() < LINES {
            return Err(damage(
                block.lines.len(),
                format!("its header has {LINES} lines; is the file truncated?"),
            ));
        }
        let dofs = dofs(&block.lines[5]).ok_or_else(|| {
            damage(
                5,
                format!("no function at degrees of freedom: {:?}", block.lines[5]),
            )
        })?;
        let (function, response, reference) = dofs;
        let mut form = Vec::new();
        let read = super::numbers::numbers(&block.lines[6], &mut form);
        let [kind, points, even, start, step, ..] = form[..] else {
            let why = read
                .err()
                .map_or_else(String::new, |word| format!("; {word:?} is not a number"));
            return Err(damage(
                6,
                format!("expected type, number of points, spacing, start and step{why}"),
            ));
        };
        let kind_known = [2.0, 4.0, 5.0, 6.0].contains(&kind);
        if !kind_known || points < 0.0 || points.fract() != 0.0 || points > 1e12 {
            return Err(damage(
                6,
                format!("{points} points of type {kind}: types 2, 4, 5 and 6 can be read"),
            ));
        }
        let title = block.lines[..5]
            .iter()
            .map(|line| line.trim())
            .find(|line| !line.is_empty() && *line != "NONE");
        Ok(Self {
            title: title.unwrap_or_default().to_owned(),
            function,
            response,
            reference,
            is_double: kind == 4.0 || kind == 6.0,
            complex: kind >= 5.0,
            points: points as usize,
            is_uniform: even == 1.0,
            start,
            step,
            abscissa: axis(&block.lines[7]),
            ordinate: without_truncation(axis(&block.lines[8]), block.lines[3].trim()),
            denominator: axis(&block.lines[9]),
        })
    }

    /// Number of values per point.
    pub(super) fn width(&self) -> usize {
        usize::from(!self.is_uniform) + 1 + usize::from(self.complex)
    }
}

/// Columns `from..to` of a line, by characters.
fn columns(line: &str, from: usize, to: usize) -> String {
    line.chars()
        .skip(from)
        .take(to - from)
        .collect::<String>()
        .trim()
        .to_owned()
}

/// Parses `2(I5,I10),2(1X,10A1,I10,I4)`; lines of programs that ignore the columns are split into
/// words.
fn dofs(line: &str) -> Option<(u32, Dof, Dof)> {
    let fixed = |from: usize| {
        let number = |a: usize, b: usize| columns(line, from + a, from + b).parse::<i64>().ok();
        Some(Dof {
            name: columns(line, from + 1, from + 11),
            node: number(11, 21)?,
            direction: number(21, 25)?,
        })
    };
    let function = columns(line, 0, 5)
        .parse::<u32>()
        .ok()
        .or_else(|| line.split_whitespace().next()?.parse().ok())?;
    if let (Some(response), Some(reference)) = (fixed(30), fixed(55)) {
        return Some((function, response, reference));
    }
    let words: Vec<&str> = line.split_whitespace().collect();
    let by_words = |from: usize| {
        let number = |k: usize| words.get(from + k)?.parse::<i64>().ok();
        Some(Dof {
            name: (*words.get(from)?).to_owned(),
            node: number(1)?,
            direction: number(2)?,
        })
    };
    Some((function, by_words(4)?, by_words(7)?))
}

/// Width of a label.
const LABEL: usize = 20;

/// Restores a label that was truncated at its width: the fourth line may contain the complete name,
/// as in files of jounce.
fn without_truncation(axis: Axis, full_text: &str) -> Axis {
    let label_start: String = full_text.chars().take(LABEL).collect();
    let is_truncated = full_text.chars().count() > LABEL && label_start.trim_end() == axis.label;
    if is_truncated {
        Axis {
            label: full_text.to_owned(),
            ..axis
        }
    } else {
        axis
    }
}

/// Parses `I10,3I5,2(1X,20A1)`.
fn axis(line: &str) -> Axis {
    let kind = line
        .split_whitespace()
        .next()
        .and_then(|word| word.parse().ok())
        .unwrap_or(0);
    let unless_none = |text: String| if text == "NONE" { String::new() } else { text };
    Axis {
        kind,
        label: unless_none(columns(line, 26, 46)),
        unit: unless_none(columns(line, 47, 67)),
    }
}

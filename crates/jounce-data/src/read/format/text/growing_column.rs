//! Column of a text that grows row by row.

use std::io;

use super::ColumnHead;
use super::moment::{Clock, Moment};
use super::number::TextField;
use crate::read::column::numbers::ColumnNumbers;
use crate::read::column::raw::RawColumn;
use crate::read::column::samples::SampleStore;
use crate::recording::{Issue, IssueKind, Series as _};

/// Growing column, with the types of its fields.
pub(super) struct GrowingColumn {
    pub numbers: ColumnNumbers,
    /// Imaginary parts of a column that had a complex number.
    imaginary: Option<ColumnNumbers>,
    /// Clock of a column of moments, and its first moment.
    clock: Option<(Clock, Moment)>,
    /// Count of numbers.
    filled: usize,
    /// True once a moment differs from the first one.
    changes: bool,
}

impl GrowingColumn {
    /// Column without numbers.
    pub(super) fn new(store: &SampleStore) -> Self {
        Self {
            numbers: store.column(),
            imaginary: None,
            clock: None,
            filled: 0,
            changes: false,
        }
    }

    /// Appends a field to the column.
    pub(super) fn push(
        &mut self,
        field: Option<&TextField>,
        store: &SampleStore,
    ) -> io::Result<()> {
        let (re, im) = match (field, &mut self.clock) {
            (Some(TextField::Real(value)), None) => (*value, 0.0),
            (Some(TextField::Complex(re, im)), None) => (*re, *im),
            (Some(TextField::Moment(moment)), Some((clock, first))) => {
                self.changes |= moment != first;
                (clock.seconds(*moment), 0.0)
            }
            (Some(TextField::Moment(moment)), None) if self.filled == 0 => {
                self.clock = Some((Clock::from(*moment), *moment));
                (0.0, 0.0)
            }
            _ => (f64::NAN, f64::NAN),
        };
        self.filled += usize::from(!re.is_nan());
        if matches!(field, Some(TextField::Complex(..))) && self.imaginary.is_none() {
            let mut zeros = store.column();
            (0..self.numbers.count()).try_for_each(|_| zeros.push(0.0))?;
            self.imaginary = Some(zeros);
        }
        self.numbers.push(re)?;
        self.imaginary
            .as_mut()
            .map_or(Ok(()), |imaginary| imaginary.push(im))
    }

    /// Returns the column under its heading. An empty column or a constant date is not a channel.
    pub(super) fn into_column(self, head: &ColumnHead, issues: &mut Vec<Issue>) -> RawColumn {
        let mut column = RawColumn {
            imaginary: self.imaginary,
            ..RawColumn::new(&head.name, &head.unit, self.numbers)
        };
        if let Some((_, first)) = self.clock {
            "s".clone_into(&mut column.unit);
            if self.changes {
                let message = format!(
                    "dates and times of day were converted to seconds since the first, \
                        {first}"
                );
                issues.push(
                    Issue::new(IssueKind::Converted, self.filled, None, message).of(&head.name),
                );
            } else {
                column.left_out = Some(format!("{first} is in all rows"));
            }
        } else if self.filled == 0 && head.blank {
            column.left_out = Some(if head.has_no_name {
                String::new()
            } else {
                "no row has a number in it".to_owned()
            });
        }
        column
    }
}

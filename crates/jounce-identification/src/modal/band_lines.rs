//! Lines of a band, and measured responses at them as displacements.

use jounce_linalg::c64;

use super::ModalError;
use jounce_signal::spectral::LeaveOneOutResponse;

/// Change by leaving out a part of the blocks.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LeaveOneOutChange {
    /// Share of the blocks that is left out.
    pub share: f64,
    /// Index of the force location of the blocks.
    pub position: usize,
    /// Change of the displacement per force: response, line. Empty for the responses to a force at
    /// another location.
    pub change: Vec<Vec<c64>>,
}

/// Measured quantity of one response at each line.
pub(super) struct MeasuredResponse<'a> {
    pub value: &'a [c64],
    /// Real and imaginary part together.
    pub variance: Option<Vec<f64>>,
    /// Power of `j w` from displacement per force, or per acceleration of the base, to the measured
    /// quantity.
    pub power: i32,
    pub leave_one_out: &'a [LeaveOneOutResponse],
    /// Index of the force location of the response.
    pub position: usize,
}

/// Checks that there are responses to every input, all with the expected number of lines.
pub(super) fn check_lengths(
    measured: &[MeasuredResponse<'_>],
    inputs: usize,
    expected: usize,
) -> Result<(), ModalError> {
    if measured.is_empty() || inputs == 0 || !measured.len().is_multiple_of(inputs.max(1)) {
        return Err(ModalError::Lengths {
            response: measured.len(),
            lines: 0,
            expected,
        });
    }
    for (k, function) in measured.iter().enumerate() {
        if function.value.len() != expected {
            return Err(ModalError::Lengths {
                response: k + 1,
                lines: function.value.len(),
                expected,
            });
        }
    }
    Ok(())
}

/// Lines of a band.
pub(super) struct BandLines<'a> {
    /// Frequencies of all measured lines, Hz.
    frequency_hz: &'a [f64],
    /// Indices of the lines of the band.
    indices: Vec<usize>,
}

impl<'a> BandLines<'a> {
    /// Lines above 0 between two frequencies.
    pub fn between(frequency_hz: &'a [f64], low_hz: f64, high_hz: f64) -> Self {
        let indices = (0..frequency_hz.len())
            .filter(|k| frequency_hz[*k] > 0.0 && (low_hz..=high_hz).contains(&frequency_hz[*k]))
            .collect();
        Self {
            frequency_hz,
            indices,
        }
    }

    pub fn frequencies_hz(&self) -> Vec<f64> {
        self.indices.iter().map(|k| self.frequency_hz[*k]).collect()
    }

    /// First line at which a response is not finite, Hz.
    pub fn first_not_finite_hz(&self, function: &MeasuredResponse<'_>) -> Option<f64> {
        let is_not_finite = |k: &&usize| {
            !(function.value[**k].re.is_finite() && function.value[**k].im.is_finite())
        };
        self.indices
            .iter()
            .find(is_not_finite)
            .map(|k| self.frequency_hz[*k])
    }

    /// Factor from the measured quantity to the displacement at a line.
    fn to_displacement(&self, function: &MeasuredResponse<'_>, k: usize) -> c64 {
        c64::new(0.0, std::f64::consts::TAU * self.frequency_hz[k]).powi(-function.power)
    }

    pub fn displacement(&self, function: &MeasuredResponse<'_>) -> Vec<c64> {
        self.indices
            .iter()
            .map(|k| function.value[*k] * self.to_displacement(function, *k))
            .collect()
    }

    /// Variance of the displacement, if known.
    pub fn variance(&self, function: &MeasuredResponse<'_>) -> Option<Vec<f64>> {
        let variance = function.variance.as_ref()?;
        Some(
            self.indices
                .iter()
                .map(|k| variance[*k] * self.to_displacement(function, *k).norm_sqr())
                .collect(),
        )
    }

    /// Change of the displacement without a part of the blocks.
    fn change(&self, function: &MeasuredResponse<'_>, part: usize) -> Vec<c64> {
        self.indices
            .iter()
            .map(|k| {
                (function.leave_one_out[part].value[*k] - function.value[*k])
                    * self.to_displacement(function, *k)
            })
            .collect()
    }

    /// Changes without each part of the blocks of each force location; empty where a location has a
    /// single block, which makes the scatter of the others useless.
    pub fn leave_one_out(&self, measured: &[MeasuredResponse<'_>]) -> Vec<LeaveOneOutChange> {
        let position_count = measured
            .iter()
            .map(|function| function.position)
            .max()
            .map_or(0, |last| last + 1);
        let changes: Vec<Vec<LeaveOneOutChange>> = (0..position_count)
            .map(|position| self.changes_at(measured, position))
            .collect();
        if changes.iter().all(|changes| !changes.is_empty()) {
            changes.concat()
        } else {
            Vec::new()
        }
    }

    fn changes_at(
        &self,
        measured: &[MeasuredResponse<'_>],
        position: usize,
    ) -> Vec<LeaveOneOutChange> {
        let parts = measured
            .iter()
            .filter(|function| function.position == position)
            .map(|function| function.leave_one_out)
            .min_by_key(|parts| parts.len())
            .unwrap_or(&[]);
        let change_of = |function: &MeasuredResponse<'_>, part: usize| {
            if function.position == position {
                self.change(function, part)
            } else {
                Vec::new()
            }
        };
        let change_without = |(part, left_out): (usize, &LeaveOneOutResponse)| LeaveOneOutChange {
            share: left_out.share,
            position,
            change: measured
                .iter()
                .map(|function| change_of(function, part))
                .collect(),
        };
        parts.iter().enumerate().map(change_without).collect()
    }
}

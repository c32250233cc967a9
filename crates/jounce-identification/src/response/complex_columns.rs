//! Response functions from files with columns of real numbers, or with lines that are not numbers.

use super::ResponseError;
use jounce_data::recording::{Channel, Issue, IssueKind, IssuePlace, Over, Recording};

/// Contents of the two columns of a response function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ComplexParts {
    /// Real and imaginary part.
    ReIm,
    /// Magnitude and phase in degrees.
    SizeDegrees,
    /// Magnitude and phase in radians.
    SizeRadians,
}

impl ComplexParts {
    /// Converts the contents of the columns to real and imaginary part.
    fn complex(self, one: f64, other: f64) -> (f64, f64) {
        let polar = |angle: f64| (one * angle.cos(), one * angle.sin());
        match self {
            Self::ReIm => (one, other),
            Self::SizeDegrees => polar(other.to_radians()),
            Self::SizeRadians => polar(other),
        }
    }
}

/// Combines the real channels of recordings over frequency in pairs to complex ones, each with the
/// name and the unit of the first.
///
/// # Errors
/// A recording over time, an odd number of real channels, or no channel.
pub fn paired(
    recordings: Vec<Recording>,
    parts: ComplexParts,
) -> Result<Vec<Recording>, ResponseError> {
    recordings
        .into_iter()
        .map(|recording| of_pairs(recording, parts))
        .collect()
}

fn of_pairs(mut recording: Recording, parts: ComplexParts) -> Result<Recording, ResponseError> {
    if recording.over == Over::Time {
        return Err(ResponseError::OverTime {
            recording: recording.name,
        });
    }
    let (mut real, complex): (Vec<Channel>, Vec<Channel>) = recording
        .channels
        .into_iter()
        .partition(|channel| channel.imaginary.is_none());
    if real.is_empty() || !real.len().is_multiple_of(2) {
        let channels = real.into_iter().map(|channel| channel.name).collect();
        return Err(ResponseError::Unpaired {
            recording: recording.name,
            channels,
        });
    }
    let mut result = complex;
    let mut columns = real.drain(..);
    while let (Some(first), Some(second)) = (columns.next(), columns.next()) {
        let (re, im) = first
            .values
            .iter()
            .zip(&second.values)
            .map(|(one, other)| parts.complex(*one, *other))
            .unzip();
        result.push(Channel {
            values: re,
            imaginary: Some(im),
            ..first
        });
    }
    drop(columns);
    recording.channels = result;
    Ok(recording)
}

/// Interpolates lines that are not numbers linearly, at the ends by the nearest one, and adds an
/// issue for each channel. A channel without any number is unchanged.
pub fn bridged(mut recordings: Vec<Recording>) -> Vec<Recording> {
    for recording in recordings
        .iter_mut()
        .filter(|recording| recording.over == Over::Frequency)
    {
        let frequencies = recording.grid.places();
        let result: Vec<Issue> = recording
            .channels
            .iter_mut()
            .filter_map(|channel| bridge(channel, &frequencies))
            .collect();
        recording.issues.extend(result);
    }
    recordings
}

fn bridge(channel: &mut Channel, frequencies: &[f64]) -> Option<Issue> {
    let imaginary = channel.imaginary.as_deref();
    let is_finite =
        |k: &usize| channel.values[*k].is_finite() && imaginary.is_none_or(|im| im[*k].is_finite());
    let known: Vec<usize> = (0..frequencies.len()).filter(is_finite).collect();
    let first = (0..frequencies.len()).find(|k| !is_finite(k))?;
    let (&first_known, &last_known) = (known.first()?, known.last()?);
    let interpolated = |values: &[f64]| -> Vec<f64> {
        let interpolate = |k: usize| {
            let next_known = known.partition_point(|known| *known < k);
            let (a, b) = (known[next_known - 1], known[next_known]);
            values[a]
                + (values[b] - values[a]) * (frequencies[k] - frequencies[a])
                    / (frequencies[b] - frequencies[a])
        };
        let at = |k: usize| match k {
            k if k <= first_known => values[first_known],
            k if k >= last_known => values[last_known],
            k if known.binary_search(&k).is_ok() => values[k],
            k => interpolate(k),
        };
        (0..values.len()).map(at).collect()
    };
    let (values, imaginary) = (
        interpolated(&channel.values),
        channel.imaginary.as_deref().map(interpolated),
    );
    (channel.values, channel.imaginary) = (values, imaginary);
    let message = "lines that are not numbers were interpolated linearly".to_owned();
    Some(
        Issue::new(
            IssueKind::Bridged,
            frequencies.len() - known.len(),
            Some(IssuePlace::Sample(first)),
            message,
        )
        .of(&channel.name),
    )
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::MeasuredResponses;
    use super::*;
    use jounce_data::recording::{Grid, Quantity};

    fn recording(over: Over, columns: &[[f64; 4]]) -> Recording {
        let channel = |(k, values): (usize, &[f64; 4])| {
            Channel::new(
                &format!("column {}", k + 2),
                Quantity::Unknown,
                "",
                values.to_vec(),
            )
        };
        let channels = columns.iter().enumerate().map(channel).collect();
        Recording {
            name: "r".to_owned(),
            over,
            grid: Grid::Stamped(vec![1.0, 2.0, 4.0, 5.0]),
            channels,
            issues: Vec::new(),
        }
    }

    #[test]
    fn columns_become_functions_two_by_two() {
        let (magnitude, angle) = ([1.0, 2.0, 3.0, 4.0], [0.0, 90.0, 180.0, -90.0]);
        let combine = |parts, second: [f64; 4]| {
            let result = paired(
                vec![recording(Over::Frequency, &[magnitude, second])],
                parts,
            )
            .unwrap();
            MeasuredResponses::from_functions(&result)
                .unwrap()
                .functions[0]
                .value
                .clone()
        };
        let expected = [(1.0, 0.0), (0.0, 2.0), (-3.0, 0.0), (0.0, -4.0)];
        for value in [
            combine(ComplexParts::SizeDegrees, angle),
            combine(ComplexParts::SizeRadians, angle.map(f64::to_radians)),
        ] {
            assert!(
                value
                    .iter()
                    .zip(expected)
                    .all(|(h, (re, im))| (h.re - re).hypot(h.im - im) < 1e-14),
                "{value:?}"
            );
        }
        assert!(
            combine(ComplexParts::ReIm, angle)
                .iter()
                .zip(magnitude.iter().zip(angle))
                .all(|(h, (re, im))| (h.re, h.im) == (*re, im))
        );
        let unpaired = paired(
            vec![recording(Over::Frequency, &[magnitude, angle, magnitude])],
            ComplexParts::ReIm,
        )
        .unwrap_err()
        .to_string();
        assert!(
            unpaired.contains("column 2, column 3, column 4"),
            "{unpaired}"
        );
        let time = paired(
            vec![recording(Over::Time, &[magnitude, angle])],
            ComplexParts::ReIm,
        )
        .unwrap_err()
        .to_string();
        assert!(time.contains("over = \"frequency\""), "{time}");
    }

    /// Linear interpolation reproduces a straight line, for any spacing of the lines; at the ends
    /// the nearest number is used.
    #[test]
    fn lines_that_are_no_numbers_are_bridged() {
        let nan = f64::NAN;
        let pair = recording(
            Over::Frequency,
            &[[nan, 2.0, nan, 5.0], [1.0, 4.0, 8.0, 10.0]],
        );
        let result = bridged(paired(vec![pair], ComplexParts::ReIm).unwrap()).remove(0);
        assert_eq!(result.channels[0].values, [2.0, 2.0, 4.0, 5.0]);
        assert_eq!(
            result.channels[0].imaginary.as_deref(),
            Some(&[4.0, 4.0, 8.0, 10.0][..])
        );
        assert_eq!(
            (
                result.issues.len(),
                result.issues[0].count,
                result.issues[0].kind
            ),
            (1, 2, IssueKind::Bridged)
        );
        let all_missing = bridged(vec![recording(Over::Frequency, &[[nan; 4]])]).remove(0);
        assert!(
            all_missing.issues.is_empty()
                && all_missing.channels[0].values.iter().all(|x| x.is_nan())
        );
    }
}

//! Resampling to a uniform grid without missing samples.

use crate::recording::{
    Channel, Grid, GridError, Issue, IssueKind, IssuePlace, Recording, StampsWithGaps,
};

impl Recording {
    /// Returns the recording on a uniform grid. Samples that are not numbers are interpolated
    /// linearly, at the ends by the nearest number. Stamped samples are interpolated linearly at
    /// the typical rate. If the stamps lie on a uniform grid with missing samples, only the missing
    /// samples are interpolated. Issues record what was done.
    ///
    /// Linear interpolation of a sine of `f` Hz sampled at `r` Hz errs by up to `(pi f / r)^2 / 2`
    /// of its peak.
    ///
    /// # Errors
    /// A grid without a rate.
    pub fn even(&self) -> Result<Self, GridError> {
        self.clone().into_even()
    }

    /// Resamples as [`Recording::even`] does, without a second copy of a long recording.
    ///
    /// # Errors
    /// Those of [`Recording::even`].
    pub fn into_even(mut self) -> Result<Self, GridError> {
        let recording = &mut self;
        for channel in &mut recording.channels {
            let issue = interpolate_missing(channel);
            recording.issues.extend(issue);
        }
        if matches!(recording.grid, Grid::Even { .. }) {
            return Ok(self);
        }
        if let Grid::Stamped(stamps) = &recording.grid {
            let Ok(stamps_with_gaps) = StampsWithGaps::of(&stamps.as_slice());
            if let Some(stamps_with_gaps) = stamps_with_gaps {
                return self.fill_gaps(&stamps_with_gaps);
            }
        }
        let (start, end, rate) = (
            recording.grid.at(0),
            recording.grid.at(recording.grid.len().saturating_sub(1)),
            recording.grid.rate(),
        );
        let step = 1.0 / rate;
        let count = ((end - start) / step + 1.0 + 1e-9).floor();
        let grid = Grid::even(start, step, count as usize)?;
        let Grid::Stamped(stamps) = std::mem::replace(&mut recording.grid, grid) else {
            return Ok(self);
        };
        for channel in &mut recording.channels {
            channel.values = interpolated(&stamps, &channel.values, &recording.grid);
            channel.imaginary = channel
                .imaginary
                .as_ref()
                .map(|imaginary| interpolated(&stamps, imaginary, &recording.grid));
        }
        let message = format!(
            "{} stamped samples were interpolated linearly at {} uniform positions, {:.6} Hz",
            stamps.len(),
            count,
            1.0 / step
        );
        recording.issues.push(Issue::new(
            IssueKind::Resampled,
            count as usize,
            None,
            message,
        ));
        Ok(self)
    }

    /// Puts every sample at its grid position and interpolates the empty ones linearly.
    fn fill_gaps(mut self, stamps_with_gaps: &StampsWithGaps) -> Result<Self, GridError> {
        let start = self.grid.at(0);
        let count = self.grid.len() + stamps_with_gaps.missing;
        let grid = Grid::even(start, stamps_with_gaps.step, count)?;
        let indices: Vec<usize> = self
            .grid
            .places()
            .iter()
            .map(|stamp| ((stamp - start) / stamps_with_gaps.step).round() as usize)
            .collect();
        for channel in &mut self.channels {
            channel.values = interpolate_gaps(&indices, &channel.values, count);
            channel.imaginary = channel
                .imaginary
                .as_ref()
                .map(|imaginary| interpolate_gaps(&indices, imaginary, count));
        }
        self.grid = grid;
        let first = indices
            .iter()
            .enumerate()
            .find(|(k, index)| k < *index)
            .map(|(k, _)| IssuePlace::Sample(k));
        let message = format!(
            "missing samples were interpolated linearly at {:.6} Hz; all others are unchanged",
            1.0 / stamps_with_gaps.step
        );
        self.issues.push(Issue::new(
            IssueKind::Bridged,
            stamps_with_gaps.missing,
            first,
            message,
        ));
        Ok(self)
    }
}

/// Values at ascending positions, with linear interpolation in between.
fn interpolate_gaps(indices: &[usize], values: &[f64], count: usize) -> Vec<f64> {
    let mut values_on_grid: Vec<f64> = Vec::with_capacity(count);
    for (index, value) in indices.iter().zip(values) {
        if let Some(previous) = values_on_grid.last().copied() {
            let (from, length) = (values_on_grid.len(), index + 1 - values_on_grid.len());
            values_on_grid
                .extend((from..*index).map(|k| {
                    previous + (value - previous) * (k + 1 - from) as f64 / length as f64
                }));
        }
        values_on_grid.push(*value);
    }
    values_on_grid
}

/// Replaces runs of NaN by linear interpolation, at the ends by the nearest number.
fn interpolate_missing(channel: &mut Channel) -> Option<Issue> {
    let values = &mut channel.values;
    let first = values.iter().position(|x| !x.is_finite())?;
    let known: Vec<usize> = (0..values.len())
        .filter(|k| values[*k].is_finite())
        .collect();
    let (&first_known, &last_known) = (known.first()?, known.last()?);
    let (first_value, last_value) = (values[first_known], values[last_known]);
    values[..first_known].fill(first_value);
    values[last_known + 1..].fill(last_value);
    for pair in known.windows(2).filter(|pair| pair[1] > pair[0] + 1) {
        let (a, b) = (values[pair[0]], values[pair[1]]);
        let step = (b - a) / (pair[1] - pair[0]) as f64;
        values[pair[0] + 1..pair[1]]
            .iter_mut()
            .enumerate()
            .for_each(|(k, value)| *value = a + (k + 1) as f64 * step);
    }
    let message = "samples that are not numbers were interpolated linearly".to_owned();
    Some(
        Issue::new(
            IssueKind::Bridged,
            values.len() - known.len(),
            Some(IssuePlace::Sample(first)),
            message,
        )
        .of(&channel.name),
    )
}

fn interpolated(stamps: &[f64], values: &[f64], grid: &Grid) -> Vec<f64> {
    let mut next = 1;
    let value = |k: usize| {
        let position = grid.at(k);
        while next + 1 < stamps.len() && stamps[next] < position {
            next += 1;
        }
        let (a, b) = (stamps[next - 1], stamps[next]);
        let fraction = if b > a {
            ((position - a) / (b - a)).clamp(0.0, 1.0)
        } else {
            1.0
        };
        values[next - 1] + fraction * (values[next] - values[next - 1])
    };
    (0..grid.len()).map(value).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::recording::{Over, Quantity};

    fn recording(stamps: Vec<f64>, values: Vec<f64>) -> Recording {
        let (grid, issues) = Grid::from_stamps(stamps).unwrap();
        let channels = vec![Channel::new("a", Quantity::Unknown, "", values)];
        Recording {
            name: "r".to_owned(),
            over: Over::Time,
            grid,
            channels,
            issues,
        }
    }

    /// Linear interpolation reproduces a straight line for any stamps, across the gap too.
    #[test]
    fn jittered_stamps_and_missing_samples_of_a_line_come_out_exact() {
        let stamps: Vec<f64> = (0..200)
            .filter(|k| !(77..79).contains(k))
            .map(|k| f64::from(k) + 0.3 * f64::from((k * 37 % 11) - 5) / 5.0)
            .collect();
        let mut values: Vec<f64> = stamps.iter().map(|t| 2.0 * t - 3.0).collect();
        values[20] = f64::NAN;
        let even = recording(stamps.clone(), values).even().unwrap();
        let Grid::Even { start, step, .. } = even.grid else {
            panic!("even places")
        };
        for (k, value) in even.channels[0].values.iter().enumerate() {
            // Sample 20 is interpolated as if its stamp were uniform: the error is its jitter.
            let position = start + k as f64 * step;
            let error = (value - (2.0 * position - 3.0)).abs();
            assert!(
                error
                    < if (18.0..22.0).contains(&position) {
                        1.3
                    } else {
                        1e-9
                    },
                "{k}: {error}"
            );
        }
        let kinds: Vec<_> = even.issues.iter().map(|issue| issue.kind).collect();
        for kind in [
            IssueKind::Jitter,
            IssueKind::Gap,
            IssueKind::Bridged,
            IssueKind::Resampled,
        ] {
            assert!(kinds.contains(&kind), "{kind:?} is missing in {kinds:?}");
        }
    }

    /// A sine of 200 Hz and rms 1 at 1 kHz, its stamps written to seven digits, some samples lost.
    /// The rate equals the grid rate, recorded samples are unchanged, and the error of the mean
    /// power is within the bound of the interpolation.
    #[test]
    fn missing_samples_do_not_change_the_others() {
        for missing in [vec![1234], vec![7, 8, 9, 10, 11, 12, 13, 2000, 2002]] {
            let sine = |k: u32| {
                std::f64::consts::SQRT_2 * (std::f64::consts::TAU * 0.2 * f64::from(k) + 0.1).sin()
            };
            let retained: Vec<u32> = (0..4000).filter(|k| !missing.contains(k)).collect();
            let stamps: Vec<f64> = retained
                .iter()
                .map(|k| (f64::from(*k) * 1e4 + f64::from(k % 3) - 1.0).round() * 1e-7)
                .collect();
            let result = recording(stamps, retained.iter().map(|k| sine(*k)).collect());
            let kinds: Vec<_> = result.issues.iter().map(|issue| issue.kind).collect();
            assert_eq!(kinds, [IssueKind::Gap]);
            assert!(
                (result.rate() / 1000.0 - 1.0).abs() < 1e-7,
                "{}",
                result.rate()
            );
            let even = result.even().unwrap();
            let Grid::Even { step, count, .. } = even.grid else {
                panic!("even places")
            };
            assert!((step / 1e-3 - 1.0).abs() < 1e-7 && count == 4000);
            let values = &even.channels[0].values;
            assert!(retained.iter().all(|k| values[*k as usize] == sine(*k)));
            let power = values.iter().map(|x| x * x).sum::<f64>() / 4000.0;
            assert!(
                (power - 1.0).abs() < 2.0 * missing.len() as f64 / 4000.0,
                "{power}"
            );
            assert_eq!(
                even.issues.last().map(|issue| (issue.kind, issue.count)),
                Some((IssueKind::Bridged, missing.len()))
            );
        }
    }

    /// Stamps in steps of their last digit: a missing one is lost; where the rate is lower than the
    /// digits, every 19th step is long.
    #[test]
    fn missing_sample_is_not_a_rounded_stamp() {
        let kinds = |stamps: Vec<f64>| -> Vec<IssueKind> {
            Grid::from_stamps(stamps)
                .unwrap()
                .1
                .iter()
                .map(|result| result.kind)
                .collect()
        };
        assert_eq!(
            kinds(
                (0..2000)
                    .filter(|k| *k != 777)
                    .map(|k| f64::from(k) / 100.0)
                    .collect()
            ),
            [IssueKind::Gap]
        );
        assert_eq!(
            kinds(
                (0..2000)
                    .map(|k| (f64::from(k) / 0.95).round() / 100.0)
                    .collect()
            ),
            [IssueKind::RoundedStamps]
        );
    }

    #[test]
    fn stamps_with_few_digits_are_even_and_backward_ones_refused() {
        let stamps: Vec<f64> = (0..1000)
            .map(|k| (f64::from(k) * 1e6 / 1536.0).round() * 1e-6)
            .collect();
        let (grid, issues) = Grid::from_stamps(stamps).unwrap();
        assert!(
            issues.is_empty() && (grid.rate() / 1536.0 - 1.0).abs() < 1e-6,
            "{}",
            grid.rate()
        );
        assert!(matches!(
            Grid::from_stamps(vec![0.0, 2.0, 1.0]),
            Err(GridError::Backwards { sample: 2, .. })
        ));
        assert!(matches!(
            Grid::from_stamps(vec![0.0, f64::NAN]),
            Err(GridError::NotANumber { sample: 1, .. })
        ));
        assert!(matches!(
            Grid::from_stamps(vec![0.0]),
            Err(GridError::Few { count: 1 })
        ));
        assert!(Grid::from_stamps(vec![1.0, 1.0]).is_err());
    }
}

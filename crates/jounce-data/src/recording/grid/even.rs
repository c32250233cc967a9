//! Resampling to a uniform grid without missing samples.

use crate::recording::{
    Channel, Grid, GridError, Issue, IssueKind, IssuePlace, Recording, StampsWithGaps,
};

/// Largest number of positions of a uniform grid for each recorded sample.
const MAX_POSITIONS_PER_SAMPLE: f64 = 100.0;

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
    /// A grid without a rate; stamps with gaps that are far longer than the recording.
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
        check_length(recording.grid.len(), count)?;
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
        let samples = self.grid.len();
        check_length(samples, samples as f64 + stamps_with_gaps.missing as f64)?;
        let count = samples + stamps_with_gaps.missing;
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

/// Checks that a uniform grid is not far longer than the recording.
fn check_length(samples: usize, positions: f64) -> Result<(), GridError> {
    match positions > MAX_POSITIONS_PER_SAMPLE * samples as f64 {
        true => Err(GridError::Sparse { samples, positions }),
        false => Ok(()),
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
mod tests;

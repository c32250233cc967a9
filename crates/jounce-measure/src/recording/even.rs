//! A recording at even places, without missing samples.

use super::{Channel, Finding, FindingKind, Grid, GridError, Place, Recording};

impl Recording {
    /// The recording at even places: samples that are not numbers are bridged by straight lines (ends by the nearest number), and stamped
    /// samples are interpolated by straight lines at the usual rate. What was done is added to the findings.
    ///
    /// Linear interpolation of a sine of `f` Hz sampled at `r` Hz errs by up to `(pi f / r)^2 / 2` of its peak.
    ///
    /// # Errors
    /// A grid that has no rate.
    pub fn even(&self) -> Result<Self, GridError> {
        self.clone().into_even()
    }

    /// The same without a second copy of a long recording.
    ///
    /// # Errors
    /// As [`Recording::even`].
    pub fn into_even(mut self) -> Result<Self, GridError> {
        let even = &mut self;
        for channel in &mut even.channels {
            let finding = bridged(channel);
            even.findings.extend(finding);
        }
        if matches!(even.grid, Grid::Even { .. }) {
            return Ok(self);
        }
        let (start, end, rate) = (even.grid.at(0), even.grid.at(even.grid.len().saturating_sub(1)), even.grid.rate());
        let step = 1.0 / rate;
        let count = ((end - start) / step + 1.0 + 1e-9).floor();
        let places = Grid::even(start, step, count as usize)?;
        let Grid::Stamped(stamps) = std::mem::replace(&mut even.grid, places) else { return Ok(self) };
        for channel in &mut even.channels {
            channel.values = interpolated(&stamps, &channel.values, &even.grid);
            channel.imaginary = channel.imaginary.as_ref().map(|imaginary| interpolated(&stamps, imaginary, &even.grid));
        }
        let about =
            format!("{} stamped samples were interpolated by straight lines at {} even places, {:.6} Hz", stamps.len(), count, 1.0 / step);
        even.findings.push(Finding::new(FindingKind::Resampled, count as usize, None, about));
        Ok(self)
    }
}

/// Replaces runs of NaN between numbers by straight lines, at the ends by the nearest number.
fn bridged(channel: &mut Channel) -> Option<Finding> {
    let values = &mut channel.values;
    let first = values.iter().position(|x| !x.is_finite())?;
    let known: Vec<usize> = (0..values.len()).filter(|k| values[*k].is_finite()).collect();
    let (&head, &tail) = (known.first()?, known.last()?);
    let (before, after) = (values[head], values[tail]);
    values[..head].fill(before);
    values[tail + 1..].fill(after);
    for pair in known.windows(2).filter(|pair| pair[1] > pair[0] + 1) {
        let (a, b) = (values[pair[0]], values[pair[1]]);
        let step = (b - a) / (pair[1] - pair[0]) as f64;
        values[pair[0] + 1..pair[1]].iter_mut().enumerate().for_each(|(k, value)| *value = a + (k + 1) as f64 * step);
    }
    let about = "samples that are no numbers were bridged by straight lines".to_owned();
    Some(Finding::new(FindingKind::Bridged, values.len() - known.len(), Some(Place::Sample(first)), about).of(&channel.name))
}

fn interpolated(stamps: &[f64], values: &[f64], grid: &Grid) -> Vec<f64> {
    let mut right = 1;
    let value = |k: usize| {
        let place = grid.at(k);
        while right + 1 < stamps.len() && stamps[right] < place {
            right += 1;
        }
        let (a, b) = (stamps[right - 1], stamps[right]);
        let share = if b > a { ((place - a) / (b - a)).clamp(0.0, 1.0) } else { 1.0 };
        values[right - 1] + share * (values[right] - values[right - 1])
    };
    (0..grid.len()).map(value).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::{Over, Quantity};
    use super::*;

    fn recording(stamps: Vec<f64>, values: Vec<f64>) -> Recording {
        let (grid, findings) = Grid::from_stamps(stamps).unwrap();
        let channels = vec![Channel::new("a", Quantity::Unknown, "", values)];
        Recording { name: "r".to_owned(), over: Over::Time, grid, channels, findings }
    }

    /// A straight line is its own interpolation, wherever the stamps lie; the gap is bridged too.
    #[test]
    fn jittered_stamps_and_missing_samples_of_a_line_come_out_exact() {
        let stamps: Vec<f64> =
            (0..200).filter(|k| !(77..79).contains(k)).map(|k| f64::from(k) + 0.3 * f64::from((k * 37 % 11) - 5) / 5.0).collect();
        let mut values: Vec<f64> = stamps.iter().map(|t| 2.0 * t - 3.0).collect();
        values[20] = f64::NAN;
        let even = recording(stamps.clone(), values).even().unwrap();
        let Grid::Even { start, step, .. } = even.grid else { panic!("even places") };
        for (k, value) in even.channels[0].values.iter().enumerate() {
            // Sample 20 is bridged as if its stamp were even: off by its jitter.
            let place = start + k as f64 * step;
            let error = (value - (2.0 * place - 3.0)).abs();
            assert!(error < if (18.0..22.0).contains(&place) { 1.3 } else { 1e-9 }, "{k}: {error}");
        }
        let kinds: Vec<_> = even.findings.iter().map(|finding| finding.kind).collect();
        for kind in [FindingKind::Jitter, FindingKind::Gap, FindingKind::Bridged, FindingKind::Resampled] {
            assert!(kinds.contains(&kind), "{kind:?} is missing in {kinds:?}");
        }
    }

    #[test]
    fn stamps_with_few_digits_are_even_and_backward_ones_refused() {
        let stamps: Vec<f64> = (0..1000).map(|k| (f64::from(k) * 1e6 / 1536.0).round() * 1e-6).collect();
        let (grid, findings) = Grid::from_stamps(stamps).unwrap();
        assert!(findings.is_empty() && (grid.rate() / 1536.0 - 1.0).abs() < 1e-6, "{}", grid.rate());
        assert!(matches!(Grid::from_stamps(vec![0.0, 2.0, 1.0]), Err(GridError::Backwards { sample: 2, .. })));
        assert!(matches!(Grid::from_stamps(vec![0.0, f64::NAN]), Err(GridError::NotANumber { sample: 1, .. })));
        assert!(matches!(Grid::from_stamps(vec![0.0]), Err(GridError::Few { count: 1 })));
        assert!(Grid::from_stamps(vec![1.0, 1.0]).is_err());
    }
}

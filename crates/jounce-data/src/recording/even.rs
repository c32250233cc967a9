//! Resampling to a uniform grid without missing samples.

use super::{Channel, Grid, GridError, Issue, IssueKind, IssuePlace, Recording, StampsWithGaps};

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
        let even = &mut self;
        for channel in &mut even.channels {
            let finding = bridged(channel);
            even.findings.extend(finding);
        }
        if matches!(even.grid, Grid::Even { .. }) {
            return Ok(self);
        }
        if let Grid::Stamped(stamps) = &even.grid {
            let Ok(holed) = StampsWithGaps::of(&stamps.as_slice());
            if let Some(holed) = holed {
                return self.filled(&holed);
            }
        }
        let (start, end, rate) = (
            even.grid.at(0),
            even.grid.at(even.grid.len().saturating_sub(1)),
            even.grid.rate(),
        );
        let step = 1.0 / rate;
        let count = ((end - start) / step + 1.0 + 1e-9).floor();
        let places = Grid::even(start, step, count as usize)?;
        let Grid::Stamped(stamps) = std::mem::replace(&mut even.grid, places) else {
            return Ok(self);
        };
        for channel in &mut even.channels {
            channel.values = interpolated(&stamps, &channel.values, &even.grid);
            channel.imaginary = channel
                .imaginary
                .as_ref()
                .map(|imaginary| interpolated(&stamps, imaginary, &even.grid));
        }
        let about = format!(
            "{} stamped samples were interpolated linearly at {} uniform positions, {:.6} Hz",
            stamps.len(),
            count,
            1.0 / step
        );
        even.findings.push(Issue::new(
            IssueKind::Resampled,
            count as usize,
            None,
            about,
        ));
        Ok(self)
    }

    /// Puts every sample at its grid position and interpolates the empty ones linearly.
    fn filled(mut self, holed: &StampsWithGaps) -> Result<Self, GridError> {
        let start = self.grid.at(0);
        let count = self.grid.len() + holed.missing;
        let grid = Grid::even(start, holed.step, count)?;
        let places: Vec<usize> = self
            .grid
            .places()
            .iter()
            .map(|stamp| ((stamp - start) / holed.step).round() as usize)
            .collect();
        for channel in &mut self.channels {
            channel.values = spread(&places, &channel.values, count);
            channel.imaginary = channel
                .imaginary
                .as_ref()
                .map(|imaginary| spread(&places, imaginary, count));
        }
        self.grid = grid;
        let first = places
            .iter()
            .enumerate()
            .find(|(k, place)| k < *place)
            .map(|(k, _)| IssuePlace::Sample(k));
        let about = format!(
            "missing samples were interpolated linearly at {:.6} Hz; all others are unchanged",
            1.0 / holed.step
        );
        self.findings
            .push(Issue::new(IssueKind::Bridged, holed.missing, first, about));
        Ok(self)
    }
}

/// Values at ascending positions, with linear interpolation in between.
fn spread(places: &[usize], values: &[f64], count: usize) -> Vec<f64> {
    let mut spread: Vec<f64> = Vec::with_capacity(count);
    for (place, value) in places.iter().zip(values) {
        if let Some(before) = spread.last().copied() {
            let (from, length) = (spread.len(), place + 1 - spread.len());
            spread.extend(
                (from..*place)
                    .map(|k| before + (value - before) * (k + 1 - from) as f64 / length as f64),
            );
        }
        spread.push(*value);
    }
    spread
}

/// Replaces runs of NaN by linear interpolation, at the ends by the nearest number.
fn bridged(channel: &mut Channel) -> Option<Issue> {
    let values = &mut channel.values;
    let first = values.iter().position(|x| !x.is_finite())?;
    let known: Vec<usize> = (0..values.len())
        .filter(|k| values[*k].is_finite())
        .collect();
    let (&head, &tail) = (known.first()?, known.last()?);
    let (before, after) = (values[head], values[tail]);
    values[..head].fill(before);
    values[tail + 1..].fill(after);
    for pair in known.windows(2).filter(|pair| pair[1] > pair[0] + 1) {
        let (a, b) = (values[pair[0]], values[pair[1]]);
        let step = (b - a) / (pair[1] - pair[0]) as f64;
        values[pair[0] + 1..pair[1]]
            .iter_mut()
            .enumerate()
            .for_each(|(k, value)| *value = a + (k + 1) as f64 * step);
    }
    let about = "samples that are not numbers were interpolated linearly".to_owned();
    Some(
        Issue::new(
            IssueKind::Bridged,
            values.len() - known.len(),
            Some(IssuePlace::Sample(first)),
            about,
        )
        .of(&channel.name),
    )
}

fn interpolated(stamps: &[f64], values: &[f64], grid: &Grid) -> Vec<f64> {
    let mut right = 1;
    let value = |k: usize| {
        let place = grid.at(k);
        while right + 1 < stamps.len() && stamps[right] < place {
            right += 1;
        }
        let (a, b) = (stamps[right - 1], stamps[right]);
        let share = if b > a {
            ((place - a) / (b - a)).clamp(0.0, 1.0)
        } else {
            1.0
        };
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
        Recording {
            name: "r".to_owned(),
            over: Over::Time,
            grid,
            channels,
            findings,
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
            let place = start + k as f64 * step;
            let error = (value - (2.0 * place - 3.0)).abs();
            assert!(
                error
                    < if (18.0..22.0).contains(&place) {
                        1.3
                    } else {
                        1e-9
                    },
                "{k}: {error}"
            );
        }
        let kinds: Vec<_> = even.findings.iter().map(|finding| finding.kind).collect();
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
    fn samples_that_are_lost_do_not_touch_the_others() {
        for lost in [vec![1234], vec![7, 8, 9, 10, 11, 12, 13, 2000, 2002]] {
            let sine = |k: u32| {
                std::f64::consts::SQRT_2 * (std::f64::consts::TAU * 0.2 * f64::from(k) + 0.1).sin()
            };
            let kept: Vec<u32> = (0..4000).filter(|k| !lost.contains(k)).collect();
            let stamps: Vec<f64> = kept
                .iter()
                .map(|k| (f64::from(*k) * 1e4 + f64::from(k % 3) - 1.0).round() * 1e-7)
                .collect();
            let found = recording(stamps, kept.iter().map(|k| sine(*k)).collect());
            let kinds: Vec<_> = found.findings.iter().map(|finding| finding.kind).collect();
            assert_eq!(kinds, [IssueKind::Gap]);
            assert!(
                (found.rate() / 1000.0 - 1.0).abs() < 1e-7,
                "{}",
                found.rate()
            );
            let even = found.even().unwrap();
            let Grid::Even { step, count, .. } = even.grid else {
                panic!("even places")
            };
            assert!((step / 1e-3 - 1.0).abs() < 1e-7 && count == 4000);
            let values = &even.channels[0].values;
            assert!(kept.iter().all(|k| values[*k as usize] == sine(*k)));
            let power = values.iter().map(|x| x * x).sum::<f64>() / 4000.0;
            assert!(
                (power - 1.0).abs() < 2.0 * lost.len() as f64 / 4000.0,
                "{power}"
            );
            assert_eq!(
                even.findings
                    .last()
                    .map(|finding| (finding.kind, finding.count)),
                Some((IssueKind::Bridged, lost.len()))
            );
        }
    }

    /// Stamps in steps of their last digit: a missing one is lost; where the rate is lower than the
    /// digits, every 19th step is long.
    #[test]
    fn a_lost_sample_is_no_rounded_stamp() {
        let kinds = |stamps: Vec<f64>| -> Vec<IssueKind> {
            Grid::from_stamps(stamps)
                .unwrap()
                .1
                .iter()
                .map(|found| found.kind)
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
        let (grid, findings) = Grid::from_stamps(stamps).unwrap();
        assert!(
            findings.is_empty() && (grid.rate() / 1536.0 - 1.0).abs() < 1e-6,
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

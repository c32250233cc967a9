//! Mean with its 95 % confidence interval.
//!
//! Members of an ensemble are independent. With `n >= 8` members the interval is Student's over
//! their means. With fewer, each window is cut into 16 batches, and the interval is Student's over
//! all batch means. This is valid as long as a batch is much longer than the correlation time of
//! the harvester.

use super::member::Member;
use jounce_signal::spectral::student_95;
use serde::Serialize;

/// Number of members from which the interval is over the means of members.
const MIN_MEMBERS_FOR_INTERVAL: usize = 8;

/// Values over which an interval was computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum IntervalOver {
    /// Means of independent members.
    Members,
    /// Means of batches within members.
    Batches,
}

impl IntervalOver {
    /// Returns the kind of interval for a number of members.
    pub(super) fn of(members: usize) -> Self {
        if members >= MIN_MEMBERS_FOR_INTERVAL {
            Self::Members
        } else {
            Self::Batches
        }
    }
}

/// Mean and half width of its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Estimate {
    /// Mean.
    pub mean: f64,
    /// Half width of the 95 % interval.
    pub half_width: f64,
    /// Values over which the interval was computed.
    pub interval: IntervalOver,
}

impl Estimate {
    /// Estimate of the mean power of all loads, W.
    pub(super) fn of_power(members: &[Member]) -> Self {
        let interval = IntervalOver::of(members.len());
        let values: Vec<f64> = match interval {
            IntervalOver::Members => members.iter().map(|member| member.mean_power_w).collect(),
            IntervalOver::Batches => members
                .iter()
                .flat_map(|member| member.batches_w.iter().copied())
                .collect(),
        };
        Self::of(&values, interval)
    }

    /// Estimate from independent values.
    pub fn of(values: &[f64], interval: IntervalOver) -> Self {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let variance = values
            .iter()
            .map(|value| (value - mean).powi(2))
            .sum::<f64>()
            / (count - 1.0);
        let half_width = if values.len() < 2 {
            f64::INFINITY
        } else {
            student_95(count - 1.0) * (variance / count).sqrt()
        };
        Self {
            mean,
            half_width,
            interval,
        }
    }

    /// Estimate from independent values, by their number, sum and sum of squares, with Student's
    /// quantile for this number.
    pub(super) fn of_sums(count: usize, quantile_95: f64, [sum, squares]: [f64; 2]) -> Self {
        let number = count as f64;
        let mean = sum / number;
        let variance = ((squares - number * mean * mean) / (number - 1.0)).max(0.0);
        let half_width = if count < 2 {
            f64::INFINITY
        } else {
            quantile_95 * (variance / number).sqrt()
        };
        Self {
            mean,
            half_width,
            interval: IntervalOver::Members,
        }
    }

    /// Ratio of the sum of the first to the sum of the second numbers of independent pairs, with
    /// its jackknife interval. It is 0 with an infinite interval where the second numbers are all
    /// 0. Source: B. Efron, C. Stein, Ann. Stat. 9 (1981) 586.
    pub(super) fn of_ratio(pairs: &[[f64; 2]], interval: IntervalOver) -> Self {
        let [above, below] = pairs
            .iter()
            .fold([0.0; 2], |[a, b], pair| [a + pair[0], b + pair[1]]);
        if below == 0.0 {
            return Self {
                mean: 0.0,
                half_width: f64::INFINITY,
                interval,
            };
        }
        let (count, mean) = (pairs.len() as f64, above / below);
        let leave_one_out: Vec<f64> = pairs
            .iter()
            .map(|pair| count * mean - (count - 1.0) * (above - pair[0]) / (below - pair[1]))
            .collect();
        let spread = Self::of(&leave_one_out, interval);
        let half_width = if spread.half_width.is_finite() {
            spread.half_width
        } else {
            f64::INFINITY
        };
        Self {
            mean,
            half_width,
            interval,
        }
    }

    /// Half width over mean; infinite where the mean is 0 and the width is not 0.
    pub fn relative_width(&self) -> f64 {
        if self.half_width == 0.0 {
            0.0
        } else {
            self.half_width / self.mean.abs()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pairs with equal second numbers: the ratio is a mean, and the jackknife interval is the
    /// ordinary one.
    #[test]
    fn a_ratio_over_equal_numbers_is_a_mean() {
        let values = [1.0, 3.0, 2.0, 2.5];
        let [ratio, mean] = [
            Estimate::of_ratio(&values.map(|value| [value, 0.5]), IntervalOver::Members),
            Estimate::of(&values.map(|value| 2.0 * value), IntervalOver::Members),
        ];
        assert!(
            (ratio.mean - mean.mean).abs() < 1e-12
                && (ratio.half_width - mean.half_width).abs() < 1e-12,
            "{ratio:?} {mean:?}"
        );
        let sums = Estimate::of_sums(
            4,
            student_95(3.0),
            [2.0 * 8.5, 4.0 * (1.0 + 9.0 + 4.0 + 6.25)],
        );
        assert!((sums.half_width - mean.half_width).abs() < 1e-12);
        assert_eq!(
            Estimate::of_ratio(&[[0.0, 0.0]; 3], IntervalOver::Members).half_width,
            f64::INFINITY
        );
    }

    #[test]
    fn the_mean_of_two_values_has_a_wide_interval() {
        let estimate = Estimate::of(&[1.0, 3.0, 2.0, 2.0], IntervalOver::Members);
        assert!(
            (estimate.mean - 2.0).abs() < 1e-15
                && (estimate.half_width - student_95(3.0) * (2.0_f64 / 12.0).sqrt()).abs() < 1e-12
        );
        let of_two = Estimate::of(&[1.0, 3.0], IntervalOver::Members);
        assert!((of_two.half_width - 12.706_205).abs() < 1e-5, "{of_two:?}");
        assert_eq!(
            Estimate::of(&[1.0], IntervalOver::Members).half_width,
            f64::INFINITY
        );
    }
}

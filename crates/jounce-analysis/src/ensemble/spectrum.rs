//! Power spectral density of the voltages of an ensemble, and their statistical bandwidth.
//!
//! Each member gives one periodogram `G_k` (Hann window) of its complete averaging window. Members
//! are independent, so products of different members have no bias, and
//!
//! ```text
//! B = [(sum_k I_k)^2 - sum_k I_k^2] / [df sum_f ((sum_k G_k)^2 - sum_k G_k^2)],      I_k = df sum_f G_k
//! ```
//!
//! estimates `(integral G df)^2 / integral G^2 df` (see [`jounce_model::linear`]), apart from the
//! resolution `1.5 / window`: a window must be many times longer than `1 / B`. Its interval is
//! Student's over a jackknife of up to 16 groups of members.
//!
//! Source: J. S. Bendat, A. G. Piersol, Random Data, 4th ed. (2010), sections 8.2 and 8.5; B.
//! Efron, C. Stein, Ann. Stat. 9 (1981) 586.

use super::estimate::{Estimate, IntervalOver};
use jounce_signal::spectral::student_95;

/// Largest number of jackknife groups.
const MAX_JACKKNIFE_GROUPS: usize = 16;

/// Largest number of frequencies in the result.
const MAX_BINS: usize = 2000;

/// Sums of periodograms.
#[derive(Debug, Clone, Default, PartialEq)]
struct PeriodogramSums {
    /// `sum G` and `sum G^2` at each line.
    lines: Vec<[f64; 2]>,
    /// `sum I` and `sum I^2`.
    total: [f64; 2],
}

impl PeriodogramSums {
    fn add(&mut self, density: &[f64]) {
        self.lines.resize(density.len(), [0.0; 2]);
        for ([sum, squares], g) in self.lines.iter_mut().zip(density) {
            (*sum, *squares) = (*sum + g, *squares + g * g);
        }
        let total: f64 = density.iter().sum();
        self.total = [self.total[0] + total, self.total[1] + total * total];
    }

    fn merge(&mut self, other: &Self, sign: f64) {
        self.lines.resize(other.lines.len(), [0.0; 2]);
        for (sums, others) in self.lines.iter_mut().zip(&other.lines) {
            (sums[0], sums[1]) = (sums[0] + sign * others[0], sums[1] + sign * others[1]);
        }
        (self.total[0], self.total[1]) = (
            self.total[0] + sign * other.total[0],
            self.total[1] + sign * other.total[1],
        );
    }

    /// Statistical bandwidth `B` in lines.
    fn bandwidth(&self) -> f64 {
        let variance = |[sum, squares]: &[f64; 2]| sum * sum - squares;
        variance(&self.total) / self.lines.iter().map(variance).sum::<f64>()
    }
}

/// Sums of the periodograms of one voltage.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct VoltagePeriodograms {
    groups: Vec<PeriodogramSums>,
    /// `sum G` and `sum G^2` of each bin.
    bins: Vec<[f64; 2]>,
    members: usize,
}

/// Spectral density of one voltage over the ensemble.
#[derive(Debug, Clone, PartialEq)]
pub struct VoltageSpectrum {
    /// Name of the patch.
    pub patch: String,
    /// Centre of each bin, Hz.
    pub frequency_hz: Vec<f64>,
    /// One-sided power spectral density in each bin, V^2/Hz.
    pub density: Vec<Estimate>,
    /// Statistical bandwidth, Hz.
    pub bandwidth_hz: Estimate,
}

impl VoltagePeriodograms {
    /// Adds the periodogram of the next member.
    pub fn add(&mut self, density: &[f64]) {
        self.groups
            .resize_with(MAX_JACKKNIFE_GROUPS, PeriodogramSums::default);
        self.groups[self.members % MAX_JACKKNIFE_GROUPS].add(density);
        let per_bin = density.len().div_ceil(MAX_BINS);
        self.bins.resize(density.len().div_ceil(per_bin), [0.0; 2]);
        for ([sum, squares], lines) in self.bins.iter_mut().zip(density.chunks(per_bin)) {
            let g = lines.iter().sum::<f64>() / lines.len() as f64;
            (*sum, *squares) = (*sum + g, *squares + g * g);
        }
        self.members += 1;
    }

    /// Returns the spectrum of all members; lines are `resolution_hz` apart.
    pub fn to_spectrum(&self, patch: String, resolution_hz: f64) -> VoltageSpectrum {
        let lines = self.groups.first().map_or(0, |group| group.lines.len());
        let per_bin = lines.div_ceil(MAX_BINS);
        let quantile_95 = student_95(self.members as f64 - 1.0);
        let middle = |bin: usize| {
            let last = ((bin + 1) * per_bin).min(lines) - 1;
            0.5 * (bin * per_bin + last) as f64 * resolution_hz
        };
        VoltageSpectrum {
            patch,
            frequency_hz: (0..self.bins.len()).map(middle).collect(),
            density: self
                .bins
                .iter()
                .map(|sums| Estimate::of_sums(self.members, quantile_95, *sums))
                .collect(),
            bandwidth_hz: self.bandwidth(resolution_hz),
        }
    }

    fn bandwidth(&self, resolution_hz: f64) -> Estimate {
        let groups: Vec<&PeriodogramSums> = self
            .groups
            .iter()
            .filter(|group| !group.lines.is_empty())
            .collect();
        let mut all = PeriodogramSums::default();
        groups.iter().for_each(|group| all.merge(group, 1.0));
        let total = all.bandwidth();
        let count = groups.len() as f64;
        let leave_one_out = groups.iter().map(|group| {
            let mut rest = all.clone();
            rest.merge(group, -1.0);
            resolution_hz * (count * total - (count - 1.0) * rest.bandwidth())
        });
        let spread = Estimate::of(&leave_one_out.collect::<Vec<f64>>(), IntervalOver::Members);
        let half_width = if spread.half_width.is_finite() {
            spread.half_width
        } else {
            f64::INFINITY
        };
        Estimate {
            mean: resolution_hz * total,
            half_width,
            ..spread
        }
    }
}

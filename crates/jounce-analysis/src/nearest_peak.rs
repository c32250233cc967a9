//! Nearest peak of the mean power of an orbit over the frequency of the drive.
//!
//! At a peak over the frequency `f` the slope of the power vanishes, `P_f = 0`. Along the peaks
//! `P_ff df + P_fp dp = 0`, so that
//!
//! ```text
//! df/dp = -P_fp / P_ff    dP/dp = P_p
//! ```
//!
//! The first derivatives are exact ([`orbit_derivatives`]). Along the branch, with the length `s`, their
//! slopes are `P_ff df/ds` and `P_fp df/ds`, whose quotient is the same also next to a fold. They are
//! central differences of order eight between orbits on both sides of the peak.

use super::bandwidth::CurvePiece;
use super::frequency_branch::{FrequencyBranch, NotFollowed, at_frequency};
use super::{
    AnalysisError, Branch, BranchPoint, Derivative, DerivativeAccuracy, DerivativeKey, Model,
    Parameter, orbit_derivatives,
};
use jounce_continuation::Corrector;
use jounce_orbits::{Orbit, OrbitError, OrbitQuantity, Shooting};
use rayon::prelude::*;

/// Relative tolerance of the integrations that locate the peak.
const TOLERANCE: f64 = 1e-11;

/// Largest number of evaluations of Newton's method.
const MOST_CORRECTIONS: u32 = 8;

/// Distance of neighbouring orbits of a difference, relative to a step of the continuation: truncation,
/// its eighth power, and roundoff, divided by it, are both below 1e-7.
const DISTANCE: f64 = 0.05;

/// Number of orbits on each side of the peak.
const SIDE: usize = 4;

/// Weights of the central differences of orders eight and six at the distances 1 to 4.
const WEIGHTS: [[f64; SIDE]; 2] = [
    [0.8, -0.2, 4.0 / 105.0, -1.0 / 280.0],
    [0.75, -0.15, 1.0 / 60.0, 0.0],
];

/// Peak of the mean power of a branch over the frequency of the drive.
#[derive(Debug, Clone)]
pub struct PeakPlace {
    /// Key of the frequency.
    pub key: String,
    /// Frequency of the peak, Hz.
    pub frequency_hz: f64,
    /// Mean power of all loads there, W.
    pub mean_power_w: f64,
    /// Frequencies, Hz, and orbits at equal distances along the branch, the peak in their middle.
    orbits: Vec<(f64, Orbit)>,
}

/// Derivatives of a peak by a key.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PeakDerivative {
    /// Of the frequency, Hz per SI unit of the key.
    pub frequency_hz: Derivative,
    /// Of the mean power, W per SI unit of the key.
    pub mean_power_w: Derivative,
}

/// Returns the peak of the branch of an orbit with the smallest distance from the frequency of the
/// drive, within 30 % of it; `state` is that at the start of the orbit, energy coordinates. `None`
/// where the branch has no peak there.
///
/// # Errors
/// The branch cannot be followed.
pub fn nearest_peak(
    model: &Model,
    period_cycles: u32,
    state: &[f64],
) -> Result<Option<PeakPlace>, NotFollowed> {
    let followed = FrequencyBranch::of(model, period_cycles, state)?;
    let peaks = followed
        .branches
        .iter()
        .flat_map(|branch| peaks(model, &followed, branch));
    let distance = |peak: &PeakPlace| (peak.frequency_hz - followed.frequency_hz).abs();
    Ok(peaks.min_by(|a, b| distance(a).total_cmp(&distance(b))))
}

/// Returns all peaks of a branch.
fn peaks(model: &Model, followed: &FrequencyBranch, branch: &Branch) -> Vec<PeakPlace> {
    let windows: Vec<_> = branch.points.windows(3).collect();
    let is_highest = |points: &&[BranchPoint]| {
        let [a, b, c] = [0, 1, 2].map(|k| points[k].orbit.mean_power_w);
        b > 0.0 && a <= b && c <= b
    };
    let parameter = Parameter::new(model, &followed.key, followed.width_hz);
    let shooting = || {
        let cycles = branch.period_cycles;
        Shooting::new(&parameter, &model.kernel, cycles, TOLERANCE)
    };
    let peak = |points: &[BranchPoint]| {
        let corrector = Corrector {
            goal: 10.0 * TOLERANCE,
            most: MOST_CORRECTIONS,
        };
        let scale = followed.width_hz / 20.0;
        points.windows(2).find_map(|pair| {
            let ends = [&pair[0], &pair[1]];
            let piece = CurvePiece::new(shooting(), corrector, scale, ends)?;
            let noise_w = TOLERANCE * ends[0].orbit.mean_power_w;
            let point = piece.maximum((0.0, 1.0), noise_w)?.point;
            let orbits = (0..=2 * SIDE).map(|place| {
                let near = piece.at(point.x + DISTANCE * (place as f64 - SIDE as f64))?;
                Some((near.parameter(), piece.orbit(&near)?))
            });
            Some(PeakPlace {
                key: followed.key.path().to_owned(),
                frequency_hz: point.parameter(),
                mean_power_w: point.mean_power_w(),
                orbits: orbits.collect::<Option<_>>()?,
            })
        })
    };
    let highest = windows.into_par_iter().filter(is_highest);
    highest.filter_map(peak).collect()
}

/// Derivatives of the mean power of an orbit: by the frequency, then by the keys.
type Slopes = Vec<Derivative>;

impl PeakPlace {
    /// Returns the derivatives of the peak by keys other than the frequency.
    ///
    /// # Errors
    /// A model with a changed key cannot be built or integrated.
    pub fn derivatives(
        &self,
        model: &Model,
        keys: &[DerivativeKey<'_>],
    ) -> Result<Vec<PeakDerivative>, OrbitError<AnalysisError>> {
        let slopes = self.orbits.par_iter();
        let slopes =
            slopes.map(|(frequency_hz, orbit)| self.slopes(model, keys, *frequency_hz, orbit));
        let slopes = slopes.collect::<Result<Vec<Slopes>, _>>()?;
        let difference = |index: usize, weights: &[f64; SIDE]| -> f64 {
            let value = |place: usize| slopes[place][index].value;
            let terms = (1..).zip(weights);
            terms
                .map(|(k, weight)| weight * (value(SIDE + k) - value(SIDE - k)))
                .sum()
        };
        // The error is that of the truncation, and of the slopes.
        let second = |index: usize| {
            let [fine, coarse] = [0, 1].map(|order| difference(index, &WEIGHTS[order]));
            let noise = slopes
                .iter()
                .map(|one| one[index].error)
                .fold(0.0, f64::max);
            Derivative {
                value: fine,
                error: (fine - coarse).abs() + 2.0 * noise,
            }
        };
        let bend = second(0);
        let of_key = |key: usize| {
            let mixed = second(1 + key);
            let value = -mixed.value / bend.value;
            let relative = (bend.error / bend.value).abs();
            PeakDerivative {
                frequency_hz: Derivative {
                    value,
                    error: (mixed.error / bend.value).abs() + relative * value.abs(),
                },
                mean_power_w: slopes[SIDE][1 + key],
            }
        };
        Ok((0..keys.len()).map(of_key).collect())
    }

    /// Returns the derivatives of the mean power of an orbit by the frequency and the keys.
    fn slopes(
        &self,
        model: &Model,
        keys: &[DerivativeKey<'_>],
        frequency_hz: f64,
        orbit: &Orbit,
    ) -> Result<Slopes, OrbitError<AnalysisError>> {
        let (frequency, model) =
            at_frequency(model, &self.key, frequency_hz).map_err(OrbitError::Harvester)?;
        let over = DerivativeKey {
            key: &frequency,
            scale: frequency_hz,
        };
        let all: Vec<DerivativeKey<'_>> =
            std::iter::once(over).chain(keys.iter().copied()).collect();
        let power = [OrbitQuantity::MeanPower];
        let accuracy = DerivativeAccuracy::Estimated;
        let found = orbit_derivatives(&model, orbit, &all, &power, accuracy)?;
        let first = |row: Result<Vec<Derivative>, _>| row.map(|row| row[0]);
        found.by_key.into_iter().map(first).collect()
    }
}

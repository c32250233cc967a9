//! Product of a row and the forced part of the state, as a polynomial in time.
//!
//! ```text
//! row . P(t) = sum_s (row . rest) (u + s t) + (row . lag) s + sum_j (u m_(j-1) + s m_(j-2)) t^j / j!,   m_j = row A^j b
//! ```
//!
//! with `m` over the blocks that are local to the signal only; for free bodies alone it is a cubic.

use super::taylor_weights::orders;
use jounce_model::plant::{LOCAL_TERMS, Plant, SignalSample, local_limit_s};
use jounce_simd::{F64x8, LANES, Portable, Simd};

/// Number of coefficients of a series.
const SERIES_COEFFICIENTS: usize = LOCAL_TERMS + 1;

/// `j (j - 1) (j - 2) (j - 3)`.
const FOURTH_FACTORS: Coefficients = {
    let mut factors = [0.0; PADDED_COEFFICIENTS];
    let mut j = 4;
    while j < factors.len() {
        factors[j] = (j * (j - 1) * (j - 2) * (j - 3)) as f64;
        j += 1;
    }
    factors
};

/// `1 / (j + 1)`.
const INTEGRAL_FACTORS: Coefficients = {
    let mut factors = [0.0; PADDED_COEFFICIENTS];
    let mut j = 0;
    while j < factors.len() {
        factors[j] = 1.0 / (j + 1) as f64;
        j += 1;
    }
    factors
};

/// Number of coefficients, padded to complete vectors.
const PADDED_COEFFICIENTS: usize = SERIES_COEFFICIENTS.div_ceil(LANES) * LANES;

/// Coefficients of a series; the padding is 0.
type Coefficients = [f64; PADDED_COEFFICIENTS];

/// Row for all signals.
#[derive(Debug, Clone)]
pub(crate) struct ExcitationRow {
    /// For each signal, the coefficients by its value and by its slope.
    signals: Vec<[Coefficients; 2]>,
    /// Number of coefficients that are not always 0.
    used: usize,
    /// For each signal, the largest `|eigenvalue|` of its local blocks, rad/s.
    fastest_rad_s: Vec<f64>,
}

/// Polynomial in the time from the current time on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ExcitationSeries {
    coefficients: Coefficients,
    used: usize,
}

impl ExcitationRow {
    pub fn of(plant: &Plant, row: &[f64]) -> Self {
        let dot = |column: &[f64]| -> f64 { row.iter().zip(column).map(|(r, c)| r * c).sum() };
        let mut used = 2;
        let mut coefficients = |forcing: &jounce_model::plant::Forcing| {
            let mut of = [[0.0; PADDED_COEFFICIENTS]; 2];
            (of[0][0], of[1][0]) = (dot(&forcing.rest), dot(&forcing.lag));
            of[1][1] = of[0][0];
            let (mut power, mut factorial) = (forcing.local.clone(), 1.0);
            for j in 1..SERIES_COEFFICIENTS {
                factorial *= j as f64;
                let moment = dot(&power) / factorial;
                power = plant.diagonal.block.apply(&power);
                of[0][j] += moment;
                if j + 1 < SERIES_COEFFICIENTS {
                    of[1][j + 1] += moment / (j + 1) as f64;
                }
                if moment != 0.0 {
                    // A slope reaches one power higher than a value.
                    used = used.max((j + 2).min(SERIES_COEFFICIENTS));
                }
            }
            of
        };
        let signals = plant.forcings.iter().map(&mut coefficients).collect();
        Self {
            signals,
            used,
            fastest_rad_s: fastest_rad_s(plant),
        }
    }

    /// Reads an entry of the physical state.
    pub fn of_physical(plant: &Plant, state_index: usize) -> Self {
        let matrix = &plant.diagonal.to_physical;
        let row: Vec<f64> = (0..plant.len()).map(|j| matrix[(state_index, j)]).collect();
        Self::of(plant, &row)
    }

    /// Returns the polynomial for given samples of the signals, complete up to a time from now.
    pub fn series(&self, sizes: &[SignalSample], longest_s: f64) -> ExcitationSeries {
        let terms = terms(fastest_driven_rad_s(&self.fastest_rad_s, sizes), longest_s);
        self.first_terms(Portable::new(), sizes, terms)
    }

    /// Returns the polynomial for given samples of the signals, complete up to the longest step.
    pub fn longest_series(&self, sizes: &[SignalSample]) -> ExcitationSeries {
        let fastest_rad_s = fastest_driven_rad_s(&self.fastest_rad_s, sizes);
        self.series(sizes, local_limit_s(fastest_rad_s))
    }

    /// Returns for each signal the integrals of the polynomials of its value and of its slope.
    pub fn integrals(&self, from_s: f64, to_s: f64) -> impl Iterator<Item = [f64; 2]> {
        let between = move |polynomial: &Coefficients| {
            let at = |t: f64| integral(&polynomial[..self.used], t);
            match from_s == 0.0 {
                true => at(to_s),
                false => at(to_s) - at(from_s),
            }
        };
        (self.signals.iter())
            .map(move |[by_value, by_slope]| [between(by_value), between(by_slope)])
    }

    /// Returns the polynomial with at most a number of terms.
    #[inline(always)]
    pub fn first_terms<W: Simd>(
        &self,
        w: W,
        sizes: &[SignalSample],
        terms: usize,
    ) -> ExcitationSeries {
        let (mut coefficients, used) = ([0.0; PADDED_COEFFICIENTS], self.used.min(terms));
        let vectors = coefficients.as_chunks_mut().0;
        for (v, out) in vectors[..used.div_ceil(LANES)].iter_mut().enumerate() {
            let mut sum = w.zero();
            for ([by_value, by_slope], [value, slope]) in self.signals.iter().zip(sizes) {
                let [by_value, by_slope] = [by_value, by_slope].map(|c| w.load(&vector(c, v)));
                sum = w.fma(w.splat(*value), by_value, sum);
                sum = w.fma(w.splat(*slope), by_slope, sum);
            }
            *out = w.store(sum).0;
        }
        ExcitationSeries { coefficients, used }
    }
}

/// Returns for each signal the largest `|eigenvalue|` of its local blocks, rad/s.
pub(super) fn fastest_rad_s(plant: &Plant) -> Vec<f64> {
    let fastest = (plant.forcings.iter()).map(|forcing| forcing.fastest_local_rad_s);
    fastest.collect()
}

/// Returns the largest `|eigenvalue|` of the blocks that are local to a signal that is not 0, rad/s,
/// from those of each signal.
#[inline(always)]
pub(super) fn fastest_driven_rad_s(fastest_rad_s: &[f64], sizes: &[SignalSample]) -> f64 {
    let signals = fastest_rad_s.iter().zip(sizes);
    signals
        .filter(|(_, size)| **size != [0.0; 2])
        .fold(0.0, |max, (fastest, _)| max.max(*fastest))
}

/// Returns the integral of a polynomial from 0 on.
fn integral(coefficients: &[f64], t: f64) -> f64 {
    let terms = coefficients.iter().zip(&INTEGRAL_FACTORS);
    t * terms
        .rev()
        .fold(0.0, |sum, (c, factor)| sum * t + c * factor)
}

/// Returns a vector of coefficients.
#[inline(always)]
fn vector(coefficients: &Coefficients, v: usize) -> F64x8 {
    F64x8(coefficients.as_chunks().0[v])
}

/// Returns the number of terms that count up to a time from now, for local blocks of at most some
/// `|eigenvalue|`, rad/s.
#[inline(always)]
pub(super) fn terms(fastest_rad_s: f64, longest_s: f64) -> usize {
    orders(fastest_rad_s * longest_s) + 2
}

impl ExcitationSeries {
    pub const ZERO: Self = Self {
        coefficients: [0.0; PADDED_COEFFICIENTS],
        used: 0,
    };

    /// Adds a cubic.
    #[inline(always)]
    pub fn add(&mut self, cubic: &[f64; 4]) {
        self.coefficients
            .iter_mut()
            .zip(cubic)
            .for_each(|(sum, c)| *sum += c);
        self.used = self.used.max(cubic.len());
    }

    /// Returns value and slope.
    #[inline(always)]
    pub fn motion(&self, t: f64) -> [f64; 2] {
        let (mut value, mut slope) = (0.0, 0.0);
        for c in self.coefficients[..self.used].iter().rev() {
            slope = slope * t + value;
            value = value * t + c;
        }
        [value, slope]
    }

    /// Returns the value.
    #[inline(always)]
    pub fn value(&self, t: f64) -> f64 {
        self.coefficients[..self.used]
            .iter()
            .rev()
            .fold(0.0, |value, c| value * t + c)
    }

    /// Returns the second derivative.
    #[inline(always)]
    pub fn curvature(&self, t: f64) -> f64 {
        (2..self.used).rev().fold(0.0, |sum, j| {
            sum * t + (j * (j - 1)) as f64 * self.coefficients[j]
        })
    }

    /// Returns a bound on the fourth derivative up to a time.
    #[inline(always)]
    pub fn fourth_bound(&self, t: f64) -> f64 {
        (4..self.used).rev().fold(0.0, |sum, j| {
            sum * t + FOURTH_FACTORS[j] * self.coefficients[j].abs()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_those_of_the_polynomial() {
        let mut series = ExcitationSeries {
            used: 7,
            ..ExcitationSeries::ZERO
        };
        series.coefficients[..7].copy_from_slice(&[1.0, -2.0, 0.5, 3.0, -1.0, 0.2, 0.7]);
        let at = |t: f64| {
            1.0 - 2.0 * t + 0.5 * t * t + 3.0 * t.powi(3) - t.powi(4)
                + 0.2 * t.powi(5)
                + 0.7 * t.powi(6)
        };
        let slope = -2.0 + 0.6 + 9.0 * 0.36 - 4.0 * 0.216 + 0.1296 + 4.2 * 0.07776;
        let curvature = 1.0 + 18.0 * 0.6 - 12.0 * 0.36 + 4.0 * 0.216 + 21.0 * 0.1296;
        let [value, derivative] = series.motion(0.6);
        assert!(
            (value - at(0.6)).abs() < 1e-14
                && (series.value(0.6) - value).abs() < 1e-15
                && (derivative - slope).abs() < 1e-13
        );
        assert!(
            (series.curvature(0.6) - curvature).abs() < 1e-13,
            "{}",
            series.curvature(0.6)
        );
        let wanted = 0.6 - 0.36 + 0.5 * 0.216 / 3.0 + 3.0 * 0.1296 / 4.0 - 0.07776 / 5.0
            + 0.2 * 0.046_656 / 6.0
            + 0.7 * 0.027_993_6 / 7.0;
        assert!((integral(&series.coefficients[..7], 0.6) - wanted).abs() < 1e-15);
        let fourth = |t: f64| (-24.0 + 24.0 * t + 252.0 * t * t).abs();
        assert!((0..=60).all(|k| fourth(f64::from(k) / 100.0) <= series.fourth_bound(0.6)));
    }
}

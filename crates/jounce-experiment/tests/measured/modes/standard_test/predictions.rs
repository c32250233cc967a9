//! Numbers that follow from a fitted spec: coupling, optimal load, power over the fifth load.

use super::{FIFTH_OHM, NOISE, line_hz, plant, voltage, with_load};
use crate::modes::fourier::spectrum;
use jounce_analysis::AnalysisError;
use jounce_fft::Complex;
use jounce_model::linear::optimal_resistance;
use jounce_model::structure;
use jounce_spec::Spec;

/// Where the load draws the most under the drive of the spec.
pub fn optimum(spec: &Spec) -> Result<f64, AnalysisError> {
    Ok(optimal_resistance(&plant(spec), 0)
        .expect("an optimum")
        .resistance_ohm)
}

pub fn coupling_squared(spec: &Spec) -> Result<f64, AnalysisError> {
    Ok(
        jounce_model::linear::couplings(&structure::modes(spec).expect("modes"))[0]
            .coupling_squared,
    )
}

/// Mean power over the fifth load under a base as it was recorded, all its lines at which the first mode responds.
pub fn power(spec: &Spec, base: &[(f64, f64)]) -> Result<f64, AnalysisError> {
    let frequency_hz: Vec<f64> = base.iter().map(|(hz, _)| *hz).collect();
    let voltages = voltage(&with_load(spec, FIFTH_OHM), &frequency_hz);
    Ok(voltages
        .iter()
        .zip(base)
        .map(|(h, (_, square))| h.norm_sqr() * square)
        .sum::<f64>()
        / FIFTH_OHM)
}

/// Standard deviation of that power by the noise of the sensors, W. Noise adds `2 Re(X* N)` to the square of a line `X`; the noise of the base
/// stands in the prediction, that of the voltage in the measured power.
pub fn sensor_deviation(spec: &Spec, base: &[(f64, f64)]) -> f64 {
    let frequency_hz: Vec<f64> = base.iter().map(|(hz, _)| *hz).collect();
    let voltages = voltage(&with_load(spec, FIFTH_OHM), &frequency_hz);
    let mean_squares: Vec<(f64, f64)> = voltages
        .iter()
        .zip(base)
        .map(|(h, (_, square))| (h.norm_sqr(), *square))
        .collect();
    let base_noise = NOISE.powi(2) * base.iter().map(|(_, square)| square).sum::<f64>()
        / mean_squares.len() as f64;
    let volt_noise = NOISE.powi(2)
        * mean_squares
            .iter()
            .map(|(h, square)| h * square)
            .sum::<f64>()
        / mean_squares.len() as f64;
    let variance = mean_squares
        .iter()
        .map(|(h, square)| 2.0 * h * square * (h * base_noise + volt_noise))
        .sum::<f64>();
    variance.sqrt() / FIFTH_OHM
}

/// Mean square of each line of a record.
pub fn mean_squares(values: &[f64]) -> Vec<(f64, f64)> {
    let bins = spectrum(values);
    let square = |(hz, bin): (f64, &Complex<f64>)| {
        (hz, 2.0 * bin.norm_sqr() / (values.len() as f64).powi(2))
    };
    line_hz()
        .into_iter()
        .zip(&bins)
        .map(square)
        .filter(|(hz, _)| *hz > 1.0)
        .collect()
}

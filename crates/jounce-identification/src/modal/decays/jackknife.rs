//! Standard deviations by the jackknife.

use jounce_linalg::c64;

use crate::modal::maximum_likelihood::fit;
use crate::modal::{Band, ModalError, Mode, Pole};
use jounce_signal::spectral::student_95;

/// Computes deviations of the modes by the jackknife: the modes of all blocks except one, for each
/// block.
pub(super) fn leave_one_out(
    modes: &mut [Mode],
    mean: &[Vec<c64>],
    blocks: &[Vec<Vec<c64>>],
    band: impl Fn(&[Vec<c64>]) -> Result<Band, ModalError>,
) -> Result<(), ModalError> {
    let count = blocks.len() as f64;
    let start: Vec<Pole> = modes.iter().map(Mode::pole).collect();
    let mut estimates: Vec<Vec<Pole>> = Vec::new();
    for block in blocks {
        let mean_without = |(mean, block_mean): (&Vec<c64>, &Vec<c64>)| {
            mean.iter()
                .zip(block_mean)
                .map(|(m, b)| (m * count - b) / (count - 1.0))
                .collect()
        };
        let remaining_mean: Vec<Vec<c64>> = mean.iter().zip(block).map(mean_without).collect();
        estimates.extend(fit(&band(&remaining_mean)?, &start).map(|result| result.poles));
    }
    let factor = (estimates.len().saturating_sub(1)) as f64 / estimates.len().max(1) as f64;
    let deviation = |value: &dyn Fn(&Vec<Pole>) -> f64| {
        let average = estimates.iter().map(value).sum::<f64>() / estimates.len() as f64;
        (factor
            * estimates
                .iter()
                .map(|poles| (value(poles) - average).powi(2))
                .sum::<f64>())
        .sqrt()
    };
    for (r, mode) in modes.iter_mut().enumerate() {
        mode.frequency_deviation_hz = deviation(&|poles| poles[r].frequency_hz);
        mode.damping_deviation = deviation(&|poles| poles[r].damping_ratio);
        mode.quantile_95 = student_95(estimates.len().saturating_sub(1).max(1) as f64);
    }
    Ok(())
}

//! Standard deviations by the jackknife.

use jounce_linalg::c64;

use crate::modal::maximum_likelihood::fit;
use crate::modal::{Band, ModalError, Mode, Pole};
use jounce_signal::spectral::student_95;

/// Computes deviations of the modes by the jackknife: the modes of all blocks except one, for each
/// block.
///
/// # Errors
/// Modes that cannot be fitted without one of the blocks.
pub(super) fn leave_one_out(
    modes: &mut [Mode],
    mean: &[Vec<c64>],
    blocks: &[Vec<Vec<c64>>],
    band: impl Fn(&[Vec<c64>]) -> Result<Band, ModalError>,
) -> Result<(), ModalError> {
    let count = blocks.len() as f64;
    let start: Vec<Pole> = modes.iter().map(Mode::pole).collect();
    let mut estimates: Vec<Vec<Pole>> = Vec::new();
    for (k, block) in blocks.iter().enumerate() {
        let mean_without = |(mean, block_mean): (&Vec<c64>, &Vec<c64>)| {
            mean.iter()
                .zip(block_mean)
                .map(|(m, b)| (m * count - b) / (count - 1.0))
                .collect()
        };
        let remaining_mean: Vec<Vec<c64>> = mean.iter().zip(block).map(mean_without).collect();
        let remaining = band(&remaining_mean)?;
        let result = fit(&remaining, &start).ok_or(ModalError::LeaveOneOut {
            block: k + 1,
            blocks: blocks.len(),
        })?;
        estimates.push(result.poles);
    }
    let deviation = |value: &dyn Fn(&Vec<Pole>) -> f64| {
        let average = estimates.iter().map(value).sum::<f64>() / count;
        ((count - 1.0) / count
            * estimates
                .iter()
                .map(|poles| (value(poles) - average).powi(2))
                .sum::<f64>())
        .sqrt()
    };
    for (r, mode) in modes.iter_mut().enumerate() {
        mode.frequency_deviation_hz = deviation(&|poles| poles[r].frequency_hz);
        mode.damping_deviation = deviation(&|poles| poles[r].damping_ratio);
        mode.quantile_95 = student_95(count - 1.0);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modal::ResponseQuantity;
    use std::f64::consts::TAU;

    /// Without the second of two blocks all of whose values are zero, the other remains; without
    /// the first, nothing is left to fit, and the deviations are unknown.
    #[test]
    fn a_block_without_a_fit_is_an_error() {
        let frequency_hz: Vec<f64> = (1..=200).map(|k| 0.1 * f64::from(k)).collect();
        let pole = Pole {
            frequency_hz: 10.0,
            damping_ratio: 0.02,
        };
        let line = |f: &f64| 1.0 / (c64::new(0.0, TAU * f) - pole.complex());
        let spectrum: Vec<c64> = frequency_hz.iter().map(line).collect();
        let zero = vec![c64::new(0.0, 0.0); spectrum.len()];
        let mean: Vec<c64> = spectrum.iter().map(|value| 0.5 * value).collect();
        let mut modes = [Mode {
            frequency_hz: pole.frequency_hz,
            frequency_deviation_hz: 0.0,
            damping_ratio: pole.damping_ratio,
            damping_deviation: 0.0,
            quantile_95: 0.0,
            residue: Vec::new(),
            participation: Vec::new(),
        }];
        let band = |response: &[Vec<c64>]| {
            let (quantity, between_hz) = (ResponseQuantity::Displacement, (1.0, 20.0));
            let band = Band::new(&frequency_hz, response, &[], 1, quantity, between_hz)?;
            Ok(band.with_uniform_noise())
        };
        let blocks = [vec![spectrum], vec![zero]];
        let error = leave_one_out(&mut modes, &[mean], &blocks, band);
        assert_eq!(
            error,
            Err(ModalError::LeaveOneOut {
                block: 1,
                blocks: 2
            })
        );
    }
}

//! Standard deviations by the jackknife.

use faer::c64;

use super::likelihood::fit;
use super::{Band, ModalError, Mode, Pole};
use crate::spectral::student_95;

/// Computes deviations of the modes by the jackknife: the modes of all blocks except one, for each
/// block.
pub(super) fn leave_out(
    modes: &mut [Mode],
    mean: &[Vec<c64>],
    blocks: &[Vec<Vec<c64>>],
    band: impl Fn(&[Vec<c64>]) -> Result<Band, ModalError>,
) -> Result<(), ModalError> {
    let count = blocks.len() as f64;
    let start: Vec<Pole> = modes.iter().map(Mode::pole).collect();
    let mut left: Vec<Vec<Pole>> = Vec::new();
    for block in blocks {
        let without = |(mean, own): (&Vec<c64>, &Vec<c64>)| {
            mean.iter()
                .zip(own)
                .map(|(m, b)| (m * count - b) / (count - 1.0))
                .collect()
        };
        let rest: Vec<Vec<c64>> = mean.iter().zip(block).map(without).collect();
        left.extend(fit(&band(&rest)?, &start).map(|found| found.poles));
    }
    let factor = (left.len().saturating_sub(1)) as f64 / left.len().max(1) as f64;
    let spread = |of: &dyn Fn(&Vec<Pole>) -> f64| {
        let middle = left.iter().map(of).sum::<f64>() / left.len() as f64;
        (factor
            * left
                .iter()
                .map(|poles| (of(poles) - middle).powi(2))
                .sum::<f64>())
        .sqrt()
    };
    for (r, mode) in modes.iter_mut().enumerate() {
        mode.frequency_deviation_hz = spread(&|poles| poles[r].frequency_hz);
        mode.damping_deviation = spread(&|poles| poles[r].damping_ratio);
        mode.quantile_95 = student_95(left.len().saturating_sub(1).max(1) as f64);
    }
    Ok(())
}

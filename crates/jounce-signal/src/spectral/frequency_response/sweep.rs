//! Recognises a sweep, which drives the lines of a spectrum one after the other.

use crate::{Samples, Window};

use super::ImpactRecord;
use super::shaker::RECORD_PARTS;
use crate::spectral::{Segments, SpectralError};

/// Share of the blocks, by their squared powers, below which a line is driven by a sweep; noise
/// drives it in half of them.
const MAX_SWEEP_SHARE: f64 = 0.25;
/// Minimum share of the blocks in which a sweep drives all lines together; a hit or a burst has
/// less.
const MIN_STEADY_SHARE: f64 = 0.5;
/// Number of blocks that distinguishes a sweep from noise; lines below this share of the power of
/// the strongest are ignored.
const MIN_BLOCKS: usize = 128;
const MIN_DRIVEN_SHARE: f64 = 0.01;

/// True where the forces of all records sweep.
pub(super) fn all_sweep(records: &[ImpactRecord<'_>]) -> Result<bool, SpectralError> {
    let sweeps = records
        .iter()
        .map(|record| sweeps(&record.force))
        .collect::<Result<Vec<_>, _>>()?;
    Ok(sweeps.into_iter().all(|sweeps| sweeps))
}

/// True for a force that drives the lines one after the other.
fn sweeps(force: &Samples<'_>) -> Result<bool, SpectralError> {
    let length = force.values().len() / RECORD_PARTS / 2 * 2;
    if length < MIN_BLOCKS {
        return Ok(false);
    }
    let segments = Segments::new(length, 0.5, Window::Hann)?;
    let (mut powers, mut squares, mut totals) = (
        vec![0.0; length / 2 + 1],
        vec![0.0; length / 2 + 1],
        Vec::new(),
    );
    for start in segments.starts(force.values().len())? {
        let previous_total: f64 = powers.iter().sum();
        for (k, x) in segments
            .transform(force, start, force.mean())
            .iter()
            .enumerate()
        {
            powers[k] += x.norm_sqr();
            squares[k] += x.norm_sqr().powi(2);
        }
        totals.push(powers.iter().sum::<f64>() - previous_total);
    }
    let occupancy =
        |power: f64, square_sum: f64| power * power / (square_sum * totals.len() as f64);
    let steady = occupancy(
        totals.iter().sum(),
        totals.iter().map(|total| total * total).sum(),
    );
    let strongest = powers.iter().copied().fold(0.0, f64::max);
    let driven = powers
        .iter()
        .zip(&squares)
        .filter(|(power, _)| **power > MIN_DRIVEN_SHARE * strongest);
    let mut occupancies: Vec<f64> = driven
        .map(|(power, square_sum)| occupancy(*power, *square_sum))
        .collect();
    occupancies.sort_by(f64::total_cmp);
    Ok(steady > MIN_STEADY_SHARE
        && occupancies
            .get(occupancies.len() / 2)
            .is_some_and(|occupancy| *occupancy < MAX_SWEEP_SHARE))
}

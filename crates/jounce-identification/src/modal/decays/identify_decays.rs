//! Modes of decays.

use jounce_linalg::c64;

use super::half_spectrum::{deviations, half_spectrum, truncate};
use super::jackknife::leave_one_out;
use super::warp::{Warp, without_decay};
use crate::modal::identify::candidates;
use crate::modal::refinement::refine;
use crate::modal::{
    Band, Identification, ModalError, ModalSettings, Mode, Pole, ResponseQuantity, StablePole,
};
use crate::response::Decays;

/// Highest frequency over the rate: warped frequencies diverge towards a half.
pub(super) const MAX_FREQUENCY_RATIO: f64 = 0.45;
/// Final value of the window on the decays in which poles are sought.
const END_RATIO: f64 = 0.03;

/// Identifies the modes of decays between two frequencies, as [`crate::modal::identify()`] does for
/// responses. For correlations in blocks, the variance over the blocks weights each line, and
/// deviations are computed by leaving out one block at a time.
///
/// # Errors
/// Too few lines, decays that are zero, no stable pole, no pole with significant damping, modes that
/// cannot be fitted without one of the blocks.
///
/// # Validation
/// `tests`: exact decays that have fallen by only 45 % give their frequencies within 2e-16 and
/// damping ratios within 2e-14, relative. With noise the truth lies within the stated intervals of
/// 95 % in 93 % of 200 cases. The modes of 400 s under white noise: frequencies within 0.18 %,
/// damping ratios within 8.6 %, 17 of 18 within their intervals.
pub fn identify_decays(
    decays: &Decays,
    between_hz: (f64, f64),
    settings: ModalSettings,
) -> Result<Identification, ModalError> {
    let warp = Warp {
        rate_hz: decays.rate_hz,
    };
    let (low_hz, high_hz) = (
        between_hz.0,
        between_hz.1.min(MAX_FREQUENCY_RATIO * decays.rate_hz),
    );
    let length_s = (decays.values[0].len() - 1) as f64 / decays.rate_hz;
    let frequency_hz: Vec<f64> = (0..decays.values[0].len() / 2)
        .map(|m| m as f64 / length_s)
        .collect();
    let warped_hz: Vec<f64> = frequency_hz.iter().map(|f| warp.warp_hz(*f)).collect();
    let (lines, references) = (frequency_hz.len(), decays.references.len());
    let (diagram, start) = windowed_candidates(decays, &frequency_hz, (low_hz, high_hz), settings)?;
    let start: Vec<Pole> = start.into_iter().map(|pole| warp.warped(pole)).collect();
    let spectra = |values: &Vec<Vec<f64>>| spectra(values, decays.rate_hz);
    let blocks: Vec<Vec<Vec<c64>>> = decays.blocks.iter().map(spectra).collect();
    let mean = spectra(&decays.values);
    let deviation = truncate(&deviations(&mean, &blocks), lines);
    // White noise of a decay is white in its spectrum.
    let band = |response: &[Vec<c64>]| {
        Ok(Band::new(
            &warped_hz,
            &truncate(response, lines),
            &deviation,
            references,
            ResponseQuantity::Displacement,
            (warp.warp_hz(low_hz), warp.warp_hz(high_hz)),
        )?
        .with_uniform_noise())
    };
    let with_band_in_hz = |error| match error {
        ModalError::NoMode { .. } => ModalError::NoMode { low_hz, high_hz },
        other => other,
    };
    let mut found = refine(&band(&mean)?, diagram, &start).map_err(with_band_in_hz)?;
    if !blocks.is_empty() {
        leave_one_out(&mut found.modes, &mean, &blocks, band).map_err(with_band_in_hz)?;
    }
    warp.unwarp(&mut found);
    if found.modes.iter().all(Mode::is_doubtful) {
        return Err(ModalError::Doubtful {
            low_hz,
            high_hz,
            frequency_hz: found.modes.iter().map(|mode| mode.frequency_hz).collect(),
        });
    }
    found
        .modes
        .iter_mut()
        .for_each(|mode| mode.residue = strongest_reference(&mode.residue, references));
    Ok(found)
}

fn spectra(values: &[Vec<f64>], rate_hz: f64) -> Vec<Vec<c64>> {
    values
        .iter()
        .map(|values| half_spectrum(values, rate_hz))
        .collect()
}

/// Stabilisation diagram and stable poles of decays multiplied by a window that ends them within
/// the record: broad peaks make clear diagrams. The damping that the window adds is subtracted.
fn windowed_candidates(
    decays: &Decays,
    frequency_hz: &[f64],
    between_hz: (f64, f64),
    settings: ModalSettings,
) -> Result<(Vec<StablePole>, Vec<Pole>), ModalError> {
    let length_s = (decays.values[0].len() - 1) as f64 / decays.rate_hz;
    let decay_per_s = -END_RATIO.ln() / length_s;
    let windowed = |values: &Vec<f64>| {
        values
            .iter()
            .enumerate()
            .map(|(k, x)| x * (-decay_per_s * k as f64 / decays.rate_hz).exp())
            .collect::<Vec<f64>>()
    };
    let windowed = decays.values.iter().map(windowed).collect::<Vec<_>>();
    let band = Band::new(
        frequency_hz,
        &truncate(&spectra(&windowed, decays.rate_hz), frequency_hz.len()),
        &[],
        decays.references.len(),
        ResponseQuantity::Displacement,
        between_hz,
    )?;
    let (mut diagram, mut start) = candidates(&band, settings)?;
    diagram
        .iter_mut()
        .map(|stable| &mut stable.pole)
        .chain(&mut start)
        .for_each(|pole| *pole = without_decay(*pole, decay_per_s));
    Ok((diagram, start))
}

/// Residues of all outputs for the reference with the largest participation in a mode: its shape.
fn strongest_reference(residue: &[c64], references: usize) -> Vec<c64> {
    let residues_of = |i: usize| residue.iter().skip(i).step_by(references).copied();
    let squared_norm = |i: &usize| residues_of(*i).map(|r| r.norm_sqr()).sum::<f64>();
    (0..references)
        .max_by(|a, b| squared_norm(a).total_cmp(&squared_norm(b)))
        .map_or_else(Vec::new, |i| residues_of(i).collect())
}

//! Maximum-likelihood refinement of initial poles to modes.

use jounce_linalg::c64;

use super::maximum_likelihood::{ModalFit, fit, fit_shared};
use super::mode::normalised;
use super::poles::{MAX_DAMPING, split_close_modes};
use super::{Band, Identification, ModalError, Mode, Pole, StablePole};
use jounce_signal::NORMAL_95;
use jounce_signal::spectral::student_95;

/// Relative standard deviation of frequency above which a pole is not a mode: the stability
/// criterion between orders.
const MAX_FREQUENCY_DEVIATION: f64 = 0.01;

/// Maximum-likelihood modes from initial poles; poorly determined ones are left out, and the others
/// are fitted again.
pub(super) fn refine(
    band: &Band,
    diagram: Vec<StablePole>,
    start: &[Pole],
) -> Result<Identification, ModalError> {
    let mut result = fit(band, start).ok_or(no_mode_error(band))?;
    while let Some(retained) = well_determined(band, &result.poles, &result.deviation)? {
        result = fit(band, &retained).ok_or(no_mode_error(band))?;
    }
    let ModalFit {
        poles,
        deviation,
        residue,
        model,
        misfit,
        freedom,
        ..
    } = result;
    let modes = (0..poles.len()).map(|r| {
        mode(
            poles[r],
            deviation[r],
            freedom[r],
            residue.iter().map(|response| response[r]).collect(),
        )
    });
    identification(band, diagram, modes.collect(), model, misfit)
}

/// Maximum-likelihood modes of several references.
pub(super) fn refine_shared(
    band: &Band,
    diagram: Vec<StablePole>,
    start: &[Pole],
) -> Result<Identification, ModalError> {
    let start = split_close_modes(&diagram, start, band.inputs);
    let mut result = fit_shared(band, &start).ok_or(no_mode_error(band))?;
    while let Some(retained) = well_determined(band, &result.poles, &result.deviation)? {
        result = fit_shared(band, &retained).ok_or(no_mode_error(band))?;
    }
    let ModalFit {
        poles,
        deviation,
        residue,
        participation,
        model,
        misfit,
        freedom,
        ..
    } = result;
    let mode = |r: usize| {
        let mut mode = mode(
            poles[r],
            deviation[r],
            freedom[r],
            residue.iter().map(|output| output[r]).collect(),
        );
        mode.participation = normalised(&participation[r]);
        let largest = participation[r]
            .iter()
            .map(|b| b.norm())
            .fold(0.0, f64::max);
        mode.residue.iter_mut().for_each(|a| *a *= largest);
        mode
    };
    identification(
        band,
        diagram,
        (0..poles.len()).map(mode).collect(),
        model,
        misfit,
    )
}

fn mode(
    pole: Pole,
    (frequency_deviation_hz, damping_deviation): (f64, f64),
    freedom: Option<f64>,
    residue: Vec<c64>,
) -> Mode {
    let quantile_95 = freedom.map_or(NORMAL_95, student_95);
    let Pole {
        frequency_hz,
        damping_ratio,
    } = pole;
    let participation = vec![c64::new(1.0, 0.0)];
    Mode {
        frequency_hz,
        frequency_deviation_hz,
        damping_ratio,
        damping_deviation,
        quantile_95,
        residue,
        participation,
    }
}

/// Returns the well-determined poles where some are not; `None` where all are.
fn well_determined(
    band: &Band,
    poles: &[Pole],
    deviation: &[(f64, f64)],
) -> Result<Option<Vec<Pole>>, ModalError> {
    let is_well_determined = |(pole, deviation): &(&Pole, &(f64, f64))| {
        deviation.0 < MAX_FREQUENCY_DEVIATION * pole.frequency_hz
    };
    let retained: Vec<Pole> = poles
        .iter()
        .zip(deviation)
        .filter(is_well_determined)
        .map(|(pole, _)| *pole)
        .collect();
    if retained.is_empty() {
        return Err(no_mode_error(band));
    }
    Ok((retained.len() < poles.len()).then_some(retained))
}

pub(super) fn no_mode_error(band: &Band) -> ModalError {
    ModalError::NoMode {
        low_hz: band.low_hz,
        high_hz: band.high_hz,
    }
}

/// A pole that leaves the band or has unphysical damping after refinement is not a mode.
fn identification(
    band: &Band,
    diagram: Vec<StablePole>,
    mut modes: Vec<Mode>,
    model: Vec<Vec<c64>>,
    misfit: f64,
) -> Result<Identification, ModalError> {
    modes.retain(|mode| {
        (band.low_hz..=band.high_hz).contains(&mode.frequency_hz)
            && mode.damping_ratio < MAX_DAMPING
    });
    if modes.is_empty() {
        return Err(no_mode_error(band));
    }
    modes.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
    let (frequency_hz, measured) = (band.frequency_hz.clone(), band.response.clone());
    Ok(Identification {
        modes,
        diagram,
        frequency_hz,
        measured,
        model,
        misfit,
        unexplained: Vec::new(),
    })
}

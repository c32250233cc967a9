//! Stable poles from nested bands.
//!
//! A mode far below the upper end of a band turns the angle `pi f / f_high` of the denominator's
//! plane by little. Its acceleration is small relative to the modes above it, so it is not found.
//! Therefore poles are sought in the complete band, in its lower half, in the lower half of that,
//! and so on while there are enough lines. Each frequency is assigned to the narrowest band that
//! contains it with margin. A band that begins far from 0 has no such modes, and is searched once.

use super::plscf::from_zero;
use super::stabilisation::{SAME_MODE_DISTANCE, modes};
use super::{Pole, StablePole, diagram, poles};
use crate::modal::{Band, ModalError, ModalSettings};

/// Ratio of the upper ends of consecutive bands.
const BAND_RATIO: f64 = 0.5;
/// Poles of a band are used below this share of its upper end.
const MAX_POLE_SHARE: f64 = 0.8;

/// Returns the diagram of the poles of all bands and the stable poles, in ascending frequency.
///
/// # Errors
/// Too few lines in the complete band, responses that are zero.
pub(in crate::modal) fn stable(
    band: &Band,
    settings: ModalSettings,
) -> Result<(Vec<StablePole>, Vec<Pole>), ModalError> {
    let mut bands = vec![(f64::INFINITY, band.high_hz, poles(band, settings.order)?)];
    let mut high_hz = band.frequency_hz.last().copied().unwrap_or(band.high_hz);
    while !band.starts_far_from_zero() {
        high_hz *= BAND_RATIO;
        // A band without enough lines, or without poles, leaves its frequencies to the enclosing
        // one.
        let Ok(result) = from_zero(&band.up_to(high_hz), settings.order) else {
            break;
        };
        bands.push((MAX_POLE_SHARE * high_hz, high_hz, result));
    }
    let (mut result, mut selected) = (Vec::new(), Vec::<Pole>::new());
    let mut from_hz = 0.0;
    for (to_hz, high_hz, poles) in bands.iter().rev() {
        let is_in_range = |pole: &Pole| pole.frequency_hz > from_hz && pole.frequency_hz <= *to_hz;
        let diagram = diagram(poles, band.line_hz());
        for pole in modes(&diagram, band.low_hz, *high_hz)
            .into_iter()
            .filter(is_in_range)
        {
            // At the border both bands may have found it.
            if selected
                .last()
                .is_none_or(|last| pole.frequency_hz / last.frequency_hz - 1.0 > SAME_MODE_DISTANCE)
            {
                selected.push(pole);
            }
        }
        result.extend(
            diagram
                .into_iter()
                .filter(|stable| is_in_range(&stable.pole)),
        );
        from_hz = *to_hz;
    }
    Ok((result, selected))
}

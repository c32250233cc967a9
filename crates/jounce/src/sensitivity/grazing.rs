//! The grazing that is nearest to an orbit: on which side of it the derivatives hold.

use super::{OrbitGrazing, SensitivityResult};
use crate::error::Error;
use jounce_analysis::{DerivativeKey, Model, nearest_grazing};
use jounce_orbits::Orbit;

/// Change of a key, relative to its value, below which a grazing is near.
const NEAR: f64 = 1e-3;

/// Returns the nearest grazing, and the change of each key that leads to it.
pub fn nearest(
    base: &Model,
    orbit: &Orbit,
    keys: &[DerivativeKey<'_>],
) -> Result<(Option<OrbitGrazing>, Vec<Option<f64>>), Error> {
    let Some(found) = nearest_grazing(base, orbit, keys)? else {
        return Ok((None, vec![None; keys.len()]));
    };
    let past_m = found.turn.past_m;
    let change = |by: &Option<f64>| by.map(|by| -past_m / by).filter(|by| by.is_finite());
    let grazing = OrbitGrazing {
        stop: found.stop,
        turning_point: match found.turn.is_maximum {
            true => "maximum",
            false => "minimum",
        },
        side: match past_m > 0.0 {
            true => "contact",
            false => "no-contact",
        },
        across: found.across.name(),
    };
    Ok((
        Some(grazing),
        found.distance_by_key.iter().map(change).collect(),
    ))
}

impl SensitivityResult {
    /// Returns the side of a near grazing on which the derivatives hold, with the smallest relative
    /// change of a key that leads to it; `None` where no grazing is near.
    pub fn grazing_text(&self) -> Option<String> {
        let grazing = self.grazing.as_ref()?;
        let changes = self.keys.iter().filter_map(|one| {
            let change = one.grazing_change?;
            Some((&one.key, change / one.value))
        });
        let (key, change) = changes.min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        if change.abs() >= NEAR {
            return None;
        }
        let event = match (grazing.turning_point, grazing.side) {
            ("maximum", "contact") => "a contact vanishes",
            ("maximum", _) => "a contact appears",
            (_, "contact") => "a contact is divided",
            _ => "two contacts join",
        };
        let other_side = match (grazing.across, grazing.side) {
            ("continuous", _) => "the derivatives of the motion are the same on both sides",
            ("jump", _) => "the derivatives are those of this side, and jump at the grazing",
            (_, "contact") => {
                "the derivatives are those of this side, and grow without bound towards the grazing"
            }
            _ => "the derivatives are those of this side, and have no bound on the other",
        };
        Some(format!(
            "near a grazing at {}: {event} where {key} changes by {:.2e} %; {other_side}",
            grazing.stop,
            100.0 * change
        ))
    }
}

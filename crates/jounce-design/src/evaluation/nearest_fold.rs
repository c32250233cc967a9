//! Nearest fold of the main orbit of a design, and how far the tolerances move it.

use super::MainOrbit;
use crate::problem::Tolerance;
use crate::result::NearestFold;
use jounce_analysis::{
    BifurcationPlace, Derivative, DerivativeKey, FoldPlace, Model, farthest_hz,
    nearest_bifurcations, nearest_fold,
};
use jounce_spec::Quantity;

/// Returns the distance of the nearest fold from the frequency of the drive, Hz: that of the end of
/// the range without a fold; NaN where the branch cannot be followed.
pub fn fold_distance_hz(model: &Model, orbit: &MainOrbit) -> f64 {
    match (
        nearest_fold(model, orbit.period_cycles, &orbit.state),
        farthest_hz(model),
    ) {
        (Ok(Some(fold)), _) => fold.distance_hz,
        (Ok(None), Some(farthest_hz)) => farthest_hz,
        _ => f64::NAN,
    }
}

/// Returns the nearest fold with its scatter by tolerances, and a sentence where the branch cannot be
/// followed or another bifurcation is nearer.
pub fn examined_fold(
    model: &Model,
    orbit: &MainOrbit,
    tolerances: &[Tolerance],
) -> (Option<NearestFold>, Option<String>) {
    let Ok(found) = nearest_bifurcations(model, orbit.period_cycles, &orbit.state) else {
        let text = "the branch of the best orbit over the frequency of the drive could not be followed, so that its nearest fold is not known; `jounce branch` on the best design shows where it ends";
        return (None, Some(text.to_owned()));
    };
    let fold = found.fold.map(|fold| NearestFold {
        scatter_hz: scatter_hz(model, &fold, tolerances),
        key: fold.key,
        frequency_hz: fold.frequency_hz,
        distance_hz: fold.distance_hz,
    });
    (fold, found.nearer.map(nearer_text))
}

fn nearer_text(nearer: BifurcationPlace) -> String {
    let BifurcationPlace {
        kind,
        frequency_hz,
        distance_hz,
    } = nearer;
    format!(
        "the branch of the best orbit over the frequency of the drive has a bifurcation of the kind {} at {frequency_hz:.6} Hz, {} away and nearer than any fold: the orbit may lose its stability there (`jounce branch` shows its stable ranges)",
        kind.name(),
        Quantity::Frequency.write_rounded(distance_hz, 4)
    )
}

/// Returns the standard deviation of the frequency of a fold by tolerances, to first order; `None`
/// without tolerances, and where the derivatives are not known.
fn scatter_hz(model: &Model, fold: &FoldPlace, tolerances: &[Tolerance]) -> Option<f64> {
    if tolerances.is_empty() {
        return None;
    }
    let wanted = tolerances.iter().map(|tolerance| {
        let value = tolerance.key.get(&model.spec).map_or(0.0, f64::abs);
        DerivativeKey {
            key: &tolerance.key,
            scale: value.max(tolerance.width),
        }
    });
    let derivatives = fold.derivatives(model, &wanted.collect::<Vec<_>>()).ok()?;
    let parts = derivatives.iter().zip(tolerances);
    let part =
        |(by, tolerance): (&Derivative, &Tolerance)| by.value * tolerance.standard_deviation();
    Some(parts.map(part).fold(0.0, f64::hypot))
}

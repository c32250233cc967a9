//! The mesh is refined until the kept frequencies stand still.
//!
//! Estimated error of each frequency: its relative change in the last refinement, at least the roundoff of a double. The error of
//! the mesh that is kept is smaller still, because the error falls faster than geometrically with the number of terms.

use super::error::StructureError;
use super::solution::{Solution, Structures};

/// Most refinements tried.
const MOST_LEVELS: usize = 6;
/// Shapes are resolved to this even where the frequencies may be coarser: their error enters the response directly.
const COARSEST_SHAPE: f64 = 1e-6;

/// The solution on the first mesh that holds `tolerance`, and the estimated relative error of each kept frequency.
///
/// # Errors
/// `NotConverged`; those of [`Structures::solve`].
pub(super) fn refined<'a>(structures: &Structures<'a>, tolerance: f64) -> Result<(Solution<'a>, Vec<f64>), StructureError> {
    let shape_tolerance = tolerance.min(COARSEST_SHAPE);
    let mut coarse = structures.solve(&structures.spectral_mesh(shape_tolerance, 0))?;
    let mut least = f64::INFINITY;
    for level in 1..=MOST_LEVELS {
        let fine = structures.solve(&structures.spectral_mesh(shape_tolerance, level))?;
        let error = relative_change(&coarse.frequency_rad_s(), &fine.frequency_rad_s());
        least = error.iter().copied().fold(0.0, f64::max).min(least);
        if least <= tolerance {
            return Ok((fine, error));
        }
        coarse = fine;
    }
    Err(StructureError::NotConverged { change: least, unknowns: coarse.unknowns(), tolerance, suggestion: 10.0 * least })
}

/// `|fine - coarse| / fine`, at least the roundoff of a double; of a rigid-body mode, 0.
pub(super) fn relative_change(coarse: &[f64], fine: &[f64]) -> Vec<f64> {
    let change = |(coarse, fine): (&f64, &f64)| if *fine > 0.0 { ((fine - coarse).abs() / fine).max(f64::EPSILON) } else { 0.0 };
    coarse.iter().zip(fine).map(change).collect()
}

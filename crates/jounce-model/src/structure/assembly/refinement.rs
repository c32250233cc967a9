//! Mesh refinement until the retained frequencies converge.
//!
//! Mesh `n` is made for shapes of relative error `tolerance^(0.6 + 0.4 n)`. The error of a
//! frequency is the square of the error of its shape. Mesh 0 should therefore meet the tolerance,
//! and mesh 1 meets it for the shapes and couplings too. The estimated error of each frequency is
//! its relative change in the last refinement, at least the roundoff of a double; the true error on
//! the final mesh is far smaller.

use super::solution::{StructureSolution, Structures};
use crate::structure::error::StructureError;

/// Largest number of refinements.
const MAX_REFINEMENTS: i32 = 4;
/// Shapes are resolved to this error even if the frequencies may be coarser, because it enters the
/// response directly.
const MAX_SHAPE_ERROR: f64 = 1e-6;

/// Returns the solution on the first mesh that meets `tolerance`, and the estimated relative error
/// of each retained frequency.
///
/// # Errors
/// `NotConverged`; errors of [`Structures::solve`].
pub(in crate::structure) fn refined<'a>(
    structures: &Structures<'a>,
    tolerance: f64,
) -> Result<(StructureSolution<'a>, Vec<f64>), StructureError> {
    let on_mesh = |level: i32| {
        let shape_tolerance = tolerance
            .min(MAX_SHAPE_ERROR)
            .powf(0.6 + 0.4 * f64::from(level));
        structures.solve(&structures.spectral_mesh(shape_tolerance))
    };
    let mut coarse = on_mesh(0)?;
    let mut least = f64::INFINITY;
    for level in 1..=MAX_REFINEMENTS {
        let fine = on_mesh(level)?;
        let error = relative_change(&coarse.frequency_rad_s(), &fine.frequency_rad_s());
        least = error.iter().copied().fold(0.0, f64::max).min(least);
        if least <= tolerance {
            return Ok((fine, error));
        }
        coarse = fine;
    }
    Err(StructureError::NotConverged {
        change: least,
        unknowns: coarse.unknowns(),
        tolerance,
        suggestion: 10.0 * least,
    })
}

/// Returns `|fine - coarse| / fine`, at least the roundoff of a double; 0 for a rigid-body mode.
pub(in crate::structure) fn relative_change(coarse: &[f64], fine: &[f64]) -> Vec<f64> {
    let change = |(coarse, fine): (&f64, &f64)| {
        if *fine > 0.0 {
            ((fine - coarse).abs() / fine).max(f64::EPSILON)
        } else {
            0.0
        }
    };
    coarse.iter().zip(fine).map(change).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use jounce_spec::{Beam, Reduction, Spec};
    use std::collections::BTreeMap;

    fn cantilever(modes: usize) -> Spec {
        let beam = Beam {
            material: String::new(),
            length_m: 0.3,
            width_m: 0.03,
            thickness_m: 1e-3,
            youngs_modulus_pa: 65e9,
            density_kg_m3: 2750.0,
            root: "ground".into(),
            root_stiffness_n_m_rad: None,
            point: BTreeMap::from([("tip".into(), 0.28)]),
        };
        let reduction = Reduction {
            modes,
            mesh_tolerance: 1e-9,
        };
        Spec {
            beam: BTreeMap::from([("beam".into(), beam)]),
            reduction,
            ..Spec::default()
        }
    }

    /// The cost of a solve grows with the cube of the number of unknowns, so a change here must be
    /// intended.
    #[test]
    fn unknowns_are_few() {
        for (modes, unknowns) in [(1, 18), (8, 54), (40, 238)] {
            let spec = cantilever(modes);
            let (solution, error) = refined(&Structures::new(&spec, &[]).unwrap(), 1e-9).unwrap();
            assert_eq!(solution.unknowns(), unknowns, "{modes} modes");
            assert!(
                error.iter().all(|error| *error < 1e-11),
                "the first mesh holds the square of its shape error: {error:?}"
            );
        }
    }

    #[test]
    fn tolerance_below_roundoff_is_refused_with_the_reached_error() {
        let spec = cantilever(2);
        let error = refined(&Structures::new(&spec, &[]).unwrap(), 1e-17).unwrap_err();
        let StructureError::NotConverged {
            change,
            tolerance,
            suggestion,
            ..
        } = error
        else {
            panic!("{error}")
        };
        assert!(tolerance == 1e-17 && change < 1e-14 && suggestion > change);
    }
}

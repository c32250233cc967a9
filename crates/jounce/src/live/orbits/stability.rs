//! Stability limit of an orbit.

use jounce_analysis::BranchKind;
use jounce_orbits::Orbit;

/// True for an orbit that is neither stable nor unstable. At a bifurcation the multipliers nearest to
/// its critical value have modulus one, and all others must lie inside the unit circle. Elsewhere the
/// largest modulus is one within the error of the orbit.
pub(super) fn is_at_limit(orbit: &Orbit, bifurcation: Option<BranchKind>) -> bool {
    let (distance, critical): (fn(f64, f64) -> f64, usize) = match bifurcation {
        Some(BranchKind::Fold | BranchKind::BranchPoint) => (|re, im| (re - 1.0).hypot(im), 1),
        Some(BranchKind::PeriodDoubling) => (|re, im| (re + 1.0).hypot(im), 1),
        Some(BranchKind::NeimarkSacker) => (|re, im| (re.hypot(im) - 1.0).abs(), 2),
        _ => return orbit.is_stability_undecided(),
    };
    let mut others: Vec<(f64, f64)> = orbit
        .multipliers
        .iter()
        .map(|own| (distance(own.re, own.im), own.norm()))
        .collect();
    others.sort_by(|one, other| one.0.total_cmp(&other.0));
    others.iter().skip(critical).all(|(_, norm)| *norm < 1.0)
}

//! The stated errors of located events against a search a thousand times as accurate.

use super::label_comparison::Case;
use crate::harvesters::{bench, branches_to};
use jounce_analysis::{Bifurcation, BranchKind, OrbitMethodKind};

/// Factor on the stated errors. A tenth of the tolerance leaves a tenth of the error, and the
/// estimate is of first order.
const MARGIN: f64 = 3.0;

fn labels(method: OrbitMethodKind, tolerance: f64) -> Vec<Bifurcation> {
    let branches = branches_to(tolerance, &bench(), (11.0, 14.0), method, (0, 1));
    let labels = branches.into_iter().flat_map(|branch| branch.bifurcations);
    labels.collect()
}

#[test]
fn labels_lie_within_their_stated_errors() {
    let balance = OrbitMethodKind::HarmonicBalance { harmonics: 64 };
    for method in [OrbitMethodKind::Shooting, balance] {
        let (coarse, fine) = (labels(method, 1e-7), labels(method, 1e-10));
        let kinds = |labels: &[Bifurcation]| -> Vec<BranchKind> {
            labels.iter().map(|label| label.kind).collect()
        };
        assert_eq!(kinds(&coarse), kinds(&fine), "{method:?}");
        assert!(coarse.len() > 4, "{method:?}: {:?}", kinds(&coarse));
        for (coarse, fine) in coarse.iter().zip(&fine) {
            let [error, finer] = [coarse, fine].map(|label| label.parameter_error.unwrap());
            let difference = (coarse.at.parameter - fine.at.parameter).abs();
            let text = format!("{method:?} {:?}: {error:e}, {difference:e}", fine.kind);
            eprintln!("{text}, {finer:e}");
            assert!(difference <= MARGIN * (error + finer), "{text}");
        }
    }
}

/// A contact of a stop of 1.6e9 N/m^2 divides. Integrations at some tolerances do not separate it
/// before the separation is so deep that the key is 7e-5 Hz further.
#[test]
#[ignore = "long: runs with ./test --long"]
fn the_error_covers_a_contact_that_divides_late() {
    let case = Case::random(5).over((1.18, 1.19));
    let label = |tolerance: f64| match &case.labels(tolerance)[..] {
        [label] => {
            assert_eq!(label.kind, BranchKind::Grazing);
            (label.at.parameter, label.parameter_error.unwrap())
        }
        labels => panic!("{tolerance:e}: {} labels", labels.len()),
    };
    let (exact, _) = label(1e-9);
    let mut latest = 0.0_f64;
    for tolerance in [1e-5, 1e-6, 3e-7, 1e-7, 1e-8] {
        let (parameter, error) = label(tolerance);
        let difference = (parameter - exact).abs();
        latest = latest.max(difference);
        assert!(difference < 1.5 * error, "{difference:e}, {error:e}");
    }
    assert!(latest > 1e-5, "{latest:e}");
}

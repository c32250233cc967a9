//! Branches that no other branch leads to.

use crate::harvesters::{bench, branches_of};
use jounce::study::{BranchKind, Ending, Method};

/// Near 14 Hz the harvester has orbits of three drive cycles on a closed curve of their own. Where such a curve comes back to its start
/// it may do so a cycle earlier or later; and a step that lands on the orbit of one cycle, gone through three times, has left it.
#[test]
fn a_curve_of_three_cycles_closes_and_stays_one_of_three_cycles() {
    let found = branches_of(&bench(), (13.2, 14.4), Method::Shooting, 6, 3);
    let of_three: Vec<_> = found.iter().filter(|branch| branch.period_cycles == 3).collect();
    assert_eq!(of_three.len(), 1, "{} branches", found.len());
    let branch = of_three[0];
    let folds = branch.bifurcations.iter().filter(|found| found.kind == BranchKind::Fold).count();
    eprintln!("{} points, {folds} folds, {:?}", branch.points.len(), branch.endings);
    assert!(branch.points.iter().all(|point| !point.orbit.repeats_early()));
    assert_eq!((branch.endings.as_slice(), folds), ([Ending::Closed].as_slice(), 2));
}

//! Branches transferred to a neighbouring harvester, against those that a search finds there.

use crate::harvesters::{bench, branches};
use jounce_analysis::{
    Bifurcation, Branch, BranchKind, BranchPoint, BranchUpdate, Extrapolation, Model,
    OrbitMethodKind, Parameter, UpdatedBranches,
};
use jounce_control::Control;
use jounce_spec::SpecFile;

const RANGE: (f64, f64) = (11.5, 12.8);
const GAP: &str = "stop.tip.gap";

/// Transfers branches to a spec; also returns the number of evaluations.
fn update(
    file: &SpecFile,
    known: &[Branch],
    trend: Option<Extrapolation>,
    accuracy: f64,
) -> (UpdatedBranches, u64) {
    let control = Control::default();
    let base = Model::watched(file.spec().unwrap(), &control).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let harvester = Parameter::new(&base, &key, RANGE.1 - RANGE.0);
    let (kernel, tolerance, resolution) = (&base.kernel, 1e-9, 1e-7);
    let update = BranchUpdate {
        harvester: &harvester,
        kernel,
        range: RANGE,
        tolerance,
        accuracy,
        resolution,
        trend,
    };
    (update.run(known), control.harvesters())
}

fn points(branches: &[Branch]) -> usize {
    branches.iter().map(|branch| branch.points.len()).sum()
}

/// Bifurcations of one kind, in order of parameter.
fn labels(branches: &[Branch], kind: BranchKind) -> Vec<&Bifurcation> {
    let mut bifurcations: Vec<&Bifurcation> = branches
        .iter()
        .flat_map(|branch| &branch.bifurcations)
        .filter(|label| label.kind == kind)
        .collect();
    bifurcations.sort_by(|a, b| a.at.parameter.total_cmp(&b.at.parameter));
    bifurcations
}

/// A gap of 1.02 mm from the branches at 1 mm: no point is lost, the ends are unchanged, and a
/// located fold agrees with the search. Measured: 1.4e-11 of its frequency. The lower fold, near
/// which points overtake each other, is left to the search.
#[test]
fn an_updated_branch_has_the_folds_of_a_search() {
    let mut file = bench();
    let known = branches(&file, RANGE, OrbitMethodKind::Shooting, 0);
    file.set(GAP, "1.02 mm").unwrap();
    let reference = branches(&file, RANGE, OrbitMethodKind::Shooting, 0);
    let (updated, _) = update(&file, &known, None, 5e-8);
    eprintln!(
        "{} lost of {}, {} carried",
        updated.lost,
        points(&known),
        points(&updated.branches)
    );
    let [updated_folds, searched_folds] =
        [&updated.branches, &reference].map(|branches| labels(branches, BranchKind::Fold));
    eprintln!("{} folds of {}", updated_folds.len(), searched_folds.len());
    assert!(
        !updated_folds.is_empty()
            && updated.lost == 0
            && points(&updated.branches) == points(&known)
    );
    for fold in updated_folds {
        let near =
            |searched: &&Bifurcation| (fold.at.parameter / searched.at.parameter - 1.0).abs();
        let nearest = searched_folds
            .iter()
            .copied()
            .min_by(|a, b| near(a).total_cmp(&near(b)))
            .unwrap();
        let power = fold.at.orbit.mean_power_w / nearest.at.orbit.mean_power_w - 1.0;
        eprintln!(
            "fold at {} Hz: {:.1e}, power {power:.1e} off",
            fold.at.parameter,
            near(&nearest)
        );
        assert!(near(&nearest) < 1e-8 && power.abs() < 1e-4);
    }
}

/// From 1 via 1.01 to 1.02 mm, in two ways: where the previous change predicts the points, fewer
/// evaluations find equal orbits.
#[test]
fn the_previous_change_predicts_the_points() {
    let mut file = bench();
    let known: Vec<Branch> = branches(&file, RANGE, OrbitMethodKind::Shooting, 0)
        .iter()
        .map(|branch| branch.thinned(1e-3))
        .collect();
    file.set(GAP, "1.01 mm").unwrap();
    let (first, _) = update(&file, &known, None, 5e-4);
    file.set(GAP, "1.02 mm").unwrap();
    let (plain, evaluations) = update(&file, &first.branches, None, 5e-4);
    let (extrapolated, fewer) = update(
        &file,
        &first.branches,
        Some(Extrapolation {
            before: &known,
            reach: 1.0,
        }),
        5e-4,
    );
    let (exact, _) = update(&file, &first.branches, None, 1e-9);
    let counts = [&plain, &extrapolated, &exact].map(|updated| points(&updated.branches));
    eprintln!(
        "{counts:?} points, {evaluations} evaluations without the change before, {fewer} with it"
    );
    assert!(
        fewer < evaluations
            && plain.lost + extrapolated.lost + exact.lost == 0
            && counts[0] == counts[1]
            && counts[0] == counts[2]
    );
    let all = |updated: &UpdatedBranches| -> Vec<BranchPoint> {
        updated
            .branches
            .iter()
            .flat_map(|branch| branch.points.clone())
            .collect()
    };
    let state = |point: &BranchPoint| point.orbit.start().to_vec();
    for updated in [&plain, &extrapolated] {
        let state_error = |(a, b): (&BranchPoint, &BranchPoint)| {
            let distance: f64 = state(a)
                .iter()
                .zip(state(b))
                .map(|(a, b)| (a - b) * (a - b))
                .sum();
            distance.sqrt() / b.orbit.size()
        };
        let worst = all(updated)
            .iter()
            .zip(&all(&exact))
            .map(state_error)
            .fold(0.0, f64::max);
        eprintln!("states at most {worst:.1e} of their size off");
        assert!(worst < 2e-3);
    }
}

/// A simplified curve is accurate: between the retained points a straight line differs from it by
/// no more than the requested fraction.
#[test]
fn a_simplified_branch_draws_the_same_curve() {
    let share = 1e-3;
    let known = branches(&bench(), RANGE, OrbitMethodKind::Shooting, 0);
    for branch in &known {
        let thin = branch.thinned(share);
        let power = |point: &BranchPoint| point.orbit.mean_power_w;
        let highest = branch.points.iter().map(power).fold(0.0, f64::max);
        let mut worst = 0.0_f64;
        for point in &branch.points {
            let scaled_point = |at: &BranchPoint| {
                (
                    (at.parameter - point.parameter) / (RANGE.1 - RANGE.0),
                    (power(at) - power(point)) / highest,
                )
            };
            let nearest = thin.points.windows(2).map(|pair| {
                let (a, b) = (scaled_point(&pair[0]), scaled_point(&pair[1]));
                let chord = (b.0 - a.0, b.1 - a.1);
                let along = (-(a.0 * chord.0 + a.1 * chord.1)
                    / (chord.0 * chord.0 + chord.1 * chord.1))
                    .clamp(0.0, 1.0);
                (a.0 + along * chord.0).hypot(a.1 + along * chord.1)
            });
            worst = worst.max(nearest.fold(f64::INFINITY, f64::min));
        }
        eprintln!(
            "{} of {} points, at most {worst:.1e} off",
            thin.points.len(),
            branch.points.len()
        );
        assert!(
            worst <= share
                && thin.points.len() < branch.points.len()
                && thin.bifurcations == branch.bifurcations
        );
        assert_eq!(
            (thin.points.first(), thin.points.last()),
            (branch.points.first(), branch.points.last())
        );
    }
}

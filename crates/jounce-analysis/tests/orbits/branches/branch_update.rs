//! Branches transferred to a neighbouring harvester, against those that a search finds there.

use crate::harvesters::{bench, branches};
use jounce_analysis::{
    Branch, BranchPoint, BranchUpdate, Extrapolation, LineErrors, Model, OrbitMethodKind,
    Parameter, UpdatedBranches,
};
use jounce_control::Control;
use jounce_spec::{NumericKey, SpecFile};

const RANGE: (f64, f64) = (11.5, 12.8);
const GAP: &str = "stop.tip.gap";

/// A model of a spec and the key of the branches.
fn model(file: &SpecFile, control: &Control) -> (Model, NumericKey) {
    let base = Model::watched(file.spec().unwrap(), control).unwrap();
    (base, file.numeric_key("drive.shaker.frequency").unwrap())
}

/// Transfers branches to a spec; also returns the number of evaluations.
fn update(
    file: &SpecFile,
    known: &[Branch],
    trend: Option<Extrapolation>,
    accuracy: f64,
) -> (UpdatedBranches, u64) {
    let control = Control::default();
    let (base, key) = model(file, &control);
    let update = BranchUpdate {
        family: &Parameter::new(&base, &key, RANGE.1 - RANGE.0),
        kernel: &base.kernel,
        range: RANGE,
        tolerance: 1e-9,
        accuracy,
        trend,
    };
    (update.run(known), control.harvesters())
}

/// Errors of the lines of branches of a spec, whose points have a tolerance.
fn line_errors(file: &SpecFile, branches: &[Branch], tolerance: f64) -> Vec<Vec<f64>> {
    let (base, key) = model(file, &Control::default());
    let errors = LineErrors {
        family: &Parameter::new(&base, &key, RANGE.1 - RANGE.0),
        kernel: &base.kernel,
        range: RANGE,
        tolerance,
    };
    branches.iter().map(|branch| errors.of(branch)).collect()
}

fn points(branches: &[Branch]) -> usize {
    branches.iter().map(|branch| branch.points.len()).sum()
}

/// Coordinates of a point in the drawing in which the errors are distances.
fn drawn(point: &BranchPoint) -> [f64; 2] {
    [
        point.parameter / (RANGE.1 - RANGE.0),
        0.2 * point.orbit.mean_power_w.ln(),
    ]
}

/// Returns the distance of a place from the line between two points.
fn to_line([x, y]: [f64; 2], pair: &[BranchPoint]) -> f64 {
    let [[a, b], [c, d]] = [drawn(&pair[0]), drawn(&pair[1])];
    let square = (c - a).powi(2) + (d - b).powi(2);
    let share = (((x - a) * (c - a) + (y - b) * (d - b)) / square).clamp(0.0, 1.0);
    (a + share * (c - a) - x).hypot(b + share * (d - b) - y)
}

/// A gap of 1.02 mm from the branches at 1 mm: no point is lost, and no line is farther from the
/// curves of a search than its error. The search is known up to the errors of its own lines.
#[test]
fn a_line_of_an_updated_branch_is_as_near_to_the_search_as_its_error() {
    let mut file = bench();
    let known: Vec<Branch> = branches(&file, RANGE, OrbitMethodKind::Shooting, 0)
        .iter()
        .map(|branch| branch.thinned(1e-3))
        .collect();
    file.set(GAP, "1.02 mm").unwrap();
    let reference = branches(&file, RANGE, OrbitMethodKind::Shooting, 0);
    let reference_errors = line_errors(&file, &reference, 1e-10);
    let (updated, _) = update(&file, &known, None, 5e-4);
    assert!(updated.lost == 0 && points(&updated.branches) == points(&known));
    let to_reference = |place: [f64; 2]| {
        let lines = reference.iter().zip(&reference_errors);
        let all = lines.flat_map(|(branch, errors)| branch.points.windows(2).zip(errors));
        all.map(|(pair, error)| (to_line(place, pair), *error))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap()
    };
    let (mut near, mut lines) = (0, 0);
    for (branch, errors) in updated
        .branches
        .iter()
        .zip(line_errors(&file, &updated.branches, 1e-9))
    {
        for (pair, error) in branch.points.windows(2).zip(errors) {
            let [from, to] = [drawn(&pair[0]), drawn(&pair[1])];
            for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
                let place = [0, 1].map(|k| from[k] + share * (to[k] - from[k]));
                let (distance, own) = to_reference(place);
                assert!(
                    distance <= error + own,
                    "{place:?}: {distance:.1e} {error:.1e} {own:.1e}"
                );
            }
            near += usize::from(error < 0.01);
            lines += 1;
        }
    }
    eprintln!("{near} of {lines} lines within 0.01");
    assert!(near as f64 > 0.95 * lines as f64);
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

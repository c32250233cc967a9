//! Isolated branches.

use crate::harvesters::{bench, branches_of};
use jounce_analysis::{
    BandwidthSearch, BranchKind, BranchSearch, Model, OrbitMethodKind, Parameter, Termination,
};
use jounce_spec::SpecFile;

/// Near 14 Hz the harvester has orbits of three drive cycles on an isolated closed curve. Such a
/// curve may close with a shift of a cycle. A step that lands on the orbit of one cycle, traversed
/// three times, has left the curve.
#[test]
fn a_curve_of_three_cycles_closes_and_stays_one_of_three_cycles() {
    let branches_found = branches_of(&bench(), (13.2, 14.4), OrbitMethodKind::Shooting, 6, 3);
    let of_three: Vec<_> = branches_found
        .iter()
        .filter(|branch| branch.period_cycles == 3)
        .collect();
    assert_eq!(of_three.len(), 1, "{} branches", branches_found.len());
    let branch = of_three[0];
    let folds = branch
        .bifurcations
        .iter()
        .filter(|label| label.kind == BranchKind::Fold)
        .count();
    eprintln!(
        "{} points, {folds} folds, {:?}",
        branch.points.len(),
        branch.endings
    );
    assert!(
        branch
            .points
            .iter()
            .all(|point| !point.orbit.repeats_early())
    );
    assert_eq!(
        (branch.endings.as_slice(), folds),
        ([Termination::Closed].as_slice(), 2)
    );
}

/// At 12 Hz and 20 N the large orbit coexists with a small one that attracts every run from rest.
/// Over the gap the search finds it from a ramped-down drive, and its fold agrees with the branch
/// over the amplitude at that gap.
#[test]
fn a_large_response_next_to_a_small_one_is_found() {
    let mut file = bench();
    file.set("drive.shaker.frequency", "12 Hz").unwrap();
    file.set("drive.shaker.amplitude", "20 N").unwrap();
    let over = |file: &SpecFile, key: &str, range: (f64, f64)| {
        let base = Model::new(file.spec().unwrap()).unwrap();
        let key = file.numeric_key(key).unwrap();
        let parameter = Parameter::new(&base, &key, range.1 - range.0);
        let method = OrbitMethodKind::Shooting;
        let search = BranchSearch {
            base: &base,
            parameter: &parameter,
            range,
            method,
            tolerance: 1e-9,
            seeds: 4,
            longest_period: 1,
        };
        let branches_found = search.run().unwrap();
        let folds = branches_found
            .iter()
            .flat_map(|branch| &branch.bifurcations)
            .filter(|label| label.kind == BranchKind::Fold);
        folds
            .map(|label| (label.at.parameter, label.at.orbit.mean_power_w))
            .max_by(|a, b| a.1.total_cmp(&b.1))
    };
    let (gap_m, power_w) = over(&file, "stop.tip.gap", (0.5e-3, 3e-3)).unwrap();
    file.set("stop.tip.gap", &format!("{gap_m} m")).unwrap();
    let (amplitude_n, other_w) = over(&file, "drive.shaker.amplitude", (10.0, 60.0)).unwrap();
    eprintln!(
        "fold at {gap_m:.9} m, {power_w:.9e} W; over the amplitude at {amplitude_n:.9} N, {other_w:.9e} W"
    );
    assert!(
        power_w > 5e-4
            && (amplitude_n / 20.0 - 1.0).abs() < 1e-7
            && (other_w / power_w - 1.0).abs() < 1e-3
    );
}

/// At 12.30122 Hz, just below the fold, a range may also begin: 1.751276e-3 W, computed by another
/// program.
#[test]
fn a_large_response_at_the_end_of_a_range_is_found() {
    let file = bench();
    for method in [
        OrbitMethodKind::Shooting,
        OrbitMethodKind::HarmonicBalance { harmonics: 64 },
    ] {
        let branches_found = branches_of(&file, (12.301_22, 12.6), method, 1, 1);
        let ends = branches_found
            .iter()
            .flat_map(|branch| [branch.points.first(), branch.points.last()])
            .flatten();
        let stable = ends
            .filter(|end| end.parameter == 12.301_22 && end.orbit.is_stable())
            .map(|end| end.orbit.mean_power_w);
        let power_w = stable.fold(0.0, f64::max);
        eprintln!("{method:?}: {power_w:.9e} W");
        assert!((power_w / 1.751_276e-3 - 1.0).abs() < 2e-6);
    }
}

/// Checks the labels, the end and the stable width of the curve of three cycles.
fn check_the_curve_of_three_cycles(search: &BranchSearch, name: &str) {
    let of_three: Vec<_> = search
        .run()
        .unwrap()
        .into_iter()
        .filter(|branch| branch.period_cycles == 3)
        .collect();
    let [branch] = &of_three[..] else {
        panic!("{} branches", of_three.len())
    };
    let mut kinds: Vec<BranchKind> = branch.bifurcations.iter().map(|label| label.kind).collect();
    kinds.sort_by_key(|kind| kind.name());
    assert_eq!(
        kinds,
        [[BranchKind::Fold; 2].as_slice(), &[BranchKind::Grazing; 4]].concat(),
        "{name}"
    );
    assert_eq!(branch.endings, [Termination::Closed], "{name}");
    let folds = branch
        .bifurcations
        .iter()
        .filter(|label| label.kind == BranchKind::Fold)
        .map(|label| label.at.parameter);
    let [low, high] = [
        folds.clone().fold(f64::INFINITY, f64::min),
        folds.fold(0.0, f64::max),
    ];
    let widths = BandwidthSearch {
        base: search.base,
        parameter: search.parameter,
        range: search.range,
        tolerance: search.tolerance,
    }
    .run(&of_three);
    let width = widths.branches[0].as_ref().unwrap();
    eprintln!("{name}: {low:.9} to {high:.9}, {width:?}");
    assert!(
        (width.width - (high - low)).abs() <= width.width_error + 1e-7 && width.width_error < 1e-5
    );
}

/// Both ends of that curve are sharp folds, where a long step may jump to the opposite sheet.
/// Continuation would then reverse and return to its start in the wrong direction. By both methods
/// and at every tolerance the labels are equal, and the curve is stable from fold to fold.
#[test]
#[ignore = "long: runs with ./test --long"]
fn no_step_lands_beyond_a_fold() {
    let (file, range) = (bench(), (4.0, 20.0));
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    for method in [
        OrbitMethodKind::Shooting,
        OrbitMethodKind::HarmonicBalance { harmonics: 64 },
    ] {
        for tolerance in [1e-8, 5e-10, 1e-10] {
            let search = BranchSearch {
                base: &base,
                parameter: &parameter,
                range,
                method,
                tolerance,
                seeds: 12,
                longest_period: 3,
            };
            check_the_curve_of_three_cycles(&search, &format!("{method:?} {tolerance:e}"));
        }
    }
}

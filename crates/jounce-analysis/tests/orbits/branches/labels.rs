//! Labels of a branch: equal for both methods and every tolerance, each listed once.

use crate::harvesters::{bench, branches, branches_of};
use jounce_analysis::{
    BandLimit, BandwidthSearch, BranchKind, BranchSearch, Model, OrbitMethodKind, Parameter,
    Termination,
};
use jounce_spec::SpecFile;

const METHODS: [OrbitMethodKind; 2] = [
    OrbitMethodKind::Shooting,
    OrbitMethodKind::HarmonicBalance { harmonics: 64 },
];

/// A range that ends 1.8 mHz, 0.3 mHz and 20 uHz below a fold: the branch reaches the edge on its
/// original side, and both methods find equal power there.
#[test]
fn a_branch_that_leaves_the_range_below_a_fold_ends_on_the_edge() {
    let complete = branches(&bench(), (10.5, 12.6), OrbitMethodKind::Shooting, 0);
    let folds = complete
        .iter()
        .flat_map(|branch| &branch.bifurcations)
        .filter(|label| label.kind == BranchKind::Fold);
    let fold = folds
        .map(|label| &label.at)
        .max_by(|a, b| a.parameter.total_cmp(&b.parameter))
        .unwrap();
    for below in [1.8e-3, 3e-4, 2e-5] {
        let edge = fold.parameter - below;
        let powers_w = METHODS.map(|method| {
            let branches_found = branches(&bench(), (10.5, edge), method, 0);
            assert!(
                branches_found.iter().all(|branch| branch
                    .endings
                    .iter()
                    .all(|ending| *ending == Termination::Range)),
                "{method:?} {edge}"
            );
            let ends = branches_found
                .iter()
                .flat_map(|branch| [branch.points.first(), branch.points.last()])
                .flatten();
            let ends: Vec<_> = ends.collect();
            assert!(
                ends.iter()
                    .all(|end| end.parameter == 10.5 || end.parameter == edge),
                "{method:?} {edge}"
            );
            // On the stable side of the fold the power is larger.
            let at_edge = ends
                .iter()
                .filter(|end| end.parameter == edge && end.orbit.is_stable());
            at_edge
                .map(|end| end.orbit.mean_power_w)
                .fold(0.0, f64::max)
        });
        eprintln!(
            "{below} Hz below: {:.9e} W, fold {:.9e} W",
            powers_w[0], fold.orbit.mean_power_w
        );
        assert!(
            powers_w[0] > fold.orbit.mean_power_w && (powers_w[0] / powers_w[1] - 1.0).abs() < 1e-5,
            "{powers_w:?}"
        );
    }
}

/// Near 5.797 Hz a contact whose force begins with a jump starts with the period. There the
/// shooting state has a kink and the harmonics of the displacement do not.
#[test]
#[ignore = "long: runs with ./test --long"]
fn a_branch_continues_where_a_contact_begins_with_the_period() {
    let damped = include_str!("../../../../../bench/plant.toml")
        .replace(
            "law = \"hertz\"",
            "law = \"kelvin-voigt\"\ndamping = \"0.3 N s/m\"",
        )
        .replace("stiffness = \"1000 N/m^1.5\"", "stiffness = \"100 N/m\"");
    let [shooting, balance] = METHODS.map(|method| {
        let branches_found = branches(&SpecFile::from_text(damped.clone()), (4.0, 20.0), method, 0);
        let [branch] = &branches_found[..] else {
            panic!("{method:?}: {} branches", branches_found.len())
        };
        assert_eq!(branch.endings, [Termination::Range], "{method:?}");
        let mut labels: Vec<(BranchKind, f64)> = branch
            .bifurcations
            .iter()
            .map(|label| (label.kind, label.at.parameter))
            .collect();
        labels.sort_by(|a, b| a.1.total_cmp(&b.1));
        labels
    });
    let distance_hz = shooting
        .iter()
        .zip(&balance)
        .map(|(a, b)| (a.1 - b.1).abs())
        .fold(0.0, f64::max);
    eprintln!("{distance_hz:e} Hz apart: {shooting:?}");
    assert!(
        shooting
            .iter()
            .map(|label| label.0)
            .eq(balance.iter().map(|label| label.0)),
        "{shooting:?} {balance:?}"
    );
    assert!(shooting.len() == 10 && distance_hz < 1e-4, "{distance_hz}");
}

/// Where a doubled branch returns to its parent, the only label is the doubling of the parent.
#[test]
fn a_doubled_branch_reaches_from_doubling_to_doubling_without_labels_there() {
    let file = bench();
    for method in METHODS {
        let branches_found = branches_of(&file, (4.0, 5.2), method, 0, 2);
        let (doubled, parents): (Vec<_>, Vec<_>) =
            (branches_found.iter()).partition(|branch| branch.period_cycles == 2);
        let doublings: Vec<f64> = (parents.iter().flat_map(|branch| &branch.bifurcations))
            .filter(|label| label.kind == BranchKind::PeriodDoubling)
            .map(|label| label.at.parameter)
            .collect();
        let [branch] = doubled[..] else {
            panic!("{} doubled branches", doubled.len());
        };
        let kinds: Vec<BranchKind> = branch.bifurcations.iter().map(|label| label.kind).collect();
        assert_eq!(branch.endings, [Termination::Merged, Termination::Merged]);
        let mut ends = [&branch.points[0], branch.points.last().unwrap()];
        ends.sort_by(|one, two| one.parameter.total_cmp(&two.parameter));
        assert_eq!(doublings.len(), 2);
        for (end, doubling) in ends.iter().zip(&doublings) {
            assert!(
                (end.parameter - doubling).abs() < 1e-3,
                "{} {doubling}",
                end.parameter
            );
        }
        // The parent strikes the stop twice per period at both doublings. So grazings that add a contact
        // and those that remove one are equal in number.
        assert_eq!(ends.map(|end| end.orbit.contacts), [4, 4]);
        assert_eq!(
            kinds,
            [
                BranchKind::Grazing,
                BranchKind::Fold,
                BranchKind::Grazing,
                BranchKind::Fold
            ]
        );
    }
}

/// A range that ends at the grazing of the low branch, where a branch of four cycles begins. The
/// stable part ends at its fold, whether or not continuation can recompute the curve between the
/// two points about it.
#[test]
fn a_bandwidth_ends_with_stability_at_a_fold() {
    let file = bench();
    let range = (12.9, 13.340_123_836);
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    let tolerance = 1e-9;
    for method in METHODS {
        let search = BranchSearch {
            base: &base,
            parameter: &parameter,
            range,
            method,
            tolerance,
            seeds: 0,
            longest_period: 4,
        };
        let branches_found = search.run().unwrap();
        let widths = BandwidthSearch {
            base: &base,
            parameter: &parameter,
            range,
            tolerance,
        }
        .run(&branches_found);
        let (branch, width) = branches_found
            .iter()
            .zip(&widths.branches)
            .find(|(branch, _)| branch.period_cycles == 4)
            .unwrap();
        let fold = branch
            .bifurcations
            .iter()
            .find(|label| label.kind == BranchKind::Fold)
            .unwrap()
            .at
            .parameter;
        let edges: Vec<_> = width
            .iter()
            .flat_map(|width| &width.intervals)
            .flat_map(|one| [one.from, one.to])
            .collect();
        let edge = edges
            .iter()
            .min_by(|a, b| {
                (a.parameter - fold)
                    .abs()
                    .total_cmp(&(b.parameter - fold).abs())
            })
            .unwrap();
        eprintln!("{method:?}: fold {fold:.9}, {edge:?}");
        assert!(
            edge.at == BandLimit::Stability
                && (edge.parameter - fold).abs() <= edge.parameter_error + 1e-8,
            "{edge:?}"
        );
    }
}

//! Jump frequencies.

use super::{HARVESTER, fit_and_compare, free_keys, relative_deviation, spec};
use jounce_analysis::{BranchKind, BranchSearch, Model, OrbitMethodKind, Parameter};
use jounce_experiment::fit::{Features, JumpFeature};
use jounce_spec::NumericKey;

const RUN: &str = "
[stop.tip]
at = \"beam.end\"
gap = \"0.2 mm\"
law = \"spring\"
stiffness = \"300 N/m\"

[drive.shaker]
kind = \"base-acceleration\"
amplitude = \"6 m/s^2\"
frequency = \"80 Hz\"

[run]
tolerance = 1e-6
";

/// A fold of the true harvester, shifted by 0.1 %.
#[test]
fn the_stiffness_of_a_stop_comes_back_from_a_jump() {
    let text = format!("{HARVESTER}{RUN}").replace("modes = 2", "modes = 1");
    let (_, spec) = spec(&text, &[("stop.tip.stiffness", "330 N/m")]);
    let prepared = Model::new(spec).expect("a harvester");
    let key = NumericKey::find(&prepared.spec, "drive.shaker.frequency").expect("a key");
    let range = (60.0, 95.0);
    let parameter = Parameter::new(&prepared, &key, range.1 - range.0);
    let search = BranchSearch {
        base: &prepared,
        parameter: &parameter,
        range,
        method: OrbitMethodKind::Shooting,
        tolerance: 1e-6,
        seeds: 0,
        longest_period: 1,
    };
    let branches = search.run().unwrap_or_else(|fault| panic!("{fault}"));
    let folds: Vec<f64> = branches
        .iter()
        .flat_map(|branch| &branch.bifurcations)
        .filter(|label| label.kind == BranchKind::Fold)
        .map(|fold| fold.at.parameter)
        .collect();
    eprintln!("folds at {folds:.4?} Hz");
    let highest = folds.iter().copied().fold(0.0, f64::max);
    let feature = JumpFeature {
        over: "drive.shaker.frequency".to_owned(),
        at: format!("{} Hz", highest * 1.001),
        between: ["60 Hz".to_owned(), "95 Hz".to_owned()],
        deviation: relative_deviation(0.001),
        set: Vec::new(),
    };
    let features = Features {
        free: free_keys(&[("stop.tip.stiffness", 0.3)]),
        jumps: vec![feature],
        ..Features::default()
    };
    fit_and_compare(&text, &features, &[330.0], 0.05);
}

//! Mean powers over the load.

use super::{HARVESTER, fit_and_compare, free_keys, relative_deviation, spec, with_noise};
use jounce_analysis::Model;
use jounce_analysis::run::{RunPlan, simulate};
use jounce_experiment::fit::{Features, PowerFeature};
use std::path::Path;

const RUN: &str = "
[drive.shaker]
kind = \"base-acceleration\"
amplitude = \"2 m/s^2\"
frequency = \"60 Hz\"

[run]
start = \"linear\"
duration = \"0.1 s\"
average_over = \"0.1 s\"
";
const LOADS: [&str; 5] = ["5 kohm", "20 kohm", "50 kohm", "150 kohm", "600 kohm"];

/// Noise of 2 %: the power of a patch over the load determines its coupling and its capacitance.
#[test]
fn coupling_and_capacitance_come_back_from_powers_over_the_load() {
    let text = format!("{HARVESTER}{RUN}");
    let power = |load: &&str| {
        let (_, spec) = spec(
            &text,
            &[
                ("patch.mfc.d31", "-190 pC/N"),
                ("patch.mfc.capacitance", "50 nF"),
                ("circuit.load.resistance", load),
            ],
        );
        let prepared = Model::new(spec).expect("a harvester");
        let start = prepared.start(Path::new(".")).expect("a start");
        let kernel = prepared.from_state(&start).expect("a kernel");
        simulate(&kernel, &start, &RunPlan::of(&prepared.spec.run, 0.0))
            .expect("a run")
            .mean_power_w
    };
    let truth: Vec<f64> = LOADS.iter().map(power).collect();
    let feature = PowerFeature {
        over: "circuit.load.resistance".to_owned(),
        values: LOADS.iter().map(|load| (*load).to_owned()).collect(),
        mean_power_w: with_noise(&truth, 0.02, 3),
        deviation: relative_deviation(0.02),
        set: vec![("drive.shaker.frequency".to_owned(), "60 Hz".to_owned())],
    };
    let features = Features {
        free: free_keys(&[("patch.mfc.d31", 0.3), ("patch.mfc.capacitance", 0.3)]),
        powers: vec![feature],
        ..Features::default()
    };
    let result = fit_and_compare(&text, &features, &[-190e-12, 50e-9], 0.05);
    assert_eq!(result.features.len(), 5);
    assert!(
        result.features[2].name.contains("50 kohm")
            && result
                .features
                .iter()
                .all(|feature| feature.errors().1.abs() < 0.06),
        "{result:?}"
    );
}

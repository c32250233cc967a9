//! A voltage history of a run with impacts.

use super::{HARVESTER, free, given, recovered, spec};
use jounce::linear::Response;
use jounce::march::Watch;
use jounce::run::{RunPlan, simulate};
use jounce::study::Prepared;
use jounce_measure::fit::{Features, HistoryFeature};
use jounce_measure::rig::{Sensor, ShakerTest, Wander, shaker_test};
use jounce_measure::write::write;
use std::path::Path;

const RUN: &str = "
[stop.tip]
at = \"beam.end\"
gap = \"0.2 mm\"
law = \"spring\"
stiffness = \"4000 N/m\"

[drive.shaker]
kind = \"base-acceleration\"
amplitude = \"12 m/s^2\"
frequency = \"55 Hz\"

[run]
duration = \"0.16 s\"
average_over = \"0.1 s\"
";

/// The first 0.16 s from rest, which strike the stop, recorded with noise of 3 %.
#[test]
fn gap_and_stiffness_of_a_stop_come_back_from_a_voltage() {
    let text = format!("{HARVESTER}{RUN}");
    let (_, spec) = spec(&text, &[("stop.tip.gap", "0.21 mm"), ("stop.tip.stiffness", "5000 N/m")]);
    let prepared = Prepared::new(spec).expect("a harvester");
    let start = prepared.start(Path::new(".")).expect("a start");
    let kernel = prepared.from_state(&start).expect("a kernel");
    let answer = simulate(&kernel, &start, &RunPlan::of(&prepared.spec.run, 0.16)).expect("a run");
    eprintln!("{} contacts", answer.contacts);
    assert!(answer.contacts >= 3);
    let test = ShakerTest {
        rate_hz: 1000.0,
        duration_s: 0.16,
        before_s: 0.0,
        starts: vec![(0.0, start)],
        wander: Wander::NONE,
        accelerometers: Vec::new(),
        sensor: Sensor { noise_ratio: 0.03, bits: Some(14) },
        seed: 2,
    };
    let record = shaker_test(&prepared.spec, &kernel.plant.system.modes, &test, &Watch::default()).expect("a record");
    let folder = tempfile::tempdir().expect("a folder");
    write(&record, &folder.path().join("run.csv")).expect("a file");
    let feature = HistoryFeature {
        file: "run.csv".into(),
        channel: "mfc.voltage".to_owned(),
        output: Response::Voltage("mfc".to_owned()),
        deviation: given(0.03),
        set: Vec::new(),
    };
    let features = Features {
        free: free(&[("stop.tip.gap", 0.1), ("stop.tip.stiffness", 0.3)]),
        histories: vec![feature],
        folder: folder.path().to_owned(),
        ..Features::default()
    };
    let answer = recovered(&text, &features, &[0.21e-3, 5000.0], 0.05);
    let (before, after) = answer.curves[0].errors();
    eprintln!("{:.2} % off before, {:.2} % after, rms", 100.0 * before, 100.0 * after);
    assert!(before > 0.05 && (0.02..0.04).contains(&after), "{before} {after}");
}

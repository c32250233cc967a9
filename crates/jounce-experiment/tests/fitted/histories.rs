//! A voltage history of a run with impacts.

use super::{HARVESTER, fit_and_compare, free_keys, relative_deviation, spec};
use jounce_analysis::Model;
use jounce_analysis::run::{RunPlan, simulate};
use jounce_control::Control;
use jounce_data::recording::{Grid, Recording};
use jounce_data::write::write;
use jounce_experiment::fit::{Features, HistoryFeature, fit};
use jounce_experiment::rig::{Disturbance, Sensor, ShakerTest, shaker_test};
use jounce_model::linear::FrfOutput;
use std::path::Path;
use tempfile::TempDir;

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

/// The first 0.16 s from rest of the harvester with another stop, which it strikes, recorded with
/// noise of 3 %.
fn simulated_record(text: &str) -> Recording {
    let (_, spec) = spec(
        text,
        &[
            ("stop.tip.gap", "0.21 mm"),
            ("stop.tip.stiffness", "5000 N/m"),
        ],
    );
    let prepared = Model::new(spec).expect("a harvester");
    let start = prepared.start(Path::new(".")).expect("a start");
    let kernel = prepared.from_state(&start).expect("a kernel");
    let result = simulate(&kernel, &start, &RunPlan::of(&prepared.spec.run, 0.16)).expect("a run");
    eprintln!("{} contacts", result.contacts);
    assert!(result.contacts >= 3);
    let test = ShakerTest {
        rate_hz: 1000.0,
        duration_s: 0.16,
        before_s: 0.0,
        starts: vec![(0.0, start)],
        disturbance: Disturbance::NONE,
        accelerometers: Vec::new(),
        sensor: Sensor {
            noise_ratio: 0.03,
            bits: Some(14),
        },
        seed: 2,
    };
    shaker_test(
        &prepared.spec,
        &kernel.plant.system.modes,
        &test,
        &Control::default(),
    )
    .expect("a record")
}

/// A voltage in `run.csv` of a folder, and the stop to be identified from it.
fn features(folder: &Path, begins_s: Option<f64>) -> Features {
    let feature = HistoryFeature {
        file: "run.csv".into(),
        channel: "mfc.voltage".to_owned(),
        output: FrfOutput::Voltage("mfc".to_owned()),
        deviation: relative_deviation(0.03),
        begins_s,
        set: Vec::new(),
    };
    Features {
        free: free_keys(&[("stop.tip.gap", 0.1), ("stop.tip.stiffness", 0.3)]),
        histories: vec![feature],
        folder: folder.to_owned(),
        ..Features::default()
    }
}

#[test]
fn gap_and_stiffness_of_a_stop_come_back_from_a_voltage() {
    let text = format!("{HARVESTER}{RUN}");
    let folder = tempfile::tempdir().expect("a folder");
    write(&simulated_record(&text), &folder.path().join("run.csv")).expect("a file");
    let result = fit_and_compare(
        &text,
        &features(folder.path(), None),
        &[0.21e-3, 5000.0],
        0.05,
    );
    let (before, after) = result.curves[0].errors();
    eprintln!(
        "{:.2} % off before, {:.2} % after, rms",
        100.0 * before,
        100.0 * after
    );
    assert!(
        before > 0.05 && (0.02..0.04).contains(&after),
        "{before} {after}"
    );
    assert!(
        result
            .warnings
            .iter()
            .all(|warning| !warning.contains("begins")),
        "{:?}",
        result.warnings
    );
}

/// A folder with the recording without its first 50 ms, by a clock.
fn without_its_first_50_ms(complete: &Recording, clock_s: f64) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let mut part = Recording {
        grid: Grid::even(clock_s + 0.05, 1e-3, complete.grid.len() - 50).expect("a grid"),
        ..complete.clone()
    };
    part.channels
        .iter_mut()
        .for_each(|channel| drop(channel.values.drain(..50)));
    write(&part, &folder.path().join("run.csv")).expect("a file");
    folder
}

/// The recording without its first 50 ms. Its time stamps give an equally good fit, with a warning.
/// A clock that was not set needs `begins`, which gives an equal result. With `begins` at the start
/// of the run the fit is poor.
#[test]
fn a_record_that_begins_later_is_compared_at_its_times() {
    let text = format!("{HARVESTER}{RUN}");
    let complete = simulated_record(&text);
    let cut = |clock_s: f64| without_its_first_50_ms(&complete, clock_s);
    let from_zero = cut(0.0);
    let result = fit_and_compare(
        &text,
        &features(from_zero.path(), None),
        &[0.21e-3, 5000.0],
        0.05,
    );
    assert!(
        result.warnings.iter().any(
            |warning| warning.contains("its first stamp, 0.05 s, is read as a time of the run")
        ),
        "{result:?}"
    );
    assert!(
        (result.curves[0].at[0] - 0.05).abs() < 1e-12 && result.curves[0].errors().1 < 0.04,
        "{result:?}"
    );
    let (file, spec) = spec(&text, &[]);
    let try_fit = |features: &Features| {
        fit(&file, &spec, features, Path::new("."), &Control::default()).map(|(result, _)| result)
    };
    let clock = cut(3600.0);
    let message = try_fit(&features(clock.path(), None))
        .expect_err("beyond the run")
        .to_string();
    assert!(
        message.contains("from 3600.05 to")
            && message.contains("run.duration = 0.16 s")
            && message.contains("begins = \"0 s\""),
        "{message}"
    );
    let early = try_fit(&features(cut(-1.0).path(), None))
        .expect_err("before the run")
        .to_string();
    assert!(
        early.contains("its first stamp is -0.95 s, before the run starts"),
        "{early}"
    );
    let with_begins = try_fit(&features(clock.path(), Some(0.05))).expect("a fit");
    for (key, by_stamps) in with_begins.keys.iter().zip(&result.keys) {
        assert!(
            (key.after / by_stamps.after - 1.0).abs() < 1e-6,
            "{key:?} {by_stamps:?}"
        );
    }
    let error = try_fit(&features(from_zero.path(), Some(0.0)))
        .map_or(f64::INFINITY, |result| result.curves[0].errors().1);
    eprintln!("taken from the start of the run: {error:.2} off");
    assert!(error > 0.1, "{error}");
}

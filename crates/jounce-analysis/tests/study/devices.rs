//! Devices behind regulators as columns of studies.

use crate::example_folder;
use jounce_analysis::Model;
use jounce_analysis::run::{RunPlan, simulate};
use jounce_analysis::study::Study;
use jounce_control::Control;
use jounce_io::table::Table;
use jounce_spec::SpecFile;

const SET: [(&str, &str); 2] = [("run.duration", "30 s"), ("run.average_over", "20 s")];

/// Table of a study of the wireless sensor at two strengths of the vibration.
fn table(quantity: &str) -> Table {
    let folder = example_folder().join("../wireless-sensor");
    let set = SET.map(|(key, value)| format!("\"{key}\" = \"{value}\"\n"));
    let text = format!(
        "spec = \"harvester.toml\"\npoints_per_part = 2\n[set]\n{}[vary]\n\"drive.base.psd\" = \"0.0001 g^2/Hz, 0.002 g^2/Hz\"\n[quantity]\n{quantity}\n",
        set.concat()
    );
    let study = Study::parse(&text, &folder).unwrap();
    study.part(0, &Control::default()).unwrap().unwrap()
}

/// A weak vibration never starts the sensor; a strong one does, and each column is that of the run.
#[test]
fn a_run_has_the_columns_of_its_device() {
    let table = table("command = \"run\"");
    let column = |name: &str| table.floats(name).unwrap();
    assert_eq!(column("device_on_fraction")[0], 0.0);
    assert_eq!(column("device_cold_start_s")[0], f64::INFINITY);

    let path = example_folder().join("../wireless-sensor/harvester.toml");
    let mut file = SpecFile::read(path).unwrap();
    for (key, value) in [SET[0], SET[1], ("drive.base.psd", "0.002 g^2/Hz")] {
        file.set(key, value).unwrap();
    }
    let model = Model::new(file.spec().unwrap()).unwrap();
    let start = model.start(&example_folder()).unwrap();
    let kernel = model.from_state(&start).unwrap();
    let result = simulate(&kernel, &start, &RunPlan::of(&model.spec.run, 0.0)).unwrap();
    let device = &result.devices[0];
    assert!(device.on_fraction > 0.5, "{device:?}");
    assert_eq!(column("device_on_fraction")[1], device.on_fraction);
    assert_eq!(
        column("device_cold_start_s")[1],
        device.cold_start_s.unwrap()
    );
    assert_eq!(
        column("device_longest_outage_s")[1],
        device.longest_outage_s
    );
    assert_eq!(column("device_margin_w")[1], device.margin_w);
}

#[test]
fn an_ensemble_has_the_columns_of_its_device() {
    let table = table("command = \"ensemble\"\nmembers = 2");
    let column = |name: &str| table.floats(name).unwrap();
    assert_eq!(column("device_cold_start_s")[0], f64::INFINITY);
    let on = column("device_on_fraction");
    assert!(on[0] == 0.0 && on[1] > 0.5 && on[1] < 1.0, "{on:?}");
    assert!(column("device_margin_w")[0] < column("device_margin_w")[1]);
}

#[test]
fn a_harvester_without_a_regulator_has_no_columns_of_devices() {
    let text = "spec = \"harvester.toml\"\n[set]\n\"run.duration\" = \"0.2 s\"\n\"run.average_over\" = \"0.1 s\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\ncommand = \"run\"\n";
    let study = Study::parse(text, &example_folder()).unwrap();
    let table = study.part(0, &Control::default()).unwrap().unwrap();
    assert!(table.column("device_on_fraction").is_none());
    assert!(table.column("energy_residual_relative").is_some());
}

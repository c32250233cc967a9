//! The wireless sensor of `examples/` on recordings: on a foot that walks, and on a tree that is sawn.
//! Without the recordings the tests print that they are skipped.

use super::samples::real;
use jounce_analysis::Model;
use jounce_analysis::run::{RunPlan, RunResult, charges, simulate};
use jounce_spec::Spec;
use std::path::Path;

const SPEC: &str = include_str!("../../../../examples/wireless-sensor/harvester.toml");

/// Runs the sensor on a recorded motion; `None` without the recording.
fn on(file: &str, channel: &str, changes: &[(&str, &str)]) -> Option<RunResult> {
    let path = real(file)?;
    let (before, after) = SPEC.split_at(SPEC.find("signal = ").expect("a drive"));
    let rest = &after[after.find("[damping]").expect("a table")..];
    let mut text = format!(
        "{before}signal = \"recording\"\nfile = {:?}\n{channel}\n\n{rest}",
        path.display().to_string()
    );
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    let spec = Spec::from_toml(&text).expect("a spec");
    let run = spec.run.clone();
    let model = Model::new(spec).expect("a model");
    let start = model.start(Path::new("")).expect("a start");
    let plan = RunPlan::of(&run, run.average_over_s);
    let result = simulate(&model.kernel, &start, &plan).expect("a run");
    let charges = charges(&model.kernel, &result, &plan);
    eprintln!("{file}: {:?}", result.devices[0]);
    assert!(charges[0].residual_relative.abs() < 1e-9, "{charges:?}");
    assert!(result.energies.residual_relative().abs() < 1e-9);
    Some(result)
}

/// The subject stands until 50 s and walks until 180 s. With a mass of 20 g the first measurement is
/// sent late in the walk.
#[test]
fn a_walk_starts_the_sensor() {
    let changes = [
        ("mass = \"5 g\"", "mass = \"20 g\""),
        ("duration = \"120 s\"", "duration = \"180 s\""),
        ("average_over = \"60 s\"", "average_over = \"130 s\""),
    ];
    let channel = "channel = \"foot_data(5)\"\nscale = 9.80665";
    if let Some(result) = on("human_gait/foot_data.mat", channel, &changes) {
        let device = &result.devices[0];
        let cold_start_s = device.cold_start_s.expect("a start");
        assert!((60.0..180.0).contains(&cold_start_s), "{device:?}");
        assert!(device.completed_tasks >= 1 && device.margin_w < 0.0);
    }
}

/// Twelve seconds of a chainsaw charge 100 uF to half a volt, and 1 uF not much further: the sensor
/// does not start.
#[test]
fn a_sawn_tree_does_not_start_the_sensor() {
    let channel = "channel = \"accel_x\"\nscale = 5.985504150390625e-4";
    let times = [
        ("duration = \"120 s\"", "duration = \"12 s\""),
        ("average_over = \"60 s\"", "average_over = \"11 s\""),
    ];
    let small = [
        ("storage = \"100 uF\"", "storage = \"1 uF\""),
        ("chip = \"LTC3588-1\"", "chip = \"BQ25570\""),
    ];
    let file = "tree_vibration/chainsaw_1.csv";
    for changes in [times.to_vec(), [&times[..], &small].concat()] {
        let Some(result) = on(file, channel, &changes) else {
            return;
        };
        let (device, circuit) = (&result.devices[0], &result.rectified[0]);
        assert_eq!(device.cold_start_s, None);
        assert!(device.available_w > 0.0 && device.margin_w < 0.0);
        assert!(circuit.voltage_rms_v > 0.1 && circuit.mean_power_w == 0.0);
    }
}

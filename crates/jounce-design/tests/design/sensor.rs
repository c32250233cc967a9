//! Goals of a device behind a regulator.

use super::{LINEAR, outcome_of, problem};

/// The linear harvester with a sensor in place of its load.
fn sensor() -> String {
    LINEAR
        .replace(
            "resistance = \"80 kohm\"",
            "interface = \"bridge\"\nstorage = \"4.7 uF\"\nleakage_resistance = \"20 Mohm\"\nregulator = \"r\"\ndevice = \"s\"\n\
             [regulator.r]\nchip = \"BQ25570\"\n[device.s]\nsleep_current = \"2 uA\"\nmeasure_current = \"1 mA\"\n\
             measure_time = \"2 ms\"\nperiod = \"1 s\"",
        )
        .replace("duration = \"1 s\"", "duration = \"20 s\"")
        .replace("average_over = \"1 s\"", "average_over = \"10 s\"")
}

fn best(goal: &str, free: &str, evaluations: usize) -> (f64, f64) {
    let text = format!(
        "evaluations = {evaluations}\n[free]\n\"modal.m.frequency_hz.1\" = \"{free}\"\n[goal]\nmaximise = \"{goal}\"\n"
    );
    let found = outcome_of(&sensor(), &text);
    (found.best.goals[goal], found.before.goals[goal])
}

/// The margin is largest near the resonance: that of the search is that of a scan.
#[test]
fn the_largest_margin_is_that_of_a_scan() {
    let (margin_w, _) = best("power-margin", "9:10.4", 40);
    let scan = (0..15).map(|k| {
        let frequency = 9.0 + 0.1 * f64::from(k);
        best(
            "power-margin",
            &format!("{frequency}:{}", frequency + 1e-3),
            4,
        )
        .0
    });
    let scanned_w = scan.fold(f64::NEG_INFINITY, f64::max);
    eprintln!("margin {margin_w} W, scan {scanned_w} W");
    assert!(margin_w > 0.0 && margin_w >= scanned_w - 1e-3 * scanned_w.abs());
}

#[test]
fn a_design_keeps_a_sensor_on_that_the_spec_does_not() {
    let off = sensor().replace("frequency_hz = [10.0]", "frequency_hz = [30.0]");
    let text = "evaluations = 40\n[free]\n\"modal.m.frequency_hz.1\" = \"9:30\"\n[goal]\nmaximise = \"time-on\"\n";
    let found = outcome_of(&off, text);
    let (before, after) = (found.before.goals["time-on"], found.best.goals["time-on"]);
    assert!(before < 0.5 && after > 0.99, "{before} {after}");
}

#[test]
fn a_spec_without_a_device_has_no_such_goal() {
    let text =
        "[free]\n\"circuit.load.resistance\" = \"10kohm:1Mohm\"\n[goal]\nmaximise = \"time-on\"\n";
    let error = problem(text).map_or_else(|error| error.to_string(), |_| String::new());
    assert!(
        error.contains("goal.maximise is \"time-on\", but the spec has no device"),
        "{error}"
    );
}

//! `examples/pump-sensor`: the harvester of the tutorial in the book.

use crate::example::{run, spec};
use crate::rows::check;
use jounce_model::structure::modes;
use std::f64::consts::TAU;

const EXAMPLE: &str = "pump-sensor";
const SPEC: &str = "harvester.toml";

/// Frequencies against a transfer matrix, power of a run against harmonic balance. The run is averaged over 98 complete cycles.
#[test]
fn frequencies_and_power_come_out() {
    let frequency_rad_s = modes(&spec(EXAMPLE, SPEC, &[])).unwrap().frequency_rad_s;
    let settings = [
        ("drive.shaker.frequency", "24.5 Hz"),
        ("run.duration", "20 s"),
        ("run.average_over", "4 s"),
    ];
    let (_, result) = run(EXAMPLE, SPEC, &settings);
    check(
        EXAMPLE,
        &[
            ("first_hz", frequency_rad_s[0] / TAU),
            ("second_hz", frequency_rad_s[1] / TAU),
            ("power_w", result.mean_power_w),
        ],
    );
}

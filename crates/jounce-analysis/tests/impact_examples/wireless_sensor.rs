//! `examples/wireless-sensor`: a sensor behind a regulator, on a machine that vibrates at random.

use crate::example::run;
use crate::rows::check;
use jounce_analysis::run::{RunPlan, charges};

const EXAMPLE: &str = "wireless-sensor";
const SPEC: &str = "harvester.toml";

/// Energy of a task, J: 1 mA for 20 ms and 15 mA for 5 ms at 3.3 V. Power of the sleep, W.
const TASK_J: f64 = 3.3e-3 * 0.02 + 49.5e-3 * 0.005;
const SLEEP_W: f64 = 6.6e-6;

/// At a stronger vibration the sensor never stops, so that its energy follows from the time on and
/// the number of its tasks.
#[test]
fn every_expected_row_is_met() {
    let (kernel, weak) = run(EXAMPLE, SPEC, &[]);
    let stronger = [
        ("drive.base.psd", "0.0015 g^2/Hz"),
        ("run.average_over", "120 s"),
    ];
    let (_, strong) = run(EXAMPLE, SPEC, &stronger);
    let (device, always_on) = (&weak.devices[0], &strong.devices[0]);
    let (on_s, tasks) = (
        120.0 * always_on.on_fraction,
        always_on.completed_tasks as f64,
    );
    assert!(always_on.starts == 1 && always_on.interrupted_tasks == 0);
    assert!((on_s - (120.0 - always_on.cold_start_s.unwrap())).abs() < 1e-9);
    assert_eq!(tasks, (on_s / 5.0).floor() + 1.0);
    let wanted_j = tasks * TASK_J + SLEEP_W * (on_s - 0.025 * tasks);
    check(
        EXAMPLE,
        &[
            ("needed_w", device.needed_w),
            (
                "delivered_over_tasks",
                strong.rectified[0].mean_power_w * 120.0 / wanted_j,
            ),
            ("cold_start_s", device.cold_start_s.unwrap()),
            ("on_fraction", device.on_fraction),
        ],
    );
    let plan = RunPlan {
        duration_s: 120.0,
        average_over_s: 60.0,
        tolerance: 1e-9,
        record_s: 60.0,
    };
    let charges = charges(&kernel, &weak, &plan);
    assert!(charges[0].residual_relative.abs() < 1e-9, "{charges:?}");
    assert!(weak.energies.residual_relative().abs() < 1e-9);
    // 108000 samples of the noise; 169628 steps and 26908 rejections, with a margin of a tenth.
    let work = weak.work;
    let attempts = work.flight_steps + work.flight_rejections;
    assert!(attempts < 216_000, "{work:?}");
}

//! Mean power of recordings with missing samples.

use jounce::parts::{Grid, Over, RawChannel};
use jounce::{PowerOptions, Recording};

/// Samples of 10 V at 10 Hz and 1 kHz over 4 s that are kept.
fn kept(is_kept: impl Fn(usize) -> bool) -> (Vec<f64>, Vec<f64>) {
    let voltage = |k: usize| 10.0 * (std::f64::consts::TAU * 0.01 * k as f64).sin();
    let kept = (0..4000).filter(|k| is_kept(*k));
    kept.map(|k| (k as f64 / 1e3, voltage(k))).unzip()
}

fn mean_power_w(grid: Grid, volts: Vec<f64>) -> f64 {
    let channels = vec![RawChannel::new("patch", "V", volts)];
    let recording = Recording::from_arrays("run", Over::Time, grid, channels).unwrap();
    let options = PowerOptions {
        resistance_ohm: vec![1e5],
        ..Default::default()
    };
    let result = Recording::power(&[recording], &options).unwrap();
    result.records[0].power.mean_power_w
}

/// Whole periods have `V^2 / 2 R`, and so have the rest of them where some are missing: with
/// interpolated samples in the mean, a quarter of the power is missing too.
#[test]
fn missing_samples_have_no_power() {
    let hole = 1500..2500;
    let (times, volts) = kept(|k| !hole.contains(&k));
    let (stamped, _) = Grid::from_stamps(times).unwrap();
    let (_, mut all) = kept(|_| true);
    all[hole].fill(f64::NAN);
    let even = Grid::Even {
        start: 0.0,
        step: 1e-3,
        count: 4000,
    };
    for power_w in [mean_power_w(stamped, volts), mean_power_w(even, all)] {
        assert!((power_w / 0.5e-3 - 1.0).abs() < 1e-12, "{power_w:e}");
    }
}

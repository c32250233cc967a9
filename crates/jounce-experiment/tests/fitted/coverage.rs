//! Coverage of stated confidence intervals.

use super::{free_keys, relative_deviation, spec};
use jounce_control::Control;
use jounce_experiment::fit::{Features, ModeFeature, fit};
use jounce_model::structure;
use jounce_signal::RandomStream;
use std::f64::consts::TAU;
use std::path::Path;

const CANTILEVER: &str = r#"
[beam.beam]
length = "300 mm"
width = "30 mm"
thickness = "2 mm"
youngs_modulus = "70 GPa"
density = "2700 kg/m^3"
root_stiffness = "100 N m/rad"

[mass.sensor]
on = "beam.end"
mass = "5 g"

[damping]
beyond = 0.01

[reduction]
modes = 4
mesh_tolerance = 1e-6
"#;
const KEYS: [(&str, f64); 4] = [
    ("beam.beam.youngs_modulus", 0.05),
    ("beam.beam.root_stiffness", 0.3),
    ("mass.sensor.mass", 0.3),
    ("damping.beyond", 0.4),
];
const FREQUENCY: f64 = 0.002;
const DAMPING: f64 = 0.1;

fn modes(keys: &[f64]) -> Vec<(f64, f64)> {
    let (_, mut spec) = spec(CANTILEVER, &[]);
    KEYS.iter().zip(keys).for_each(|((key, _), value)| {
        spec.set_si(key, *value)
            .unwrap_or_else(|fault| panic!("{fault}"))
    });
    let modal = structure::modes(&spec).expect("modes");
    modal
        .frequency_rad_s
        .iter()
        .map(|w| w / TAU)
        .zip(modal.damping_ratio)
        .collect()
}

/// In every trial the keys are drawn from their priors, and four frequencies and two damping ratios
/// are measured with noise. Returns the fraction of trials in which the interval of each key
/// contains the true value, and last the fraction for further measurements.
fn coverage_fractions(trials: u64) -> [f64; 5] {
    let (file, spec) = spec(CANTILEVER, &[]);
    let start: Vec<f64> = KEYS
        .iter()
        .map(|(key, _)| {
            file.numeric_key(key)
                .expect("a key")
                .get(&spec)
                .expect("a value")
        })
        .collect();
    let mut inside = [0_u32; 4];
    let (mut further, mut all) = (0, 0);
    for seed in 0..trials {
        let mut stream = RandomStream::new(seed, 11);
        let mut moved =
            |value: f64, deviation: f64| value * (deviation * stream.normal_pair()[0]).exp();
        let truth: Vec<f64> = start
            .iter()
            .zip(KEYS)
            .map(|(value, (_, prior))| moved(*value, prior))
            .collect();
        let true_modes = modes(&truth);
        let mode = |(k, (hz, ratio)): (usize, &(f64, f64))| ModeFeature {
            number: k + 1,
            frequency: Some((moved(*hz, FREQUENCY), relative_deviation(FREQUENCY))),
            damping_ratio: (k < 2).then(|| (moved(*ratio, DAMPING), relative_deviation(DAMPING))),
            ..ModeFeature::default()
        };
        let measured = true_modes.iter().enumerate().map(mode).collect();
        let features = Features {
            free: free_keys(&KEYS),
            modes: measured,
            ..Features::default()
        };
        let (result, _) = fit(&file, &spec, &features, Path::new("."), &Control::default())
            .unwrap_or_else(|fault| panic!("{seed}: {fault}"));
        for (inside, (key, truth)) in inside.iter_mut().zip(result.keys.iter().zip(&truth)) {
            *inside += u32::from((key.low..=key.high).contains(truth));
        }
        let frequencies = result
            .features
            .iter()
            .filter(|feature| feature.unit == "Hz");
        for (feature, (hz, _)) in frequencies.zip(&true_modes) {
            further += u32::from((feature.low..=feature.high).contains(&moved(*hz, FREQUENCY)));
            all += 1;
        }
    }
    let share = |inside: u32| f64::from(inside) / trials as f64;
    let (keys, further) = (inside.map(share), f64::from(further) / f64::from(all));
    eprintln!("{keys:.4?} of the trials; {further:.4} of further measurements");
    let [a, b, c, d] = keys;
    [a, b, c, d, further]
}

/// A fraction of 100 trials has a standard deviation of 2.2 %.
#[test]
fn intervals_of_95_percent_hold_the_truth() {
    for share in coverage_fractions(100) {
        assert!((0.89..=0.995).contains(&share), "{share}");
    }
}

/// Measured: 95.5, 95.0, 95.3 and 95.3 % for the keys, 95.3 % of further measurements; each
/// fraction is known to 1.1 %. In 4000 trials: 95.5, 94.3, 94.9, 95.5 and 94.7 %.
#[test]
#[ignore = "400 trials; 100 of them in every run"]
fn intervals_of_95_percent_hold_the_truth_in_95_percent_of_400_trials() {
    for share in coverage_fractions(400) {
        assert!((0.92..=0.98).contains(&share), "{share}");
    }
}

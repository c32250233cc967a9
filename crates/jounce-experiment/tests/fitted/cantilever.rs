//! Clamp and sensor of a steel cantilever, from its three lowest frequencies.

use super::{fit_and_compare, free_keys, spec, with_noise};
use jounce_control::Control;
use jounce_data::read;
use jounce_experiment::fit::{Deviation, Features, FitResult, ModeFeature, fit};
use jounce_identification::modal::{ModalSettings, identify_decays};
use jounce_identification::response::Decays;
use jounce_model::structure;
use std::f64::consts::TAU;
use std::io::Write;
use std::path::Path;

/// A bar of 759 x 50.66 x 5.14 mm with an accelerometer of 5.8 g near its end.
const CANTILEVER: &str = r#"
[beam.beam]
length = "759 mm"
width = "50.66 mm"
thickness = "5.14 mm"
youngs_modulus = "200 GPa"
density = "7850 kg/m^3"
root_stiffness = "3 kN m/rad"

[mass.sensor]
on = "beam.end"
mass = "5.8 g"

[damping]
beyond = 0.003

[reduction]
modes = 5
"#;
const KEYS: [(&str, f64); 2] = [("beam.beam.root_stiffness", 1.0), ("mass.sensor.mass", 1.0)];
/// Highest lines of the recording, Hz, as noted with it.
const NOTED_HZ: [f64; 3] = [6.57, 41.47, 117.93];

fn features(frequency_hz: &[f64]) -> Features {
    let mode = |(k, hz): (usize, &f64)| ModeFeature {
        number: k + 1,
        frequency: Some((*hz, Deviation::Residuals)),
        ..ModeFeature::default()
    };
    Features {
        free: free_keys(&KEYS),
        modes: frequency_hz.iter().enumerate().map(mode).collect(),
        ..Features::default()
    }
}

fn fit_cantilever(frequency_hz: &[f64]) -> (FitResult, Vec<f64>) {
    let (file, spec) = spec(CANTILEVER, &[]);
    let (result, fit_cantilever) = fit(
        &file,
        &spec,
        &features(frequency_hz),
        Path::new("."),
        &Control::default(),
    )
    .unwrap_or_else(|fault| panic!("{fault}"));
    let modes = structure::modes(&fit_cantilever).expect("modes");
    (
        result,
        modes.frequency_rad_s.iter().map(|w| w / TAU).collect(),
    )
}

/// A model with clamp and tip mass is identified from its frequencies, although both lower every
/// frequency by nearly the same fraction.
#[test]
fn clamp_and_tip_mass_come_back_from_five_frequencies() {
    let (_, truth) = spec(
        CANTILEVER,
        &[
            ("beam.beam.root_stiffness", "2 kN m/rad"),
            ("mass.sensor.mass", "20 g"),
        ],
    );
    let hz: Vec<f64> = structure::modes(&truth)
        .expect("modes")
        .frequency_rad_s
        .iter()
        .map(|w| w / TAU)
        .collect();
    let result = fit_and_compare(
        CANTILEVER,
        &features(&with_noise(&hz, 1e-4, 2)),
        &[2000.0, 0.020],
        0.1,
    );
    assert!(
        result
            .features
            .iter()
            .all(|feature| feature.errors().1.abs() < 1e-3)
    );
}

/// Measured: the noted frequencies agree within 0.42 %, those found in the spectrum within 0.64 %.
/// The first of them lies 0.49 % above the noted line, less than half a line. Three frequencies
/// determine the joint effect of clamp and mass, not their separate shares, and the fit reports
/// this: the mass lies between 0.1 g and 0.6 kg. Two more modes in the recording, not used by the
/// fit, are 1.2 % and 1.8 % off.
#[test]
fn a_real_cantilever_agrees_within_half_a_percent() {
    let spectrum = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../../shared/data/hrshm_cantilever/impulse_FFT_data.lvm");
    let mut cases = vec![(NOTED_HZ.to_vec(), 0.5)];
    if spectrum.exists() {
        let recording = read::file(&spectrum)
            .unwrap_or_else(|fault| panic!("{fault}"))
            .recordings
            .remove(0);
        let decays = Decays::of_spectrum(&recording, &[]).expect("amplitudes over even lines");
        let identification =
            identify_decays(&decays, (2.0, 160.0), ModalSettings { order: 20 }).expect("modes");
        cases.push((
            identification
                .modes
                .iter()
                .map(|mode| mode.frequency_hz)
                .collect(),
            0.7,
        ));
    } else {
        let _ = writeln!(
            std::io::stderr(),
            "SKIPPED: the recording hrshm_cantilever/impulse_FFT_data.lvm is missing; the frequencies noted from it are used"
        );
    }
    for (measured_hz, max_error) in cases {
        let (result, model_hz) = fit_cantilever(&measured_hz);
        for key in &result.keys {
            eprintln!(
                "{}: {:.4e} {}, from {:.3e} to {:.3e}",
                key.key, key.after, key.unit, key.low, key.high
            );
        }
        let errors: Vec<f64> = result
            .features
            .iter()
            .map(|feature| 100.0 * feature.errors().1)
            .collect();
        let unused_modes =
            [model_hz[3] / 229.97 - 1.0, model_hz[4] / 380.33 - 1.0].map(|error| 100.0 * error);
        eprintln!(
            "{measured_hz:.3?} Hz: {errors:.3?} % off; unseen modes {unused_modes:.2?} % off; {:#?}",
            result.warnings
        );
        assert!(
            errors.iter().all(|error| error.abs() < max_error),
            "{errors:?}"
        );
        assert!(
            result
                .warnings
                .iter()
                .any(|warning| warning.contains("determine 1 combinations of the 2 keys")),
            "{:?}",
            result.warnings
        );
    }
}

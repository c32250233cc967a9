//! The standard test of a harvester: the base shaken by noise, the voltage recorded over four loads.
//!
//! Each record gives the response in V per m/s^2 and from it the mode of the harvester under its load. The loaded modes fit the spec: frequency,
//! damping, coupling, capacitance; the flanks of the responses, where damping counts for little, its participation. From the fitted spec follow the
//! optimal load, and the power over a fifth load under the base as it was recorded there.

mod predictions;
mod records;
mod trials;

use jounce_fft::Complex;
use jounce_model::linear::{FrfInput, FrfOutput, frf};
use jounce_model::plant::{Plant, System};
use jounce_model::structure;
use jounce_spec::{Spec, SpecFile};
use rayon::prelude::*;
use std::ops::{Range, RangeInclusive};
use std::sync::LazyLock;
use trials::{Inside, trial};

/// A cantilever of two modes with a patch, coupling squared 4 %, without stops; the drive is where the optimal load is asked for.
const RIG: &str = r#"
[modal.beam]
frequency_hz = [60.0, 370.0]
damping_ratio = [0.012, 0.01]
participation_sqrt_kg = [0.09, 0.05]

[modal.beam.point]
tip = [11.0, -10.0]

[modal.beam.patch.piezo]
coupling_n_per_v = [0.0151, 0.02]
capacitance = "40 nF"

[circuit.load]
patch = "beam.piezo"
resistance = "50 kohm"

[drive.shaker]
kind = "base-acceleration"
frequency = "61 Hz"
amplitude = "1 m/s^2"
"#;
/// The keys that are fitted and the deviations of their priors: the capacitance comes from a meter, the others from a first guess.
const KEYS: [(&str, f64); 5] = [
    ("modal.beam.frequency_hz.1", 0.05),
    ("modal.beam.damping_ratio.1", 0.5),
    ("modal.beam.patch.piezo.coupling_n_per_v.1", 0.3),
    ("modal.beam.patch.piezo.capacitance", 0.02),
    ("modal.beam.participation_sqrt_kg.1", 0.3),
];
const LOADS_OHM: [f64; 4] = [15e3, 50e3, 150e3, 500e3];
const FIFTH_OHM: f64 = 90e3;
const LOAD: &str = "circuit.load.resistance";
const RATE_HZ: f64 = 1024.0;
const SAMPLES: usize = 1 << 16;
/// Noise of each sensor over the rms of its signal.
const NOISE: f64 = 0.01;
/// Bands in which the mode is sought, the next one where none is clear in that before.
const BANDS_HZ: [(f64, f64); 3] = [(35.0, 110.0), (45.0, 85.0), (50.0, 76.0)];
/// Flanks of the responses, Hz: below and above the mode under every load, where it counts for little.
const FLANKS_HZ: [(f64, f64); 2] = [(42.0, 55.0), (68.0, 85.0)];
/// Length of a block: thirty decay times of the mode, and 31 blocks to tell the scatter by.
const BLOCK_S: f64 = 4.0;
/// One of so many lines of a flank is taken: windows make neighbours alike.
const EACH: usize = 4;

fn file() -> SpecFile {
    SpecFile::from_text(RIG)
}

fn spec() -> Spec {
    file().spec().unwrap_or_else(|faults| panic!("{faults}"))
}

fn plant(spec: &Spec) -> Plant {
    Plant::new(System::assemble(spec, structure::modes(spec).expect("modes")).expect("a system"))
        .expect("a plant")
}

fn with_load(spec: &Spec, ohm: f64) -> Plant {
    let mut spec = spec.clone();
    spec.set_si(LOAD, ohm).expect("a load");
    spec.take_drives_away();
    plant(&spec)
}

/// Voltage over the load per acceleration of the base.
fn voltage(plant: &Plant, frequency_hz: &[f64]) -> Vec<Complex<f64>> {
    let output = [FrfOutput::LoadVoltage("load".to_owned())];
    frf(plant, &FrfInput::BaseAcceleration, &output, frequency_hz)
        .expect("a response")
        .remove(0)
        .value
}

fn line_hz() -> Vec<f64> {
    (0..=SAMPLES / 2)
        .map(|k| k as f64 * RATE_HZ / SAMPLES as f64)
        .collect()
}

fn trials(seeds: Range<u64>) -> Vec<Inside> {
    let truth = spec();
    let at = line_hz();
    let response = |ohm: &f64| voltage(&with_load(&truth, *ohm), &at);
    let responses: Vec<Vec<Complex<f64>>> =
        LOADS_OHM.iter().chain([&FIFTH_OHM]).map(response).collect();
    let one = |seed| trial(&truth, &responses, seed);
    seeds.into_par_iter().map(one).collect()
}

/// Trials of every run, which both tests check.
const FIRST: u64 = 16;
static FIRST_TRIALS: LazyLock<Vec<Inside>> = LazyLock::new(|| trials(0..FIRST));

/// Of 16 trials three misses are as rare as one in a hundred.
#[test]
#[ignore = "long: runs with ./test --long"]
fn intervals_of_the_standard_test_have_their_coverage() {
    check_coverage(FIRST, 0.8..=1.0);
}

/// Measured in 800 trials: the intervals hold 93.6 % of the frequencies and 94.4 % of the damping ratios of the loaded modes, 92.8 % of the
/// fitted ones, 95.5 % of the couplings, 92.9 % of the optimal loads and 93.9 % of the powers over the fifth load; each share of 800 has a
/// standard deviation of 0.9 %. Without the noise of the sensors the intervals hold 90 % of these powers: they are 0.22 % wide on each side,
/// and the noise of the base moves the prediction by 0.06 % (standard deviation).
#[test]
#[ignore = "200 trials; 16 of them in every run"]
fn intervals_of_the_standard_test_have_their_coverage_in_200_trials() {
    check_coverage(200, 0.92..=0.98);
}

/// Checks for each quantity the fraction of trials whose interval contains the true value.
fn check_coverage(count: u64, allowed: RangeInclusive<f64>) {
    let further = trials(FIRST..count);
    for name in [
        "loaded frequency",
        "loaded damping",
        "frequency",
        "damping",
        "participation",
        "coupling",
        "optimal load",
        "fifth load",
    ] {
        let of: Vec<f64> = FIRST_TRIALS
            .iter()
            .chain(&further)
            .flatten()
            .filter(|(of, _)| *of == name)
            .map(|(_, normalized_error)| *normalized_error)
            .collect();
        let mean = |of: &dyn Fn(f64) -> f64, all: &[f64]| {
            all.iter()
                .map(|normalized_error| of(*normalized_error))
                .sum::<f64>()
                / all.len() as f64
        };
        let share = mean(
            &|normalized_error| f64::from(u8::from(normalized_error.abs() <= 1.0)),
            &of,
        );
        let (middle, rms) = (
            mean(&|normalized_error| normalized_error, &of),
            mean(&|normalized_error| normalized_error * normalized_error, &of).sqrt(),
        );
        eprintln!(
            "{name}: {share:.4} of {} inside, truth at {middle:.2} and {rms:.2} rms of the half width",
            of.len()
        );
        assert!(allowed.contains(&share), "{name}: {share}");
    }
}

//! Coverage of the stated intervals of identified modes, for the virtual rig.

use super::fourier::{spectrum, steady_response};
use jounce_data::recording::{Channel, Grid, Over, Quantity, Recording};
use jounce_experiment::rig::{HammerTest, Sensor, hammer_test};
use jounce_identification::modal::{Band, ModalSettings, identify};
use jounce_identification::response::{ChannelChoice, MeasuredResponses};
use jounce_model::linear::{Frf, FrfInput, FrfOutput, frf};
use jounce_model::plant::{Plant, System};
use jounce_model::structure;
use jounce_signal::RandomStream;
use jounce_signal::spectral::{Estimator, ImpactSettings};
use jounce_spec::SpecFile;
use rayon::prelude::*;
use std::ops::{Range, RangeInclusive};
use std::sync::LazyLock;

/// Three modes in the band and three above it, the first of them near.
const RIG: &str = r#"
[modal.beam]
frequency_hz = [62.0, 110.0, 205.0, 310.0, 390.0, 470.0]
damping_ratio = [0.02, 0.012, 0.008, 0.010, 0.006, 0.005]

[modal.beam.point]
struck = [1.0, -1.1, 0.9, 1.2, -1.0, 1.1]
tip = [1.5, 1.4, 1.3, -1.5, 1.2, 1.4]
middle = [0.8, -0.5, -0.9, 1.0, 0.7, -0.6]
"#;
const TRUTH: [(f64, f64); 3] = [(62.0, 0.02), (110.0, 0.012), (205.0, 0.008)];
const BAND_HZ: (f64, f64) = (30.0, 260.0);
const RATE_HZ: f64 = 1024.0;

fn plant() -> Plant {
    let spec = SpecFile::from_text(RIG)
        .spec()
        .unwrap_or_else(|faults| panic!("{faults}"));
    let modes = structure::modes(&spec).expect("modes");
    Plant::new(System::assemble(&spec, modes).expect("a system")).expect("a plant")
}

fn accelerations() -> Vec<FrfOutput> {
    ["beam.tip", "beam.middle"]
        .map(|point| FrfOutput::Acceleration(point.to_owned()))
        .to_vec()
}

/// Hits in one recording.
fn hammer_record(plant: &Plant, (hits, block_s, noise): (usize, f64, f64), seed: u64) -> Recording {
    let test = HammerTest {
        point: "beam.struck".to_owned(),
        responses: accelerations(),
        hits,
        block_s,
        peak_force_n: 50.0,
        contact_time_s: 4e-3,
        rate_hz: RATE_HZ,
        sensor: Sensor {
            noise_ratio: noise,
            bits: Some(16),
        },
        seed,
    };
    hammer_test(plant, &test).unwrap_or_else(|fault| panic!("{fault}"))
}

/// Samples of a record of the shaker.
const SHAKEN: usize = 1 << 14;

/// Responses at the lines of a record of the shaker.
fn shaken_responses(plant: &Plant) -> Vec<Frf> {
    let frequency_hz: Vec<f64> = (0..=SHAKEN / 2)
        .map(|k| k as f64 * RATE_HZ / SHAKEN as f64)
        .collect();
    let input = FrfInput::Force("beam.struck".to_owned());
    frf(plant, &input, &accelerations(), &frequency_hz).expect("responses")
}

/// White noise of a shaker, and its response in the steady state.
fn shaker_record(functions: &[Frf], noise: f64, seed: u64) -> Recording {
    let mut stream = RandomStream::new(seed, 7);
    let force: Vec<f64> = (0..SHAKEN / 2).flat_map(|_| stream.normal_pair()).collect();
    let spectrum = spectrum(&force);
    let sensor = Sensor {
        noise_ratio: noise,
        bits: Some(16),
    };
    let mut channels = vec![Channel::new(
        "force",
        Quantity::Force,
        "N",
        sensor.read(&force, &mut stream),
    )];
    for function in functions {
        let values = steady_response(&spectrum, &function.value, SHAKEN);
        channels.push(Channel::new(
            &function.response.name(),
            Quantity::Acceleration,
            "m/s^2",
            sensor.read(&values, &mut stream),
        ));
    }
    let grid = Grid::even(0.0, 1.0 / RATE_HZ, SHAKEN).expect("a grid");
    Recording {
        name: "shaken".to_owned(),
        over: Over::Time,
        grid,
        channels,
        issues: Vec::new(),
    }
}

/// Errors over half widths: frequency and damping ratio of each mode.
type Errors = [[f64; 2]; 3];

/// Errors of one trial.
fn trial(record: Recording, settings: &ImpactSettings) -> Errors {
    let responses = MeasuredResponses::of_hits(&[record], &ChannelChoice::default(), settings)
        .unwrap_or_else(|fault| panic!("{fault}"));
    let mut identification = identify(
        &Band::of(&responses, BAND_HZ).expect("a band"),
        ModalSettings { order: 12 },
    )
    .expect("modes");
    identification
        .modes
        .iter_mut()
        .for_each(|mode| mode.without_decay(responses.window_decay_per_s));
    TRUTH.map(|(hz, ratio)| {
        let near = identification
            .modes
            .iter()
            .find(|mode| (mode.frequency_hz / hz - 1.0).abs() < 0.02);
        // A mode that is not found counts as outside every interval.
        near.map_or([f64::INFINITY; 2], |mode| {
            [
                (mode.frequency_hz - hz) / mode.frequency_half_width_hz(),
                (mode.damping_ratio - ratio) / mode.damping_half_width(),
            ]
        })
    })
}

/// Checks the fractions of trials in which the intervals contain the true value, for frequencies
/// and damping ratios of the three modes.
fn check_fractions(name: &str, errors: &[Errors], allowed: &RangeInclusive<f64>) {
    let inside = |mode: usize, number: usize| {
        errors
            .iter()
            .filter(|trial| trial[mode][number].abs() <= 1.0)
            .count() as f64
            / errors.len() as f64
    };
    let each = [0, 1].map(|number| [0, 1, 2].map(|mode| inside(mode, number)));
    let [frequency, damping] = each.map(|each| each.iter().sum::<f64>() / 3.0);
    eprintln!("{name}: frequencies {frequency:.3}, damping ratios {damping:.3} inside; {each:.3?}");
    assert!(
        allowed.contains(&frequency) && allowed.contains(&damping),
        "{name}: {frequency} {damping}"
    );
}

const PLAIN: ImpactSettings = ImpactSettings {
    estimator: Estimator::H1,
    block_s: None,
    force_window: false,
    end_ratio: None,
    shaker: false,
};

/// Name of a test, its settings, and its recording for each seed.
type Case<'p> = (
    &'static str,
    ImpactSettings,
    Box<dyn Fn(u64) -> Recording + Sync + 'p>,
);

fn cases(plant: &Plant) -> [Case<'_>; 4] {
    let shaken = shaken_responses(plant);
    [
        // 1 % of noise on force and accelerations.
        (
            "5 hits",
            PLAIN,
            Box::new(|seed| hammer_record(plant, (5, 1.0, 0.01), seed)),
        ),
        // 0.2 % of noise: residuals of modes above the band would appear.
        (
            "20 hits",
            PLAIN,
            Box::new(|seed| hammer_record(plant, (20, 1.0, 0.002), seed)),
        ),
        // Blocks shorter than the motion, with an exponential window.
        (
            "5 hits, window",
            ImpactSettings {
                block_s: Some(0.5),
                end_ratio: Some(0.05),
                ..PLAIN
            },
            Box::new(|seed| hammer_record(plant, (5, 1.0, 0.01), seed)),
        ),
        // 31 blocks with Hann leakage above the noise of the sensors.
        (
            "shaker",
            ImpactSettings {
                block_s: Some(1.0),
                ..PLAIN
            },
            Box::new(move |seed| shaker_record(&shaken, 0.01, seed)),
        ),
    ]
}

/// Name of each case and its trials.
type Trials = [(&'static str, Vec<Errors>); 4];

fn trials(seeds: Range<u64>) -> Trials {
    let plant = plant();
    cases(&plant).map(|(name, settings, record)| {
        let one = |seed| trial(record(seed), &settings);
        (name, seeds.clone().into_par_iter().map(one).collect())
    })
}

/// Trials of every run, which both tests check.
const FIRST: u64 = 40;
static FIRST_TRIALS: LazyLock<Trials> = LazyLock::new(|| trials(0..FIRST));

fn check_all(count: u64, allowed: RangeInclusive<f64>) {
    for ((name, first), (_, further)) in FIRST_TRIALS.iter().zip(trials(FIRST..count)) {
        check_fractions(name, &[&first[..], &further].concat(), &allowed);
    }
}

/// A fraction of 120 numbers has a standard deviation of 2 %: too few to find intervals that are too
/// wide.
#[test]
fn intervals_hold_the_truth() {
    check_all(FIRST, 0.9..=1.0);
}

#[test]
#[ignore = "200 trials; 40 of them in every run"]
fn intervals_hold_the_truth_in_200_trials() {
    check_all(200, 0.92..=0.98);
}

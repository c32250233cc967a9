//! Modes of free decays, of correlations under noise and of an amplitude spectrum.

use super::identify_decays;
use super::identify_decays::MAX_FREQUENCY_RATIO;
use crate::modal::poles::plscf::tests::{POLES, shape};
use crate::modal::{ModalError, ModalSettings, Mode, Pole};
use crate::response::{AmbientSettings, Decays};
use jounce_data::recording::{Channel, Grid, Over, Quantity, Recording};
use jounce_linalg::c64;
use jounce_signal::RandomStream;

const RATE: f64 = 250.0;

fn recording(values: Vec<Vec<f64>>) -> Recording {
    let count = values[0].len();
    let channel =
        |(o, values)| Channel::new(&format!("a{o}"), Quantity::Acceleration, "m/s^2", values);
    let channels = values.into_iter().enumerate().map(channel).collect();
    Recording {
        name: "test".to_owned(),
        over: Over::Time,
        grid: Grid::even(0.0, 1.0 / RATE, count).unwrap(),
        channels,
        issues: Vec::new(),
    }
}

/// Samples of free decays at three locations, each mode with its own size and phase.
fn decay(poles: &[Pole], count: usize) -> Vec<Vec<f64>> {
    let at = |o: usize, k: usize| {
        let mode = |(r, pole): (usize, &Pole)| {
            let contribution = c64::from_polar(shape(r, o), 0.4 * (r + 1) as f64)
                * (pole.complex() * (k as f64 / RATE)).exp();
            contribution.re
        };
        poles.iter().enumerate().map(mode).sum::<f64>()
    };
    (0..3)
        .map(|o| (0..count).map(|k| at(o, k)).collect())
        .collect()
}

fn largest_errors(found: &[Mode], poles: &[Pole]) -> (f64, f64) {
    assert_eq!(found.len(), poles.len(), "{found:?}");
    let relative_errors = |(mode, pole): (&Mode, &Pole)| {
        (
            (mode.frequency_hz / pole.frequency_hz - 1.0).abs(),
            (mode.damping_ratio / pole.damping_ratio - 1.0).abs(),
        )
    };
    found
        .iter()
        .zip(poles)
        .map(relative_errors)
        .fold((0.0, 0.0), |a, b| (f64::max(a.0, b.0), f64::max(a.1, b.1)))
}

/// Records that end long before their decays do (the slowest mode has fallen by only 45 %), two
/// modes 1 Hz apart. Measured: 2.2e-16 and 1.7e-14.
#[test]
fn truncated_decays_give_their_poles_without_leakage() {
    let record = recording(decay(&POLES, 500));
    let decays = Decays::free(&[record], &[], Some((0.2, 1.0))).unwrap();
    let found = identify_decays(&decays, (5.0, 105.0), ModalSettings { order: 20 }).unwrap();
    let (frequency, damping) = largest_errors(&found.modes, &POLES);
    eprintln!("frequencies {frequency:.1e}, damping ratios {damping:.1e} off");
    assert!(
        frequency < 1e-11 && damping < 1e-9,
        "{frequency:e} {damping:e}"
    );
    assert!((found.frequency_hz[1] - found.frequency_hz[0] - 1.25).abs() < 1e-9);
}

/// White noise of 5 % of the first sample: the truth lies within 1.96 stated deviations in 93 %
/// of two frequencies and two damping ratios in 50 trials; the standard deviation of this share
/// is 1.8 %.
#[test]
fn deviations_of_free_decays_have_their_coverage() {
    let poles = [POLES[0], POLES[3]];
    let exact_decay = decay(&poles, 500);
    let (mut covered, mut total) = (0, 0);
    for seed in 0..50 {
        let mut stream = RandomStream::new(seed, 9);
        let noisy = |values: &Vec<f64>| {
            values
                .iter()
                .map(|x| x + 0.05 * values[0].abs() * stream.normal_pair()[0])
                .collect()
        };
        let record = recording(exact_decay.iter().map(noisy).collect());
        let decays = Decays::free(&[record], &[], Some((0.0, 1.9))).unwrap();
        let found = identify_decays(&decays, (5.0, 105.0), ModalSettings { order: 12 }).unwrap();
        for pole in &poles {
            let mode = found
                .modes
                .iter()
                .min_by(|a, b| {
                    (a.frequency_hz - pole.frequency_hz)
                        .abs()
                        .total_cmp(&(b.frequency_hz - pole.frequency_hz).abs())
                })
                .unwrap();
            let errors = [
                (mode.frequency_hz - pole.frequency_hz) / mode.frequency_deviation_hz,
                (mode.damping_ratio - pole.damping_ratio) / mode.damping_deviation,
            ];
            covered += errors
                .iter()
                .filter(|errors| errors.abs() <= mode.quantile_95)
                .count();
            total += 2;
        }
    }
    let coverage = covered as f64 / f64::from(total);
    eprintln!("{coverage} inside");
    assert!((0.90..=0.99).contains(&coverage), "{coverage}");
}

/// The message gives the requested band, not the warped one.
#[test]
fn noise_has_no_modes_in_the_requested_band() {
    let mut stream = RandomStream::new(4, 0);
    let noise: Vec<f64> = (0..4000).flat_map(|_| stream.normal_pair()).collect();
    let decays = Decays::ambient(&recording(vec![noise]), &AmbientSettings::default()).unwrap();
    let error = identify_decays(&decays, (5.0, 500.0), ModalSettings { order: 20 }).unwrap_err();
    assert_eq!(
        error,
        ModalError::NoMode {
            low_hz: 5.0,
            high_hz: MAX_FREQUENCY_RATIO * RATE
        }
    );
}

/// White noise, as a record of a structure at rest and as decays: stable poles in it are not
/// modes.
#[test]
fn pure_noise_has_no_modes() {
    let (mut doubtful, mut no_mode) = (0, 0);
    for seed in 0..12 {
        let mut stream = RandomStream::new(seed, 3);
        let noise: Vec<f64> = (0..1000).flat_map(|_| stream.normal_pair()).collect();
        let record = recording(vec![noise]);
        let settings = AmbientSettings {
            lags_s: Some(1.0),
            ..AmbientSettings::default()
        };
        for decays in [
            Decays::ambient(&record, &settings).unwrap(),
            Decays::free(&[record], &[], Some((0.0, 7.9))).unwrap(),
        ] {
            match identify_decays(&decays, (5.0, 100.0), ModalSettings { order: 20 }) {
                Err(ModalError::Doubtful { .. }) => doubtful += 1,
                Err(ModalError::NoMode { .. }) => no_mode += 1,
                other => eprintln!("{seed}: {other:?}"),
            }
        }
    }
    eprintln!("{doubtful} doubtful, {no_mode} without a stable pole");
    assert!(
        doubtful > 0 && doubtful + no_mode == 24,
        "{doubtful} {no_mode}"
    );
}

/// Three modes under white noise forces, exact at the samples: `q_k+1 = exp(p T) q_k + (complex
/// white noise)`.
fn ambient(seed: u64, poles: &[Pole], count: usize) -> Recording {
    let mut stream = RandomStream::new(seed, 1);
    let rotations: Vec<c64> = poles
        .iter()
        .map(|pole| (pole.complex() / RATE).exp())
        .collect();
    let mut q = vec![c64::new(0.0, 0.0); poles.len()];
    let mut values = vec![Vec::new(); 2];
    for k in 0..count + 5000 {
        for (q, rotation) in q.iter_mut().zip(&rotations) {
            let [re, im] = stream.normal_pair();
            *q = *q * rotation + c64::new(re, im);
        }
        if k >= 5000 {
            for (o, values) in values.iter_mut().enumerate() {
                let noise = 0.5 * stream.normal_pair()[0];
                values.push(
                    q.iter()
                        .enumerate()
                        .map(|(r, q)| shape(r, o) * q.re)
                        .sum::<f64>()
                        + noise,
                );
            }
        }
    }
    recording(values)
}

/// Noise of sensors of a few percent, 400 s at 250 Hz. Measured: frequencies within 1.8e-3,
/// damping ratios within 8.6e-2.
#[test]
fn modes_under_noise_are_found_from_outputs() {
    let poles = [POLES[0], POLES[1], POLES[3]];
    let (mut covered, mut total, mut max_frequency_error, mut max_damping_error) =
        (0, 0, 0.0_f64, 0.0_f64);
    for seed in 0..3 {
        let record = ambient(seed, &poles, 100_000);
        let settings = AmbientSettings {
            references: vec!["a0".to_owned()],
            lags_s: Some(2.0),
            ..AmbientSettings::default()
        };
        let decays = Decays::ambient(&record, &settings).unwrap();
        assert_eq!((decays.values.len(), decays.blocks.len()), (2, 16));
        let found = identify_decays(&decays, (5.0, 100.0), ModalSettings { order: 20 }).unwrap();
        let (frequency, damping) = largest_errors(&found.modes, &poles);
        (max_frequency_error, max_damping_error) = (
            max_frequency_error.max(frequency),
            max_damping_error.max(damping),
        );
        for (mode, pole) in found.modes.iter().zip(&poles) {
            let errors = [
                (mode.frequency_hz - pole.frequency_hz) / mode.frequency_deviation_hz,
                (mode.damping_ratio - pole.damping_ratio) / mode.damping_deviation,
            ];
            covered += errors
                .iter()
                .filter(|errors| errors.abs() <= mode.quantile_95)
                .count();
            total += 2;
        }
    }
    eprintln!(
        "frequencies {max_frequency_error:.1e}, damping ratios {max_damping_error:.1e} off at most; {covered} of {total} inside"
    );
    assert!(
        max_frequency_error < 3e-3 && max_damping_error < 0.3 && covered * 10 >= total * 8,
        "{max_frequency_error:e} {max_damping_error:e} {covered}"
    );
}

/// Two outputs, each also a reference, as by default, with white sensor noise instead of a
/// structure: every combination must end in modes or in a message. With a structure, the poles
/// equal those from one reference. Measured: frequencies within 4.2e-4, damping ratios within
/// 8.4e-2.
#[test]
fn every_output_may_be_a_reference() {
    let poles = [POLES[0], POLES[1], POLES[3]];
    let settings = AmbientSettings {
        lags_s: Some(2.0),
        ..AmbientSettings::default()
    };
    let decays = Decays::ambient(&ambient(0, &poles, 100_000), &settings).unwrap();
    assert_eq!(
        (
            decays.outputs.len(),
            decays.references.len(),
            decays.values.len()
        ),
        (2, 2, 4)
    );
    let found = identify_decays(&decays, (5.0, 100.0), ModalSettings { order: 20 }).unwrap();
    let (frequency, damping) = largest_errors(&found.modes, &poles);
    eprintln!("frequencies {frequency:.1e}, damping ratios {damping:.1e} off");
    assert!(
        frequency < 3e-3 && damping < 0.3,
        "{frequency:e} {damping:e}"
    );
    let mut stream = RandomStream::new(11, 0);
    let noise = (0..3)
        .map(|_| (0..2000).flat_map(|_| stream.normal_pair()).collect())
        .collect();
    let decays = Decays::ambient(&recording(noise), &AmbientSettings::default()).unwrap();
    let result = identify_decays(&decays, (5.0, 100.0), ModalSettings { order: 20 });
    assert!(
        !matches!(&result, Ok(found) if !found.modes.iter().any(Mode::is_doubtful)),
        "{result:?}"
    );
}

/// Amplitude spectrum of a decay, all phases lost. Measured: frequencies within 7.3e-7, damping
/// ratios within 9.9e-5.
#[test]
fn an_amplitude_spectrum_is_enough_for_the_poles() {
    let poles = [POLES[0], POLES[1], POLES[3]];
    let mut values = decay(&poles, 4096);
    let samples = values.swap_remove(0);
    let plan = jounce_fft::forward(4096);
    let (mut input, mut bins) = (samples, plan.make_output_vec());
    plan.process(&mut input, &mut bins).unwrap();
    let amplitude = bins.iter().map(|bin| bin.norm()).collect();
    let grid = Grid::even(0.0, RATE / 4096.0, bins.len()).unwrap();
    let channels = vec![Channel::new(
        "a",
        Quantity::Acceleration,
        "m/s^2",
        amplitude,
    )];
    let spectrum = Recording {
        name: "spectrum".to_owned(),
        over: Over::Frequency,
        grid,
        channels,
        issues: Vec::new(),
    };
    let decays = Decays::of_spectrum(&spectrum, &[]).unwrap();
    assert!((decays.rate_hz - RATE).abs() < 1e-9);
    let found = identify_decays(&decays, (5.0, 100.0), ModalSettings { order: 20 }).unwrap();
    let (frequency, damping) = largest_errors(&found.modes, &poles);
    eprintln!("frequencies {frequency:.1e}, damping ratios {damping:.1e} off");
    assert!(
        frequency < 1e-4 && damping < 1e-2,
        "{frequency:e} {damping:e}"
    );
}

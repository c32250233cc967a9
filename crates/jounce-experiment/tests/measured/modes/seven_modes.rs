//! Seven modes from eight noisy frequency responses, and modes from responses of several kinds.

use jounce_data::recording::Quantity;
use jounce_identification::modal::{Band, ModalSettings, ResponseQuantity, identify};
use jounce_identification::response::MeasuredResponses;
use jounce_linalg::c64;
use jounce_signal::RandomStream;
use jounce_signal::spectral::{FrequencyResponse, WindowBias};
use std::f64::consts::TAU;
use std::time::Instant;

/// Frequencies and damping ratios: every peak is several lines wide.
const MODES: [(f64, f64); 7] = [
    (60.0, 0.01),
    (110.0, 0.009),
    (170.0, 0.008),
    (260.0, 0.006),
    (380.0, 0.005),
    (560.0, 0.005),
    (840.0, 0.004),
];
/// Frequencies of a slender beam (Table 2 of the 2019 paper): the first peak is half a line wide,
/// and its acceleration relatively small.
const SLENDER: [(f64, f64); 7] = [
    (9.01, 0.00194),
    (49.7, 0.00925),
    (133.2, 0.00864),
    (262.8, 0.00359),
    (436.2, 0.00126),
    (651.3, 0.00274),
    (918.1, 0.00160),
];
const PLACES: usize = 8;
const NOISE: f64 = 0.01;

/// Shapes of a cantilever without their decaying part: enough to distinguish the modes.
fn shape(mode: usize, position: usize) -> f64 {
    ((mode as f64 + 0.5) * 3.0 * (position + 1) as f64 / PLACES as f64).sin()
}

/// Acceleration at a point per force at the last.
fn acceleration(modes: &[(f64, f64)], position: usize, frequency_hz: f64) -> c64 {
    let s = c64::new(0.0, TAU * frequency_hz);
    let mode = |(r, (hz, zeta)): (usize, &(f64, f64))| {
        let w = TAU * hz;
        s * s * shape(r, position) * shape(r, PLACES - 1) / (s * s + 2.0 * zeta * w * s + w * w)
    };
    modes.iter().enumerate().map(mode).sum()
}

/// Accelerations at eight points per force at the last, 2000 lines, noise of 1 %. The time is
/// printed. Measured: frequencies within 2.1e-5, damping ratios within 2.3e-3.
#[test]
fn seven_modes_come_from_eight_responses() {
    let frequency_hz: Vec<f64> = (1..=2000).map(|k| 0.5 * f64::from(k)).collect();
    let mut stream = RandomStream::new(1, 0);
    let mut noisy = |position: usize, hz: f64| {
        let exact = acceleration(&MODES, position, hz);
        let [re, im] = stream.normal_pair();
        exact + c64::new(re, im) * (NOISE * exact.norm())
    };
    let responses: Vec<Vec<c64>> = (0..PLACES)
        .map(|position| frequency_hz.iter().map(|hz| noisy(position, *hz)).collect())
        .collect();
    let noise = vec![vec![NOISE; frequency_hz.len()]; PLACES];
    let worst = largest_errors(&MODES, &frequency_hz, &responses, &noise, (20.0, 1000.0));
    assert!(worst[0] < 1e-4 && worst[1] < 0.02, "{worst:?}");
}

/// A slender beam in the full band with two accelerometers, white noise of 1 % of the rms of each,
/// without noise information. A single full band misses the first two modes. Measured: frequencies
/// within 2.4e-6, damping ratios within 5.1e-4.
#[test]
fn a_narrow_first_mode_is_found_in_a_wide_band() {
    let frequency_hz: Vec<f64> = (1..=12_800).map(|k| 0.1 * f64::from(k)).collect();
    let mut stream = RandomStream::new(2, 0);
    let mut noisy = |position: usize| -> Vec<c64> {
        let exact: Vec<c64> = frequency_hz
            .iter()
            .map(|hz| acceleration(&SLENDER, position, *hz))
            .collect();
        let rms = (exact.iter().map(|h| h.norm_sqr()).sum::<f64>() / exact.len() as f64).sqrt();
        let add = |h: c64| {
            let [re, im] = stream.normal_pair();
            h + c64::new(re, im) * (NOISE * rms / 2f64.sqrt())
        };
        exact.into_iter().map(add).collect()
    };
    let responses: Vec<Vec<c64>> = [4, 7].into_iter().map(&mut noisy).collect();
    let worst = largest_errors(
        &SLENDER,
        &frequency_hz,
        &responses,
        &[],
        (f64::MIN_POSITIVE, 1280.0),
    );
    assert!(worst[0] < 1e-4 && worst[1] < 0.02, "{worst:?}");
}

/// Compares the modes found with the true ones, which must be equal in number: largest relative
/// errors of frequency and damping ratio.
fn largest_errors(
    modes: &[(f64, f64)],
    frequency_hz: &[f64],
    responses: &[Vec<c64>],
    noise: &[Vec<f64>],
    between_hz: (f64, f64),
) -> [f64; 2] {
    let clock = Instant::now();
    let band = Band::new(
        frequency_hz,
        responses,
        noise,
        1,
        ResponseQuantity::Acceleration,
        between_hz,
    )
    .expect("a band");
    let identification = identify(&band, ModalSettings::default()).expect("modes");
    let time_s = clock.elapsed().as_secs_f64();
    assert_eq!(
        identification.modes.len(),
        modes.len(),
        "{:?}",
        identification.modes
    );
    let mut worst = [0.0_f64; 2];
    for (mode, (hz, zeta)) in identification.modes.iter().zip(modes) {
        let errors = [
            mode.frequency_hz / hz - 1.0,
            mode.damping_ratio / zeta - 1.0,
        ];
        worst = [worst[0].max(errors[0].abs()), worst[1].max(errors[1].abs())];
        assert!(
            (mode.frequency_hz - hz).abs() < 4.0 * mode.frequency_deviation_hz,
            "{mode:?}"
        );
        assert!(
            (mode.damping_ratio - zeta).abs() < 4.0 * mode.damping_deviation,
            "{mode:?}"
        );
    }
    eprintln!("{:.1e} and {:.1e} off, {time_s:.3} s", worst[0], worst[1]);
    worst
}

/// Voltages of two patches and accelerations at two points per force.
fn voltages_and_accelerations(modes: &[(f64, f64)]) -> MeasuredResponses {
    let frequency_hz: Vec<f64> = (40..400).map(f64::from).collect();
    let function = |position: usize| {
        let displacement = |hz: f64| acceleration(modes, position, hz) / -(TAU * hz).powi(2);
        let of = |hz: &f64| {
            if position < 2 {
                displacement(*hz)
            } else {
                acceleration(modes, position, *hz)
            }
        };
        let (value, coherence) = (
            frequency_hz.iter().map(of).collect(),
            vec![1.0; frequency_hz.len()],
        );
        FrequencyResponse {
            frequency_hz: frequency_hz.clone(),
            value,
            coherence,
            blocks: 1,
            window_bias: WindowBias::Whole,
            leave_one_out: Vec::new(),
        }
    };
    let kind = |position: usize| {
        if position < 2 {
            Quantity::Voltage
        } else {
            Quantity::Acceleration
        }
    };
    MeasuredResponses {
        outputs: (0..4).map(|position| format!("place {position}")).collect(),
        references: Vec::new(),
        names: (0..4).map(|position| format!("place {position}")).collect(),
        units: vec![String::new(); 4],
        quantities: (0..4).map(kind).collect(),
        input: "force".to_owned(),
        inputs: vec![Quantity::Force; 4],
        functions: (0..4).map(function).collect(),
        hits: Vec::new(),
        block_s: None,
        window_decay_per_s: 0.0,
        issues: Vec::new(),
    }
}

/// The voltage of a patch follows the displacement, an accelerometer the acceleration: each is
/// treated accordingly. Measured: frequencies within 2e-16, damping ratios within 2e-15.
#[test]
fn voltages_and_accelerations_are_identified_together() {
    let modes = &MODES[..4];
    let responses = voltages_and_accelerations(modes);
    let identification = identify(
        &Band::of(&responses, (40.0, 400.0)).expect("a band"),
        ModalSettings::default(),
    )
    .expect("modes");
    assert_eq!(identification.modes.len(), 4, "{:?}", identification.modes);
    for (mode, (hz, zeta)) in identification.modes.iter().zip(modes) {
        let errors = [
            (mode.frequency_hz / hz - 1.0).abs(),
            (mode.damping_ratio / zeta - 1.0).abs(),
        ];
        eprintln!("{hz} Hz: {:.1e} and {:.1e} off", errors[0], errors[1]);
        assert!(errors[0] < 1e-10 && errors[1] < 1e-8, "{errors:?}");
    }
}

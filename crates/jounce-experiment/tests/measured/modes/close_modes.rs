//! Two modes so close that one reference cannot tell them apart.

use jounce_data::recording::Quantity;
use jounce_identification::modal::{Band, Identification, ModalSettings, identify, mac};
use jounce_identification::response::MeasuredResponses;
use jounce_linalg::c64;
use jounce_signal::RandomStream;
use jounce_signal::spectral::{FrequencyResponse, WindowBias};
use std::f64::consts::TAU;

/// Two modes 0.1 % apart, of equal damping, between two others: each peak is twenty times wider
/// than their separation.
pub const CLOSE: [(f64, f64); 4] = [(60.0, 0.012), (100.0, 0.01), (100.1, 0.01), (160.0, 0.008)];

/// Independent shapes; those of the two close modes are sine and cosine along the points.
fn shape(mode: usize, node: usize) -> f64 {
    let x = node as f64;
    match mode {
        0 => 0.4 + 0.2 * x,
        1 => (0.9 * x + 0.3).sin(),
        2 => (0.9 * x + 0.3).cos(),
        _ => (2.1 * x + 1.0).sin(),
    }
}

/// Acceleration at a point per force at another, mass 1.
fn acceleration(modes: &[(f64, f64)], node: usize, force: usize, frequency_hz: f64) -> c64 {
    let s = c64::new(0.0, TAU * frequency_hz);
    let mode = |(r, (hz, zeta)): (usize, &(f64, f64))| {
        let w = TAU * hz;
        s * s * shape(r, node) * shape(r, force) / (s * s + 2.0 * zeta * w * s + w * w)
    };
    modes.iter().enumerate().map(mode).sum()
}

/// Responses at sensors to forces, each with white noise relative to its rms.
pub fn responses(
    modes: &[(f64, f64)],
    sensors: &[usize],
    forces: &[usize],
    noise: f64,
) -> MeasuredResponses {
    let frequency_hz: Vec<f64> = (160..=880).map(|k| 0.25 * f64::from(k)).collect();
    let mut stream = RandomStream::new(7, 0);
    let mut function = |o: usize, i: usize| {
        let exact: Vec<c64> = frequency_hz
            .iter()
            .map(|hz| acceleration(modes, o, i, *hz))
            .collect();
        let rms = (exact.iter().map(|h| h.norm_sqr()).sum::<f64>() / exact.len() as f64).sqrt();
        let mut noisy = |h: c64| {
            let [re, im] = stream.normal_pair();
            h + c64::new(re, im) * (noise * rms / 2f64.sqrt())
        };
        let value: Vec<c64> = exact.into_iter().map(&mut noisy).collect();
        FrequencyResponse {
            coherence: vec![1.0; value.len()],
            frequency_hz: frequency_hz.clone(),
            value,
            blocks: 1,
            window_bias: WindowBias::Whole,
            leave_one_out: Vec::new(),
        }
    };
    let pairs: Vec<(usize, usize)> = sensors
        .iter()
        .flat_map(|o| forces.iter().map(move |i| (*o, *i)))
        .collect();
    MeasuredResponses {
        outputs: sensors.iter().map(|o| format!("a{o}")).collect(),
        references: forces.iter().map(|i| format!("point {i}")).collect(),
        names: pairs
            .iter()
            .map(|(o, i)| format!("a{o} from point {i}"))
            .collect(),
        units: vec!["m/s^2/N".to_owned(); pairs.len()],
        quantities: vec![Quantity::Acceleration; pairs.len()],
        input: "force".to_owned(),
        inputs: vec![Quantity::Force; pairs.len()],
        functions: pairs.iter().map(|(o, i)| function(*o, *i)).collect(),
        hits: Vec::new(),
        block_s: None,
        window_decay_per_s: 0.0,
        issues: Vec::new(),
    }
}

pub fn modes_of(responses: &MeasuredResponses, order: usize) -> Identification {
    let band = Band::of(responses, (40.0, 220.0)).expect("a band");
    identify(&band, ModalSettings { order }).expect("modes")
}

fn shape_at(mode: usize, nodes: &[usize]) -> Vec<c64> {
    nodes
        .iter()
        .map(|node| c64::new(shape(mode, *node), 0.0))
        .collect()
}

/// Largest relative errors of frequency and damping ratio, and the largest difference of a shape's
/// MAC from 1, over sensors and forces.
fn largest_errors(
    identification: &Identification,
    modes: &[(f64, f64)],
    sensors: &[usize],
    forces: &[usize],
) -> [f64; 3] {
    assert_eq!(
        identification.modes.len(),
        modes.len(),
        "{:?}",
        identification
            .modes
            .iter()
            .map(|m| (m.frequency_hz, m.damping_ratio))
            .collect::<Vec<_>>()
    );
    let mut largest_errors = [0.0_f64; 3];
    for (r, (mode, (hz, zeta))) in identification.modes.iter().zip(modes).enumerate() {
        let (at_sensors, at_forces) = (
            mac(&mode.residue, &shape_at(r, sensors)),
            mac(&mode.participation, &shape_at(r, forces)),
        );
        let errors = [
            mode.frequency_hz / hz - 1.0,
            mode.damping_ratio / zeta - 1.0,
            1.0 - at_sensors.min(at_forces),
        ];
        largest_errors
            .iter_mut()
            .zip(errors)
            .for_each(|(largest_errors, error)| *largest_errors = largest_errors.max(error.abs()));
        assert_eq!(
            (mode.residue.len(), mode.participation.len()),
            (sensors.len(), forces.len())
        );
        let largest = mode
            .participation
            .iter()
            .map(|b| b.norm())
            .fold(0.0, f64::max);
        assert!((largest - 1.0).abs() < 1e-12, "{largest}");
    }
    eprintln!(
        "frequencies {:.1e}, damping ratios {:.1e}, shapes {:.1e} off",
        largest_errors[0], largest_errors[1], largest_errors[2]
    );
    largest_errors
}

/// Two references separate two modes 0.1 % apart, with fewer sensors or fewer forces. Measured:
/// frequencies, damping ratios and MAC to roundoff, 4e-16.
#[test]
fn two_references_separate_two_close_modes() {
    let (few, many) = ([0, 3], [0, 1, 2, 3, 4, 5]);
    for (sensors, forces) in [(&many[..], &few[..]), (&few, &many)] {
        let computed = responses(&CLOSE, sensors, forces, 0.0);
        let identification = modes_of(&computed, 16);
        let errors = largest_errors(&identification, &CLOSE, sensors, forces);
        assert!(
            errors[0] < 1e-6 && errors[1] < 1e-6 && errors[2] < 1e-3,
            "{errors:?}"
        );
        // The synthesised responses are listed next to the measured ones, in the order of the
        // responses.
        for (k, function) in computed.functions.iter().enumerate() {
            let (hz, at) = (
                identification.frequency_hz[100],
                function
                    .frequency_hz
                    .iter()
                    .position(|hz| *hz == identification.frequency_hz[100]),
            );
            let displacement = function.value[at.expect("the line")] / -(TAU * hz).powi(2);
            assert!(
                (identification.measured[k][100] - displacement).norm()
                    < 1e-12 * displacement.norm(),
                "{k}"
            );
            assert!(
                (identification.model[k][100] - displacement).norm() < 1e-6 * displacement.norm(),
                "{k}"
            );
        }
    }
}

/// White noise of 0.5 % of each response; one reference gives the two as one. Measured: frequencies
/// within 1.7e-6, damping ratios within 1.6e-4, MAC 1 - 2.1e-5.
#[test]
fn two_references_separate_two_close_modes_in_noise() {
    let (few, many) = ([0, 3], [0, 1, 2, 3, 4, 5]);
    let identification = modes_of(&responses(&CLOSE, &many, &few, 0.005), 16);
    let errors = largest_errors(&identification, &CLOSE, &many, &few);
    assert!(
        errors[0] < 2e-5 && errors[1] < 2e-3 && errors[2] < 1e-3,
        "{errors:?}"
    );
    let one = modes_of(&responses(&CLOSE, &many, &few[..1], 0.005), 16);
    assert_eq!(one.modes.len(), 3, "{:?}", one.modes);
    for (mode, (hz, zeta)) in identification.modes.iter().zip(CLOSE) {
        let (by, damped_by) = (
            (mode.frequency_hz - hz) / mode.frequency_deviation_hz,
            (mode.damping_ratio - zeta) / mode.damping_deviation,
        );
        assert!(by.abs() < 4.0 && damped_by.abs() < 4.0, "{by} {damped_by}");
    }
}

/// A hammer at successive points with one fixed sensor gives the result of sensors at all these
/// points with one hammer point.
#[test]
fn a_roving_hammer_gives_the_modes_of_roving_sensors() {
    let apart = [CLOSE[0], CLOSE[1], (120.0, 0.01), CLOSE[3]];
    let all = [0, 1, 2, 3, 4, 5];
    let (sensors, hammer) = (
        responses(&apart, &all, &[4], 0.0),
        responses(&apart, &[4], &all, 0.0),
    );
    let (one, other) = (modes_of(&sensors, 30), modes_of(&hammer, 30));
    largest_errors(&one, &apart, &all, &[4]);
    let errors = largest_errors(&other, &apart, &[4], &all);
    assert!(errors.iter().all(|error| *error < 1e-9), "{errors:?}");
    for (a, b) in one.modes.iter().zip(&other.modes) {
        assert!(
            (a.frequency_hz / b.frequency_hz - 1.0).abs() < 1e-12
                && (a.damping_ratio / b.damping_ratio - 1.0).abs() < 1e-10,
            "{a:?} {b:?}"
        );
        assert!(
            a.shape()
                .iter()
                .zip(&b.participation)
                .all(|(a, b)| (a - b).norm() < 1e-9)
        );
        assert!(
            (a.residue.iter().map(|x| x.norm()).fold(0.0, f64::max) / b.residue[0].norm() - 1.0)
                .abs()
                < 1e-9
        );
    }
}

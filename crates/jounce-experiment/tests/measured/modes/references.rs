//! Modes from responses to forces at several points.

use faer::c64;
use jounce_data::read;
use jounce_data::recording::{Channel, Grid, Over, Quantity, Recording};
use jounce_data::write::write;
use jounce_identification::modal::{Band, Identification, ModalSettings, identify, mac};
use jounce_identification::response::MeasuredResponses;
use jounce_signal::RandomStream;
use jounce_signal::spectral::{FrequencyResponse, WindowBias};
use std::f64::consts::TAU;

/// Two modes 0.1 % apart, of equal damping, between two others: each peak is twenty times wider
/// than their separation.
const CLOSE: [(f64, f64); 4] = [(60.0, 0.012), (100.0, 0.01), (100.1, 0.01), (160.0, 0.008)];

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
fn responses(
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

fn modes_of(responses: &MeasuredResponses, order: usize) -> Identification {
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

/// The responses as channels over frequency, each with its sensor and the position of the force.
fn recording(
    responses: &MeasuredResponses,
    (sensors, forces): (&[usize], &[usize]),
    reference: impl Fn(usize) -> String,
) -> Recording {
    let hz = &responses.functions[0].frequency_hz;
    let channel = |(k, function): (usize, &FrequencyResponse)| {
        let real = function.value.iter().map(|h| h.re).collect();
        Channel {
            imaginary: Some(function.value.iter().map(|h| h.im).collect()),
            place: format!("node {}", 10 + sensors[k / forces.len()]),
            direction: "+z".to_owned(),
            reference: reference(forces[k % forces.len()]),
            ..Channel::new(&responses.names[k], Quantity::Response, "m/s^2/N", real)
        }
    };
    let grid = Grid::even(hz[0], hz[1] - hz[0], hz.len()).expect("a grid");
    let channels = responses
        .functions
        .iter()
        .enumerate()
        .map(channel)
        .collect();
    Recording {
        name: "test".to_owned(),
        over: Over::Frequency,
        grid,
        channels,
        issues: Vec::new(),
    }
}

/// Functions to two references, written and read again: the references are those of the file, and
/// the modes those of the computed functions. Measured: frequencies 7e-16, damping ratios 2e-14
/// apart (UFF has 13 digits), 2e-16 from Parquet and CSV.
#[test]
fn references_of_a_file_of_response_functions_are_used() {
    let (sensors, forces) = (&[0, 1, 2, 3, 4, 5][..], &[0, 3][..]);
    let computed = responses(&CLOSE, sensors, forces, 0.005);
    let expected = modes_of(&computed, 16);
    let folder = tempfile::tempdir().expect("a folder");
    let node = |force: usize| format!("node {} -z", 10 + force);
    let named = |force: usize| format!("hit {force}");
    let references: [(&str, &dyn Fn(usize) -> String); 4] = [
        ("uff", &node),
        ("uff", &named),
        ("parquet", &node),
        ("csv", &named),
    ];
    for (ending, reference) in references {
        let path = folder.path().join(format!("frf.{ending}"));
        // In a different order.
        let mut written = recording(&computed, (sensors, forces), reference);
        written.channels.reverse();
        write(&written, &path).expect("a file");
        let read = read::file(&path).expect("what was written").recordings;
        let responses = MeasuredResponses::from_functions(&read).expect("responses");
        assert_eq!(
            responses.references,
            [reference(3), reference(0)],
            "{ending}"
        );
        assert_eq!(
            (responses.outputs.len(), responses.functions.len()),
            (6, 12)
        );
        assert_eq!(
            responses.names[1],
            format!("{} from {}", responses.outputs[0], reference(0))
        );
        let identification = modes_of(&responses, 16);
        assert_eq!(identification.modes.len(), expected.modes.len());
        let mut errors = [0.0_f64; 3];
        for (a, b) in identification.modes.iter().zip(&expected.modes) {
            let reversed = |of: &[c64]| of.iter().rev().copied().collect::<Vec<_>>();
            let shapes = mac(&reversed(&a.residue), &b.residue)
                .min(mac(&reversed(&a.participation), &b.participation));
            let differences = [
                a.frequency_hz / b.frequency_hz - 1.0,
                a.damping_ratio / b.damping_ratio - 1.0,
                1.0 - shapes,
            ];
            errors
                .iter_mut()
                .zip(differences)
                .for_each(|(largest, error)| *largest = largest.max(error.abs()));
        }
        eprintln!(
            "{ending}: frequencies {:.1e}, damping ratios {:.1e}, shapes {:.1e} apart",
            errors[0], errors[1], errors[2]
        );
        assert!(
            errors[0] < 1e-9 && errors[1] < 1e-7 && errors[2] < 1e-9,
            "{ending}: {errors:?}"
        );
    }
}

/// A missing or duplicate pair is reported, and each function is then an output.
#[test]
fn references_without_all_their_functions_are_reported() {
    let (sensors, forces) = (&[0, 1, 2][..], &[0, 3][..]);
    let computed = responses(&CLOSE, sensors, forces, 0.0);
    let complete = recording(&computed, (sensors, forces), |force| {
        format!("node {force} +z")
    });
    let mut incomplete = complete.clone();
    incomplete.channels.remove(3);
    let mut duplicate = complete.clone();
    duplicate.channels.push(complete.channels[2].clone());
    let mut unspecified = complete.clone();
    unspecified.channels[5].reference.clear();
    for (recording, message) in [
        (incomplete, "0 of output node 11 +z to node 3 +z"),
        (duplicate, "2 of output node 11 +z to node 0 +z"),
        (unspecified, "unspecified"),
    ] {
        let count = recording.channels.len();
        let responses = MeasuredResponses::from_functions(&[recording]).expect("responses");
        assert!(
            responses.references.is_empty() && responses.outputs.len() == count,
            "{message}"
        );
        assert!(
            responses.issues.len() == 1 && responses.issues[0].about.contains(message),
            "{:?}",
            responses.issues
        );
    }
    let responses = MeasuredResponses::from_functions(&[complete]).expect("responses");
    assert_eq!(
        (
            responses.references.len(),
            responses.outputs.len(),
            responses.issues.len()
        ),
        (2, 3, 0)
    );
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

//! References of files of response functions.

use super::close_modes::{CLOSE, modes_of, responses};
use jounce_data::read;
use jounce_data::recording::{Channel, Grid, Over, Quantity, Recording};
use jounce_data::write::write;
use jounce_identification::modal::{Identification, mac};
use jounce_identification::response::MeasuredResponses;
use jounce_linalg::c64;
use jounce_signal::spectral::FrequencyResponse;

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

/// Largest relative differences of frequency and damping ratio, and the largest difference of a
/// shape's MAC from 1. The points of the first are in reverse order.
fn largest_differences(identification: &Identification, expected: &Identification) -> [f64; 3] {
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
    errors
}

/// Functions to two references, written and read again: the references are those of the file, and
/// the modes those of the computed functions. Measured: frequencies 7e-16, damping ratios 2e-14
/// apart (UFF has 13 digits), 2e-16 from Parquet and CSV.
#[test]
#[ignore = "long: runs with ./test --long"]
fn references_of_a_file_of_response_functions_are_used() {
    let (sensors, forces) = (&[0, 1, 2, 3, 4, 5][..], &[0, 3][..]);
    let computed = responses(&CLOSE, sensors, forces, 0.005);
    let expected = modes_of(&computed, 10);
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
        let identification = modes_of(&responses, 10);
        let errors = largest_differences(&identification, &expected);
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

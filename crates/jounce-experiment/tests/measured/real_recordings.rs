//! Real recordings next to the repository, with their content and issues. Without them the test
//! prints that it is skipped.

use super::samples::real;
use jounce_data::read;
use jounce_data::recording::{IssueKind, Over, Recording};
use jounce_identification::modal::{ModalSettings, identify_decays};
use jounce_identification::response::Decays;

fn recording(file: &str) -> Option<Recording> {
    let contents = read::file(&real(file)?).unwrap_or_else(|fault| panic!("{fault}"));
    contents.recordings.into_iter().next()
}

fn kinds(recording: &Recording) -> Vec<(IssueKind, Option<&str>, usize)> {
    recording
        .issues
        .iter()
        .map(|issue| (issue.kind, issue.channel.as_deref(), issue.count))
        .collect()
}

fn peak(recording: &Recording, channel: usize) -> f64 {
    recording.channels[channel]
        .values
        .iter()
        .fold(0.0, |peak: f64, x| peak.max(x.abs()))
}

/// Peak of the published record: 210.142 cm/s^2 at 11.44 s.
#[test]
fn el_centro_has_its_published_peak() {
    let Some(recording) = recording("elcentro_1940/elcentro_1940_s90w_si.csv") else {
        return;
    };
    assert!((peak(&recording, 0) - 2.101_42).abs() < 1e-5);
    assert!((recording.rate() - 50.0).abs() < 1e-9 && recording.channels[0].values.len() == 2674);
    assert_eq!(kinds(&recording), []);
}

#[test]
fn the_hammer_arrays_need_notes_and_have_their_peak_forces() {
    for (number, force) in [(1, 68.64), (2, 83.67), (3, 85.41), (4, 88.88), (5, 76.48)] {
        let Some(recording) = recording(&format!("pyfrf_hammer/measurements_{number}.npy")) else {
            return;
        };
        let highest = recording.channels[0]
            .values
            .iter()
            .copied()
            .fold(0.0, f64::max);
        assert!(
            (highest - force).abs() < 0.01 && (recording.rate() - 25_600.0).abs() < 1e-6,
            "{number}: {highest}"
        );
    }
}

#[test]
fn the_wrong_header_of_the_decimated_lvm_is_detected() {
    let Some(recording) = recording("hrshm_cantilever/test1_downsampled_by_64.lvm") else {
        return;
    };
    assert!(
        (recording.rate() - 800.0).abs() < 1e-6,
        "{}",
        recording.rate()
    );
    let found_kinds = kinds(&recording);
    assert!(
        found_kinds
            .iter()
            .any(|(kind, ..)| *kind == IssueKind::RescaledStamps),
        "{found_kinds:?}"
    );
    assert!(
        found_kinds
            .iter()
            .any(|(kind, ..)| *kind == IssueKind::HeaderDisagrees),
        "{found_kinds:?}"
    );
    assert!(
        found_kinds
            .iter()
            .any(|(kind, channel, _)| *kind == IssueKind::Converted && *channel == Some("Force"))
    );
}

#[test]
fn the_spectrum_in_decibels_becomes_amplitudes_over_frequency() {
    let Some(recording) = recording("hrshm_cantilever/impulse_FFT_data.lvm") else {
        return;
    };
    assert_eq!(recording.over, Over::Frequency);
    assert!(
        recording
            .issues
            .iter()
            .any(|issue| issue.kind == IssueKind::Decibels)
    );
    let highest = (20..150_000)
        .map(|k| (recording.channels[0].values[k], recording.grid.at(k)))
        .filter(|(_, f)| *f < 8.0)
        .max_by(|a, b| a.0.total_cmp(&b.0));
    assert!(
        (highest.expect("lines").1 - 6.57).abs() < 0.05,
        "{highest:?}"
    );
}

/// The three modes noted in its README, among all that a high order finds; the first lies within
/// half a line, 0.0427 Hz. All others are reported as doubtful: noise next to the steep peaks
/// causes them.
#[test]
fn modes_without_warning_are_the_three_modes_of_the_cantilever() {
    let Some(recording) = recording("hrshm_cantilever/impulse_FFT_data.lvm") else {
        return;
    };
    let decays = Decays::of_spectrum(&recording, &[]).expect("amplitudes over even lines");
    let modes = identify_decays(&decays, (3.0, 150.0), ModalSettings { order: 40 })
        .expect("modes")
        .modes;
    let sure: Vec<f64> = modes
        .iter()
        .filter(|mode| !mode.is_doubtful())
        .map(|mode| mode.frequency_hz)
        .collect();
    eprintln!("{sure:?} Hz of {}", modes.len());
    assert!(sure.len() == 3 && modes.len() > 3, "{modes:?}");
    for (hz, noted_hz) in sure.iter().zip([6.57, 41.47, 117.93]) {
        assert!((hz - noted_hz).abs() < 0.0427, "{sure:?}");
    }
}

/// The first 598 rows are zeros, and so are three complete columns.
#[test]
fn the_zero_padding_of_the_gait_is_found() {
    let Some(recording) = recording("human_gait/foot_data.mat") else {
        return;
    };
    assert!((recording.rate() - 100.0).abs() < 1e-6);
    let constant = recording
        .issues
        .iter()
        .filter(|issue| issue.kind == IssueKind::Constant)
        .count();
    assert_eq!(constant, 3);
    let padding = recording
        .issues
        .iter()
        .find(|issue| issue.kind == IssueKind::ZeroPadding)
        .expect("padding");
    assert!(padding.count >= 598, "{padding}");
}

#[test]
fn jitter_and_raw_counts_of_the_tree_are_found() {
    let Some(recording) = recording("tree_vibration/chainsaw_1.csv") else {
        return;
    };
    let kinds: Vec<IssueKind> = recording.issues.iter().map(|issue| issue.kind).collect();
    assert!(
        kinds.contains(&IssueKind::Jitter) && kinds.contains(&IssueKind::RawCounts),
        "{kinds:?}"
    );
    let even = recording.even().expect("even");
    assert!(
        even.issues
            .iter()
            .any(|issue| issue.kind == IssueKind::Resampled)
    );
    assert!((even.rate() - 333.33).abs() < 1.0);
}

#[test]
fn the_shaker_records_are_read_with_their_jitter() {
    let Some(recording) = recording("endaq_ide/ssx70065_si.csv") else {
        return;
    };
    assert!(
        (recording.rate() / 3071.8 - 1.0).abs() < 0.01,
        "{}",
        recording.rate()
    );
    let values = &recording.channels[1].values;
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let rms = (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt();
    assert!((rms - 49.2).abs() < 0.1, "{rms}");
}

#[test]
fn every_universal_file_is_read_or_refused_with_its_reason() {
    let Some(sound) = recording("uff/Sample_UFF58b_bin.uff") else {
        return;
    };
    assert_eq!(
        (
            sound.channels[0].values.len(),
            sound.channels[0].unit.as_str()
        ),
        (79_292, "Pa")
    );
    let sine = recording("uff/binary8byte.uff").expect("there");
    assert!((sine.rate() - 100.0).abs() < 1e-6 && (peak(&sine, 0) - 9.80665).abs() < 1e-6);
    let psd = recording("uff/sample_dataset58_psd.uff").expect("there");
    assert_eq!(psd.over, Over::Frequency);
    assert!(
        psd.issues
            .iter()
            .any(|issue| issue.kind == IssueKind::NonAsciiUnit),
        "{:?}",
        kinds(&psd)
    );
    let shapes = read::file(&real("uff/uff55_translation.uff").expect("there"))
        .expect("shapes")
        .shapes;
    assert_eq!(
        (shapes.len(), shapes[0].nodes.len(), shapes[0].real[1][2]),
        (3, 4, 0.150_162)
    );
    let refused = read::file(&real("uff/groups_test.uff").expect("there"))
        .expect_err("geometry only")
        .to_string();
    assert!(
        refused.contains("2411") && refused.contains("2467"),
        "{refused}"
    );
    let refused = read::file(&real("uff/meas_point_1.txt").expect("there"))
        .expect_err("no time")
        .to_string();
    assert!(
        refused.contains("no column has a unit of time"),
        "{refused}"
    );
}

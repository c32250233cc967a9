//! Arrays without a header: NPY and MAT.

use super::through_a_file::{kinds, one, read};
use crate::samples::{mat, npy};
use jounce_data::read::ReadError;
use jounce_data::recording::IssueKind;

#[test]
fn arrays_without_a_time_need_notes() {
    let rows = vec![
        (0..50).map(|k| f64::from(k) * 1e-3).collect(),
        (0..50).map(|k| f64::from(k).sin()).collect::<Vec<f64>>(),
    ];
    let recording = one("a.npy", &npy(&rows), None);
    assert_eq!(
        (recording.channels.len(), recording.channels[0].values.len()),
        (1, 50)
    );
    assert!((recording.rate() - 1000.0).abs() < 1e-9);
    let only = vec![rows[1].clone(), rows[1].clone()];
    assert!(matches!(
        read("b.npy", &npy(&only), None),
        Err(ReadError::NoTime { .. })
    ));
    let notes = "rate = \"2 kHz\"\n[channel.1]\nname = \"hammer\"\nunit = \"lbf\"\nscale = 10\n[channel.2]\nuse = false\n";
    let with_notes = one("b.npy", &npy(&only), Some(notes));
    assert_eq!(
        (
            with_notes.channels.len(),
            with_notes.channels[0].name.as_str(),
            with_notes.rate()
        ),
        (1, "hammer", 2000.0)
    );
    assert!(
        (with_notes.channels[0].values[1] / (only[0][1] * 44.482_216_152_605) - 1.0).abs() < 1e-14
    );
    let error = read(
        "c.npy",
        &npy(&only),
        Some("rate = \"1 Hz\"\n[channel.hamster]\nunit = \"N\"\n"),
    )
    .expect_err("no such channel");
    assert!(
        error.to_string().contains("hamster") && error.to_string().contains("channel 1"),
        "{error}"
    );
    let matrix = one("a.mat", &mat("m", &rows), None);
    assert_eq!(matrix.channels[0].name, "m(2)");
    assert_eq!(matrix.channels[0].values, rows[1]);
}

/// Half-precision numbers: 1 sign bit, 5 of the exponent over 15, 10 of the fraction; so 0x3e00 is
/// 1.5, and 0xc500 is -5.
#[test]
fn arrays_of_two_bytes_are_read_and_complex_ones_refused_with_a_way_out() {
    let header = |dtype: &str| {
        let bytes = npy(&[vec![0.0; 3]]);
        let text = String::from_utf8_lossy(&bytes[10..]).replace("'<f8'", &format!("'{dtype}'"));
        let line = text[..text.find('\n').expect("a header")]
            .trim_end()
            .to_owned();
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend(118_u16.to_le_bytes());
        bytes.extend(format!("{line:<117}\n").bytes());
        bytes
    };
    let notes = Some("rate = \"1 Hz\"\n");
    let halves: [u16; 3] = [0x3e00, 0xc500, 0x0001];
    let little: Vec<u8> = halves.iter().flat_map(|half| half.to_le_bytes()).collect();
    let big: Vec<u8> = halves.iter().flat_map(|half| half.to_be_bytes()).collect();
    for (dtype, numbers) in [("<f2", little), (">f2", big)] {
        let recording = one("a.npy", &[header(dtype), numbers].concat(), notes);
        assert_eq!(
            recording.channels[0].values,
            [1.5, -5.0, 2.0_f64.powi(-24)],
            "{dtype}"
        );
    }
    for dtype in ["<c8", "<c16"] {
        let message = read("a.npy", &[header(dtype), vec![0; 48]].concat(), notes)
            .expect_err("complex")
            .to_string();
        assert!(
            message.contains(&format!("complex ({dtype})"))
                && message.contains("NAME.re and NAME.im"),
            "{message}"
        );
    }
}

/// Fifty times at 1 kHz.
fn ramp() -> Vec<f64> {
    (0..50).map(|k| f64::from(k) * 1e-3).collect()
}

/// Fifty samples of a channel.
fn tip() -> Vec<f64> {
    (0..50).map(|k| f64::from(k).sin()).collect()
}

/// A matrix file with a channel, single numbers and perhaps a time.
fn with_numbers(numbers: &[(&str, f64)], time: bool) -> Vec<u8> {
    let mut bytes = mat("tip", &[tip()]);
    numbers
        .iter()
        .for_each(|(name, x)| bytes.extend(mat(name, &[vec![*x]]).split_off(128)));
    if time {
        bytes.extend(mat("t", &[ramp()]).split_off(128));
    }
    bytes
}

/// A rate or a step next to the arrays replaces a time.
#[test]
fn a_single_number_of_a_matrix_file_gives_the_rate() {
    for (name, number) in [
        ("fs", 2000.0),
        ("Fs", 2000.0),
        ("sample_rate", 2000.0),
        ("dt", 5e-4),
    ] {
        let recording = one("a.mat", &with_numbers(&[(name, number)], false), None);
        assert!(
            (recording.rate() / 2000.0 - 1.0).abs() < 1e-12 && recording.grid.at(0) == 0.0,
            "{name}: {}",
            recording.rate()
        );
        assert_eq!(
            (
                recording.channels.len(),
                &recording.channels[0].values,
                kinds(&recording)
            ),
            (1, &tip(), vec![IssueKind::Assumed]),
            "{name}"
        );
        assert!(
            recording.issues[0].to_string().contains(&format!(
                "at 2000 Hz, starting at 0 s, from {name} = {number} "
            )),
            "{:?}",
            recording.issues
        );
    }
    for (name, number) in [("fs", 0.0), ("fs", f64::NAN), ("gain", 2000.0)] {
        let refused = read("a.mat", &with_numbers(&[(name, number)], false), None);
        assert!(
            matches!(refused, Err(ReadError::NoTime { .. })),
            "{name} = {number}: {refused:?}"
        );
    }
}

/// A time has priority over a number. A conflicting number, also one against the notes, is reported.
#[test]
fn a_number_that_conflicts_with_a_time_or_the_notes_is_reported() {
    let assert_issue = |bytes: &[u8], notes: Option<&str>, rate: f64, words: &str| {
        let recording = one("a.mat", bytes, notes);
        assert!(
            (recording.rate() / rate - 1.0).abs() < 1e-9,
            "{}",
            recording.rate()
        );
        let recording: Vec<String> = recording.issues.iter().map(ToString::to_string).collect();
        assert!(
            recording
                .iter()
                .any(|assert_issue| assert_issue.contains(words)),
            "{recording:?} {words}"
        );
    };
    assert_issue(
        &with_numbers(&[("fs", 2000.0)], true),
        None,
        1000.0,
        "fs = 2000 in the file is 2000 Hz, the stamps give 1000.000000 Hz; the stamps are used",
    );
    assert_issue(
        &with_numbers(&[("fs", 2000.0)], false),
        Some("rate = \"500 Hz\"\n"),
        500.0,
        "the notes specify 500.000000 Hz; the notes are used",
    );
    assert_issue(
        &with_numbers(&[("fs", 2000.0), ("dt", 1e-3)], false),
        None,
        2000.0,
        "dt = 0.001 one of 1000 Hz; the first is used",
    );
    assert!(
        !kinds(&one(
            "a.mat",
            &with_numbers(&[("fs", 1000.0), ("dt", 1e-3)], true),
            None
        ))
        .contains(&IssueKind::HeaderDisagrees)
    );
}

#[test]
fn the_first_column_of_a_matrix_is_its_time_where_it_has_that_rate() {
    let both = |ramp: Vec<f64>| {
        [
            mat("m", &[ramp, tip()]),
            mat("fs", &[vec![1000.0]]).split_off(128),
        ]
        .concat()
    };
    assert_eq!(one("a.mat", &both(ramp()), None).channels.len(), 1);
    assert_eq!(
        one(
            "a.mat",
            &both(ramp().iter().map(|t| 7.0 * t).collect()),
            None
        )
        .channels
        .len(),
        2
    );
}

/// The second of two arrays is truncated: an incomplete recording is refused. An element that is
/// not an array is reported.
#[test]
fn a_matrix_file_is_read_element_by_element() {
    let ramp = ramp();
    let second = mat("tip", &[ramp.iter().map(|t| t.sin()).collect()]).split_off(128);
    let both = [mat("t", std::slice::from_ref(&ramp)), second.clone()].concat();
    let complete = one("a.mat", &both, None);
    assert_eq!(
        (complete.channels.len(), complete.channels[0].name.as_str()),
        (1, "tip")
    );
    let message = read("a.mat", &both[..both.len() - 8], None)
        .expect_err("it is cut")
        .to_string();
    let begin = both.len() - second.len();
    assert!(
        message.contains(&format!("byte {begin}")) && message.contains("is the file truncated?"),
        "{message}"
    );
    let mut odd_length = both.clone();
    // Changes the class of the second array to that of an object.
    odd_length[begin + 16] = 17;
    let rate = Some("rate = \"1 kHz\"\n");
    let message = read("a.mat", &odd_length, rate)
        .expect_err("only a time is left")
        .to_string();
    assert!(message.contains("was left out"), "{message}");
}

/// A time of 50 samples and channels of 40 do not form a recording.
#[test]
fn a_matrix_file_without_a_channel_as_long_as_its_time_is_refused() {
    let ramp = ramp();
    let short = mat("tip", &[ramp[..40].to_vec()]).split_off(128);
    let message = read("a.mat", &[mat("t", &[ramp]), short].concat(), None)
        .expect_err("no channel")
        .to_string();
    assert!(
        message.contains("no channel remains")
            && message.contains("tip has 40 samples where the recording has 50"),
        "{message}"
    );
}

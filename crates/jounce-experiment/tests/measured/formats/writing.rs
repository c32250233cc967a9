//! Written recordings read back equal, or writing is refused.

use super::through_a_file::{differs, kinds, through_file};
use crate::samples::{record, response};
use jounce_data::read;
use jounce_data::recording::{Grid, IssueKind, Over, Quantity, Recording};
use jounce_data::write::write;

#[test]
fn a_written_recording_is_read_back() {
    let original = record();
    for (name, error, step) in [
        ("a.csv", 0.0, 1e-12),
        ("a.parquet", 0.0, 1e-12),
        ("a.uff", 5.1e-13, 1e-6),
    ] {
        let read_back = through_file(&original, name);
        for (a, b) in original.channels.iter().zip(&read_back.channels) {
            assert_eq!(
                (&a.name, a.quantity, &a.unit),
                (&b.name, b.quantity, &b.unit),
                "{name}"
            );
            assert!(
                differs(&a.values, &b.values) <= error,
                "{name}: {:e}",
                differs(&a.values, &b.values)
            );
        }
        assert!(
            (read_back.rate() / original.rate() - 1.0).abs() < step,
            "{name}: {}",
            read_back.rate()
        );
        assert!(
            matches!(read_back.grid, Grid::Even { count: 301, .. }),
            "{name}"
        );
    }
}

#[test]
fn a_written_response_is_read_back() {
    let written = response();
    for (name, digits) in [("b.uff", 5.1e-13), ("b.parquet", 0.0), ("b.csv", 0.0)] {
        let read = through_file(&written, name);
        assert_eq!(
            (read.over, read.channels.len()),
            (Over::Frequency, 1),
            "{name}"
        );
        assert!(
            differs(&written.channels[0].values, &read.channels[0].values) <= digits,
            "{name}"
        );
        let imaginary =
            |recording: &Recording| recording.channels[0].imaginary.clone().unwrap_or_default();
        assert!(
            differs(&imaginary(&written), &imaginary(&read)) <= digits,
            "{name}"
        );
        assert_eq!(written.grid.places(), read.grid.places());
        let channel = &read.channels[0];
        assert_eq!(
            (
                channel.name.as_str(),
                channel.quantity,
                channel.unit.as_str()
            ),
            ("accelerance", Quantity::Response, "m/s^2/N"),
            "{name}"
        );
        assert!(!kinds(&read).contains(&IssueKind::UnknownUnit), "{name}");
    }
}

/// A name longer than the 20 columns of a label is written in full in the fourth line.
#[test]
fn a_long_name_is_read_back_complete() {
    let mut long = record();
    long.channels[0].name = "acceleration of the tip mass, z".to_owned();
    assert_eq!(
        through_file(&long, "long.uff").channels[0].name,
        long.channels[0].name
    );
}

/// The text above the line states the kind of a response. `H(w) = 1 / (w0^2 - w^2 + 2 j zeta w0 w)`
/// per newton, as displacement in millimetres per kilonewton and as acceleration `-w^2 H` in g per
/// pound-force, has one mode; a confusion of the kinds would change it. The columns of UFF hold 20
/// characters of a unit: 20 are written and read again, 21 are refused with both numbers, and no
/// file remains.
#[test]
fn a_unit_that_the_columns_would_cut_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let write_in = |unit: &str, ending: &str| {
        let mut recording = response();
        recording.channels[0].unit = unit.to_owned();
        let path = folder.path().join(format!("{}.{ending}", unit.len()));
        (
            write(&recording, &path).map_err(|error| error.to_string()),
            path,
        )
    };
    let (fits, long) = ("counts per 100 N m/V", "counts per 1000 N m/V");
    let (written, path) = write_in(fits, "uff");
    written.expect("a file");
    assert_eq!(
        read::file(&path).expect("what was written").recordings[0].channels[0].unit,
        fits
    );
    let (refused, path) = write_in(long, "uff");
    let message = refused.expect_err("21 characters");
    assert!(
        message.contains("accelerance")
            && message.contains(long)
            && message.contains("21 characters")
            && message.contains("limit of UFF is 20"),
        "{message}"
    );
    assert!(!path.exists());
    assert!(write_in(long, "parquet").0.is_ok());
}

/// 10 characters of a place and 80 of a name are written and read again; one more is refused with
/// both numbers, and no file remains.
#[test]
fn a_place_or_name_that_the_format_would_change_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let written = |place: &str, name: &str, ending: &str| {
        let mut recording = record();
        (recording.channels[1].place, recording.channels[1].name) =
            (place.to_owned(), name.to_owned());
        let path = folder
            .path()
            .join(format!("{}-{}.{ending}", place.len(), name.len()));
        (
            write(&recording, &path).map_err(|error| error.to_string()),
            path,
        )
    };
    let name = "n".repeat(80);
    let (fits, path) = written("beam.tip 1", &name, "uff");
    fits.expect("a file");
    let through_file = &read::file(&path).expect("what was written").recordings[0].channels[1];
    assert_eq!(
        (through_file.place.as_str(), &through_file.name),
        ("beam.tip 1", &name)
    );
    for (place, name, message) in [
        (
            "beam.hammer",
            "a".to_owned(),
            "the place of a, \"beam.hammer\", has 11 characters; the limit of UFF is 10: give a shorter one",
        ),
        (
            "tip",
            "n".repeat(81),
            "has 81 characters; the limit of UFF is 80: give a shorter one",
        ),
        (
            "tip",
            "öse".to_owned(),
            "the name of öse, \"öse\", contains 'ö'; UFF supports only ASCII",
        ),
    ] {
        let (refused, path) = written(place, &name, "uff");
        let refused = refused.expect_err("too long");
        assert!(refused.contains(message) && !path.exists(), "{refused}");
        assert!(written(place, &name, "csv").0.is_ok());
    }
}

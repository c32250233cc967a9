//! Headers and rows of every format.

use super::through_a_file::{kinds, one, read};
use crate::samples::{lvm, record, uff58b};
use jounce_data::read;
use jounce_data::recording::{Grid, IssueKind, Quantity, Recording};
use jounce_data::write::write;

#[test]
fn a_text_with_units_gaps_and_words_is_read_and_reported() {
    let text = "Lab 3\nsensor: A\n\ntime_ms;a [g];Kraft (lbf);n\n0,0;1,0;2;7\n1,0;-1,5;NaN;8\n2,0;0,25;3\n3,0;0,5;x;9\n# end\n4,0;0;0;0\n";
    let recording = one("a.txt", text.as_bytes(), None);
    assert!((recording.rate() - 1000.0).abs() < 1e-9);
    assert_eq!(recording.channels.len(), 3);
    assert!((recording.channels[0].values[1] + 1.5 * 9.80665).abs() < 1e-14);
    assert_eq!(
        (
            recording.channels[1].quantity,
            recording.channels[1].name.as_str()
        ),
        (Quantity::Force, "Kraft")
    );
    let kinds = kinds(&recording);
    for kind in [
        IssueKind::Converted,
        IssueKind::NotANumber,
        IssueKind::Ragged,
        IssueKind::Skipped,
    ] {
        assert!(kinds.contains(&kind), "{kind:?} is missing in {kinds:?}");
    }
    let latin = one("b.csv", b"t [s],a [m/s\xb2]\n0,1\n1,2\n2,3\n", None);
    assert_eq!(latin.channels[0].quantity, Quantity::Acceleration);
    assert!(
        latin.issues.iter().any(|f| f.kind == IssueKind::Encoding)
            && latin
                .issues
                .iter()
                .any(|f| f.kind == IssueKind::NonAsciiUnit)
    );
}

/// A number at the end of a text may be truncated; a line without an end is reported.
#[test]
fn a_last_line_without_an_end_is_reported() {
    let open = one("a.csv", b"t [s],a [m/s^2]\n0,1\n1,20\n2,3", None);
    let issues: Vec<String> = open.issues.iter().map(ToString::to_string).collect();
    assert!(
        issues.len() == 1
            && issues[0].starts_with("the last line has no end")
            && issues[0].ends_with("(at line 4)"),
        "{issues:?}"
    );
    assert_eq!(open.channels[0].values, [1.0, 20.0, 3.0]);
    assert_eq!(
        kinds(&one("a.csv", b"t [s],a [m/s^2]\n0,1\n1,20\n2,3\n", None)),
        []
    );
}

/// Two sets over separate grids: the first is read, and the other is reported.
#[test]
fn the_selected_record_of_several_is_reported() {
    let folder = tempfile::tempdir().expect("a folder");
    let bytes_of = |name: &str, rate: f64| {
        let path = folder.path().join(name);
        let recording = Recording {
            grid: Grid::even(0.0, 1.0 / rate, 301).expect("a grid"),
            ..record()
        };
        write(&recording, &path).unwrap_or_else(|fault| panic!("{fault}"));
        std::fs::read(&path).expect("it was written")
    };
    let path = folder.path().join("both.uff");
    std::fs::write(
        &path,
        [bytes_of("a.uff", 1000.0), bytes_of("b.uff", 500.0)].concat(),
    )
    .expect("a file");
    for recording in [
        read::record(&path),
        read::record_summary(&path).map(|summary| summary.into_recording().expect("in memory")),
    ] {
        let recording = recording.unwrap_or_else(|fault| panic!("{fault}"));
        assert!((recording.rate() - 1000.0).abs() < 1e-6);
        let message = recording.issues.last().expect("an issue").to_string();
        assert!(
            message.contains("is used") && message.contains("left out: both 2"),
            "{message}"
        );
    }
}

#[test]
fn the_stamps_of_an_lvm_win_over_its_header() {
    let recording = one("a.lvm", lvm().as_bytes(), None);
    assert!((recording.rate() - 800.0).abs() < 1e-9);
    assert_eq!(
        recording
            .channels
            .iter()
            .map(|c| c.quantity)
            .collect::<Vec<_>>(),
        [Quantity::Voltage, Quantity::Force]
    );
    let kinds = kinds(&recording);
    assert!(
        kinds.contains(&IssueKind::RescaledStamps) && kinds.contains(&IssueKind::HeaderDisagrees),
        "{kinds:?}"
    );
}

/// The header of a second segment is not data: the reader reports the end of the segment.
#[test]
fn a_second_segment_is_refused_at_its_place() {
    let segment = lvm()
        .split_once("***End_of_Header***\t\n\t\n")
        .expect("a header")
        .1
        .to_owned();
    let error = read("a.lvm", format!("{}\n{segment}", lvm()).as_bytes(), None)
        .expect_err("two segments")
        .to_string();
    let line = lvm().lines().count()
        + 1
        + segment
            .lines()
            .position(|line| line.starts_with("***"))
            .expect("a header")
        + 1;
    assert!(
        error.contains(&format!("line {line}")) && error.contains("segment"),
        "{error}"
    );
}

/// Numbers in lines of unequal length are not columns, whatever the rate; a few irregular lines are
/// harmless.
#[test]
fn a_text_whose_lines_differ_is_no_table() {
    let text = "1 2\n3 4\n5 6\n".to_owned() + &"1 2 3\n".repeat(30);
    let error = read("a.txt", text.as_bytes(), Some("rate = \"10 Hz\"\n"))
        .expect_err("no table")
        .to_string();
    assert!(
        error.contains("line 4")
            && error.contains("29 more of 33 lines")
            && error.contains(".channels.toml"),
        "{error}"
    );
    let irregular = "t a\n".to_owned() + &"1 2\n3 4\n5 6\n".repeat(10) + "1 2 3\n";
    assert!(
        kinds(&one(
            "a.txt",
            irregular.as_bytes(),
            Some("rate = \"10 Hz\"\n")
        ))
        .contains(&IssueKind::Ragged)
    );
}

#[test]
fn binary_functions_of_every_order_and_size_are_read() {
    for (double, little) in [(false, false), (false, true), (true, false), (true, true)] {
        let recording = one("a.uff", &uff58b(double, little), None);
        let Grid::Stamped(stamps) = &recording.grid else {
            panic!("stamped")
        };
        assert_eq!(stamps[19], 361.0);
        assert!(
            (recording.channels[0].values[19] - 15.5 * 9.80665).abs() < 1e-5,
            "{double} {little}"
        );
        assert_eq!(
            (
                recording.channels[0].place.as_str(),
                recording.channels[0].direction.as_str()
            ),
            ("node 5", "+z")
        );
    }
}

/// Endless lines of samples would fill the memory.
#[test]
fn an_endless_line_is_refused() {
    let text = ["1,2\n3,4\n5,6\n".to_owned(), "7,".repeat(9 << 20)].concat();
    let message = read("a.csv", text.as_bytes(), Some("rate = \"1 Hz\"\n"))
        .expect_err("too long")
        .to_string();
    assert!(
        message.contains("line 4") && message.contains("16 MiB"),
        "{message}"
    );
}

#[test]
fn a_file_that_is_not_a_recording_is_refused_with_its_reason() {
    let cases: [(&str, &[u8], &str); 9] = [
        ("a.csv", b"", "empty"),
        ("a.csv", b"no numbers\nat all\n", "no rows of numbers"),
        (
            "a.csv",
            b"t [s],a,b\n0,1,2\n1,2\n2,3,3\n3\n",
            "no two successive rows have equally many numbers",
        ),
        (
            "a.csv",
            b"a,b\n5,1\n3,2\n4,3\n",
            "no column has a unit of time",
        ),
        ("a.csv", b"t [s],b\n0,1\n2,2\n1,3\n", "before"),
        ("a.h5", b"\x89HDF\r\n\x1a\n", "is the file truncated?"),
        ("a.bin", b"\x01\x02\x00\x00", "binary"),
        ("a.txt", b"\xff\xfet\x00", "UTF-16"),
        (
            "a.uff",
            b"    -1\n   164\n         1  SI\n    -1\n",
            "no data set 55 or 58",
        ),
    ];
    for (name, bytes, reason) in cases {
        let message = read(name, bytes, None).expect_err(reason).to_string();
        assert!(message.contains(reason), "{message}");
    }
    let constant = one("a.csv", b"t [s],a\n0,1\n1,1\n2,1\n3,1\n", None);
    assert!(kinds(&constant).contains(&IssueKind::Constant));
}

#[test]
fn columns_of_one_name_are_read_under_two_with_an_issue() {
    let recording = one("a.csv", b"t [s],u [V],u [V]\n0,1,2\n1,2,1\n2,1,3\n", None);
    let issue = recording
        .issues
        .iter()
        .find(|issue| issue.kind == IssueKind::Assumed);
    let message = issue.expect("an issue").about.clone();
    assert_eq!(
        message,
        "2 columns have the name \"u\"; they are read as \"u 2\", \"u 3\""
    );
}

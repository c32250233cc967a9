//! Every format: what is written is what is read.

use super::samples::{lvm, mat, npy, record, response, uff58b};
use jounce_measure::modal::{Band, Settings, identify};
use jounce_measure::read::{self, Contents, ReadError};
use jounce_measure::recording::{FindingKind, Grid, Over, Quantity, Recording};
use jounce_measure::response::Responses;
use jounce_measure::write::write;
use std::f64::consts::TAU;

fn read(name: &str, bytes: &[u8], notes: Option<&str>) -> Result<Contents, ReadError> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).expect("a file");
    if let Some(notes) = notes {
        std::fs::write(read::Notes::path_of(&path), notes).expect("notes");
    }
    read::file(&path)
}

fn one(name: &str, bytes: &[u8], notes: Option<&str>) -> Recording {
    let mut contents = read(name, bytes, notes).unwrap_or_else(|fault| panic!("{fault}"));
    assert_eq!(contents.recordings.len(), 1);
    contents.recordings.remove(0)
}

fn again(recording: &Recording, name: &str) -> Recording {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(name);
    write(recording, &path).unwrap_or_else(|fault| panic!("{fault}"));
    read::file(&path).unwrap_or_else(|fault| panic!("{fault}")).recordings.remove(0)
}

fn kinds(recording: &Recording) -> Vec<FindingKind> {
    recording.findings.iter().map(|finding| finding.kind).collect()
}

/// Largest difference over the size of the value; measured: 0 for CSV and Parquet, 4.1e-13 for the 13 digits of UFF 58.
fn differs(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| if a == b { 0.0 } else { ((a - b) / a).abs() }).fold(0.0, f64::max)
}

#[test]
fn what_is_written_is_read_back() {
    let whole = record();
    for (name, error, step) in [("a.csv", 0.0, 1e-12), ("a.parquet", 0.0, 1e-12), ("a.uff", 5.1e-13, 1e-6)] {
        let found = again(&whole, name);
        for (a, b) in whole.channels.iter().zip(&found.channels) {
            assert_eq!((&a.name, a.quantity, &a.unit), (&b.name, b.quantity, &b.unit), "{name}");
            assert!(differs(&a.values, &b.values) <= error, "{name}: {:e}", differs(&a.values, &b.values));
        }
        assert!((found.rate() / whole.rate() - 1.0).abs() < step, "{name}: {}", found.rate());
        assert!(matches!(found.grid, Grid::Even { count: 301, .. }), "{name}");
    }
    let written = response();
    for (name, digits) in [("b.uff", 5.1e-13), ("b.parquet", 0.0), ("b.csv", 0.0)] {
        let read = again(&written, name);
        assert_eq!((read.over, read.channels.len()), (Over::Frequency, 1), "{name}");
        assert!(differs(&written.channels[0].values, &read.channels[0].values) <= digits, "{name}");
        let imaginary = |recording: &Recording| recording.channels[0].imaginary.clone().unwrap_or_default();
        assert!(differs(&imaginary(&written), &imaginary(&read)) <= digits, "{name}");
        assert_eq!(written.grid.places(), read.grid.places());
        let channel = &read.channels[0];
        assert_eq!(
            (channel.name.as_str(), channel.quantity, channel.unit.as_str()),
            ("accelerance", Quantity::Response, "m/s^2/N"),
            "{name}"
        );
        assert!(!kinds(&read).contains(&FindingKind::UnknownUnit), "{name}");
    }
}

/// A name longer than the 20 columns of a label stands whole in the fourth line.
#[test]
fn a_long_name_is_read_back_whole() {
    let mut long = record();
    long.channels[0].name = "acceleration of the tip mass, z".to_owned();
    assert_eq!(again(&long, "long.uff").channels[0].name, long.channels[0].name);
}

/// What stands above the line tells how a response moves: `H(w) = 1 / (w0^2 - w^2 + 2 j zeta w0 w)` per newton as displacement, in millimetres
/// per kilonewton, and as acceleration, `-w^2 H`, in g per pound-force, have one and the same mode. Taken for each other they would not.
/// The columns of UFF hold 20 characters of a unit: 20 are written and read again, 21 are refused with both numbers, and nothing is left behind.
#[test]
fn a_unit_that_the_columns_would_cut_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let write_in = |unit: &str, ending: &str| {
        let mut recording = response();
        recording.channels[0].unit = unit.to_owned();
        let path = folder.path().join(format!("{}.{ending}", unit.len()));
        (write(&recording, &path).map_err(|error| error.to_string()), path)
    };
    let (fits, long) = ("counts per 100 N m/V", "counts per 1000 N m/V");
    let (written, path) = write_in(fits, "uff");
    written.expect("a file");
    assert_eq!(read::file(&path).expect("what was written").recordings[0].channels[0].unit, fits);
    let (refused, path) = write_in(long, "uff");
    let told = refused.expect_err("21 characters");
    assert!(told.contains("accelerance") && told.contains(long) && told.contains("21 characters") && told.contains("holds 20"), "{told}");
    assert!(!path.exists());
    assert!(write_in(long, "parquet").0.is_ok());
}

/// 10 characters of a place and 80 of a name are written and read again, one more is refused with both numbers, and nothing is left behind.
#[test]
fn a_place_or_name_that_the_format_would_change_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let written = |place: &str, name: &str, ending: &str| {
        let mut recording = record();
        (recording.channels[1].place, recording.channels[1].name) = (place.to_owned(), name.to_owned());
        let path = folder.path().join(format!("{}-{}.{ending}", place.len(), name.len()));
        (write(&recording, &path).map_err(|error| error.to_string()), path)
    };
    let name = "n".repeat(80);
    let (fits, path) = written("beam.tip 1", &name, "uff");
    fits.expect("a file");
    let again = &read::file(&path).expect("what was written").recordings[0].channels[1];
    assert_eq!((again.place.as_str(), &again.name), ("beam.tip 1", &name));
    for (place, name, told) in [
        ("beam.hammer", "a".to_owned(), "the place of a, \"beam.hammer\", has 11 characters; UFF holds 10: give a shorter one"),
        ("tip", "n".repeat(81), "has 81 characters; UFF holds 80: give a shorter one"),
        ("tip", "öse".to_owned(), "the name of öse, \"öse\", holds 'ö'; UFF holds ASCII only"),
    ] {
        let (refused, path) = written(place, &name, "uff");
        let refused = refused.expect_err("too long");
        assert!(refused.contains(told) && !path.exists(), "{refused}");
        assert!(written(place, &name, "csv").0.is_ok());
    }
}

#[test]
fn a_response_is_what_its_unit_says() {
    let (w0, zeta) = (TAU * 20.0, 0.01);
    for (unit, si, scale, acceleration) in [("mm/kN", "m/N", 1e6, false), ("(g)/(lbf)", "m/s^2/N", 4.448_221_615_260_5 / 9.80665, true)] {
        let mut text = format!("frequency [Hz];H [{unit}]\n");
        for k in 1..400 {
            let w = TAU * 0.1 * f64::from(k);
            let (a, b) = (w0 * w0 - w * w, 2.0 * zeta * w0 * w);
            let size = scale * if acceleration { -w * w } else { 1.0 } / (a * a + b * b);
            text.push_str(&format!("{};({:e}{:+e}j)\n", 0.1 * f64::from(k), a * size, -b * size));
        }
        let found = one("h.csv", text.as_bytes(), None);
        assert_eq!((found.channels[0].quantity, found.channels[0].unit.as_str()), (Quantity::Response, si));
        let responses = Responses::given(&[found]).expect("responses");
        let band = Band::of(&responses, (10.0, 30.0)).expect("a band");
        let modes = identify(&band, Settings { order: 10 }).expect("modes").modes;
        assert_eq!(modes.len(), 1, "{unit}");
        let (f, damping) = (modes[0].frequency_hz / 20.0 - 1.0, modes[0].damping_ratio / zeta - 1.0);
        eprintln!("{unit}: frequency off by {f:.1e}, damping by {damping:.1e}");
        assert!(f.abs() < 1e-9 && damping.abs() < 1e-7, "{unit}: {f:e} {damping:e}");
    }
}

#[test]
fn a_text_with_units_gaps_and_words_is_read_and_told() {
    let text = "Lab 3\nsensor: A\n\ntime_ms;a [g];Kraft (lbf);n\n0,0;1,0;2;7\n1,0;-1,5;NaN;8\n2,0;0,25;3\n3,0;0,5;x;9\n# end\n4,0;0;0;0\n";
    let found = one("a.txt", text.as_bytes(), None);
    assert!((found.rate() - 1000.0).abs() < 1e-9);
    assert_eq!(found.channels.len(), 3);
    assert!((found.channels[0].values[1] + 1.5 * 9.80665).abs() < 1e-14);
    assert_eq!((found.channels[1].quantity, found.channels[1].name.as_str()), (Quantity::Force, "Kraft"));
    let kinds = kinds(&found);
    for kind in [FindingKind::Converted, FindingKind::NotANumber, FindingKind::Ragged, FindingKind::Skipped] {
        assert!(kinds.contains(&kind), "{kind:?} is missing in {kinds:?}");
    }
    let latin = one("b.csv", b"t [s],a [m/s\xb2]\n0,1\n1,2\n2,3\n", None);
    assert_eq!(latin.channels[0].quantity, Quantity::Acceleration);
    assert!(
        latin.findings.iter().any(|f| f.kind == FindingKind::Encoding)
            && latin.findings.iter().any(|f| f.kind == FindingKind::NonAsciiUnit)
    );
}

/// A unit in round brackets that is not known is told, as one in square brackets; a place in them belongs to the name.
#[test]
fn a_unit_that_is_not_known_is_told_in_brackets_of_any_kind() {
    for head in ["U (furlong)", "U [furlong]", "U (pC)", "U (mA)", "U (dBm)", "U [dBm]", "U (dB re 1 furlong)"] {
        let found = one("a.csv", format!("t (s),{head}\n0,1\n1,20\n2,3\n").as_bytes(), None);
        assert_eq!((kinds(&found), found.channels[0].name.as_str()), (vec![FindingKind::UnknownUnit], "U"), "{head}");
        assert_eq!((found.channels[0].quantity, &found.channels[0].values[..]), (Quantity::Unknown, &[1.0, 20.0, 3.0][..]), "{head}");
    }
    for head in ["sensor (top)", "channel (1)", "a (ch2)"] {
        let found = one("a.csv", format!("t (s),{head}\n0,1\n1,20\n2,3\n").as_bytes(), None);
        assert_eq!((kinds(&found), found.channels[0].name.as_str(), found.channels[0].unit.as_str()), (Vec::new(), head, ""));
    }
    let named = one("a.csv", b"t/s,a/g\n0,1\n1,2\n2,3\n", None);
    assert_eq!((named.channels[0].name.as_str(), named.channels[0].values[1]), ("a", 2.0 * 9.80665));
}

/// One letter in brackets behind a sensor or channel may be a label as well as a unit: how it is read is told, and no more where notes say it.
/// An LVM file has a line of units, so that its heads are names.
#[test]
fn a_letter_that_may_be_a_label_is_told() {
    let text = b"t (s),sensor (A),channel (V),channel (B)\n0,1,2,3\n1,20,2.5,3.5\n2,3,2,3\n";
    let found = one("a.csv", text, None);
    let names: Vec<(&str, &str)> = found.channels.iter().map(|channel| (channel.name.as_str(), channel.unit.as_str())).collect();
    assert_eq!(names, [("sensor (A)", ""), ("channel", "V"), ("channel (B)", "")]);
    let told: Vec<String> = found.findings.iter().map(ToString::to_string).collect();
    assert!(kinds(&found) == [FindingKind::Assumed; 2] && told[0].contains("as a label") && told[1].contains("as the unit V"), "{told:?}");
    let notes = "[channel.\"sensor (A)\"]\nname = \"sensor A\"\n[channel.channel]\nunit = \"V\"\n";
    assert_eq!(kinds(&one("a.csv", text, Some(notes))), []);
    let labelled = one("a.lvm", lvm().replace("X_Value\tVoltage\t", "X_Value\tsensor (A)\t").as_bytes(), None);
    assert_eq!((labelled.channels[0].name.as_str(), labelled.channels[0].unit.as_str()), ("sensor (A)", "V"));
}

/// 20 dB is ten times an amplitude, and a hundred times a density.
#[test]
fn decibels_are_told_of_their_reference() {
    let cases = [
        ("a (dB re 1 m/s^2)", 10.0, "m/s^2"),
        ("a (dB re 1 g)", 98.0665, "m/s^2"),
        ("a (dB g)", 98.0665, "m/s^2"),
        ("a [dB rel. 1 m/s^2]", 10.0, "m/s^2"),
        ("p (dB re 20 uPa)", 2e-4, "Pa"),
        ("a (dB re 1e-6 m/s^2)", 1e-5, "m/s^2"),
        ("a (dB re 1e-6)", 1e-5, ""),
        ("a (dB)", 10.0, ""),
        ("S (dB re 1 g^2/Hz)", 100.0 * 9.80665 * 9.80665, "(m/s^2)^2/Hz"),
    ];
    for (head, due, unit) in cases {
        let found = one("a.csv", format!("t (s),{head}\n0,0\n1,20\n2,3\n").as_bytes(), None);
        let value = found.channels[0].values[1];
        assert!((value / due - 1.0).abs() < 1e-13, "{head}: {value}");
        assert_eq!(found.channels[0].unit, unit, "{head}");
        assert!(kinds(&found).contains(&FindingKind::Decibels), "{head}");
    }
}

/// A number at the end of a text may be cut; the line that has no end is told.
#[test]
fn a_last_line_without_an_end_is_told() {
    let open = one("a.csv", b"t [s],a [m/s^2]\n0,1\n1,20\n2,3", None);
    let told: Vec<String> = open.findings.iter().map(ToString::to_string).collect();
    assert!(told.len() == 1 && told[0].starts_with("the last line has no end") && told[0].ends_with("(at line 4)"), "{told:?}");
    assert_eq!(open.channels[0].values, [1.0, 20.0, 3.0]);
    assert_eq!(kinds(&one("a.csv", b"t [s],a [m/s^2]\n0,1\n1,20\n2,3\n", None)), []);
}

/// Two sets over grids of their own: the first is taken, and the other is told.
#[test]
fn the_record_that_is_taken_of_several_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let written = |name: &str, rate: f64| {
        let path = folder.path().join(name);
        let recording = Recording { grid: Grid::even(0.0, 1.0 / rate, 301).expect("a grid"), ..record() };
        write(&recording, &path).unwrap_or_else(|fault| panic!("{fault}"));
        std::fs::read(&path).expect("it was written")
    };
    let path = folder.path().join("both.uff");
    std::fs::write(&path, [written("a.uff", 1000.0), written("b.uff", 500.0)].concat()).expect("a file");
    for found in [read::record(&path), read::survey_record(&path).map(|taken| taken.into_recording().expect("in memory"))] {
        let found = found.unwrap_or_else(|fault| panic!("{fault}"));
        assert!((found.rate() - 1000.0).abs() < 1e-6);
        let told = found.findings.last().expect("a finding").to_string();
        assert!(told.contains("is taken") && told.contains("left out: both 2"), "{told}");
    }
}

#[test]
fn arrays_need_notes_where_they_tell_no_time() {
    let rows = vec![(0..50).map(|k| f64::from(k) * 1e-3).collect(), (0..50).map(|k| f64::from(k).sin()).collect::<Vec<f64>>()];
    let found = one("a.npy", &npy(&rows), None);
    assert_eq!((found.channels.len(), found.channels[0].values.len()), (1, 50));
    assert!((found.rate() - 1000.0).abs() < 1e-9);
    let only = vec![rows[1].clone(), rows[1].clone()];
    assert!(matches!(read("b.npy", &npy(&only), None), Err(ReadError::NoTime { .. })));
    let notes = "rate = \"2 kHz\"\n[channel.1]\nname = \"hammer\"\nunit = \"lbf\"\nscale = 10\n[channel.2]\nuse = false\n";
    let noted = one("b.npy", &npy(&only), Some(notes));
    assert_eq!((noted.channels.len(), noted.channels[0].name.as_str(), noted.rate()), (1, "hammer", 2000.0));
    assert!((noted.channels[0].values[1] / (only[0][1] * 44.482_216_152_605) - 1.0).abs() < 1e-14);
    let wrong = read("c.npy", &npy(&only), Some("rate = \"1 Hz\"\n[channel.hamster]\nunit = \"N\"\n")).expect_err("no such channel");
    assert!(wrong.to_string().contains("hamster") && wrong.to_string().contains("channel 1"), "{wrong}");
    let matrix = one("a.mat", &mat("m", &rows), None);
    assert_eq!(matrix.channels[0].name, "m(2)");
    assert_eq!(matrix.channels[0].values, rows[1]);
}

/// Numbers of two bytes: 1 sign bit, 5 of the exponent over 15, 10 of the fraction; so 0x3e00 is 1.5, and 0xc500 is -5.
#[test]
fn arrays_of_two_bytes_are_read_and_complex_ones_refused_with_a_way_out() {
    let header = |dtype: &str| {
        let bytes = npy(&[vec![0.0; 3]]);
        let text = String::from_utf8_lossy(&bytes[10..]).replace("'<f8'", &format!("'{dtype}'"));
        let line = text[..text.find('\n').expect("a header")].trim_end().to_owned();
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
        let found = one("a.npy", &[header(dtype), numbers].concat(), notes);
        assert_eq!(found.channels[0].values, [1.5, -5.0, 2.0_f64.powi(-24)], "{dtype}");
    }
    for dtype in ["<c8", "<c16"] {
        let told = read("a.npy", &[header(dtype), vec![0; 48]].concat(), notes).expect_err("complex").to_string();
        assert!(told.contains(&format!("complex ({dtype})")) && told.contains("NAME.re and NAME.im"), "{told}");
    }
}

/// A rate or a step beside the arrays stands for a time; a time wins, and a number that says something else is told; so is one against the notes.
#[test]
fn a_single_number_of_a_matrix_file_tells_the_rate() {
    let (ramp, tip): (Vec<f64>, Vec<f64>) = (0..50).map(|k| (f64::from(k) * 1e-3, f64::from(k).sin())).unzip();
    let with = |numbers: &[(&str, f64)], time: bool| {
        let mut bytes = mat("tip", std::slice::from_ref(&tip));
        numbers.iter().for_each(|(name, x)| bytes.extend(mat(name, &[vec![*x]]).split_off(128)));
        if time {
            bytes.extend(mat("t", std::slice::from_ref(&ramp)).split_off(128));
        }
        bytes
    };
    for (name, number) in [("fs", 2000.0), ("Fs", 2000.0), ("sample_rate", 2000.0), ("dt", 5e-4)] {
        let found = one("a.mat", &with(&[(name, number)], false), None);
        assert!((found.rate() / 2000.0 - 1.0).abs() < 1e-12 && found.grid.at(0) == 0.0, "{name}: {}", found.rate());
        assert_eq!((found.channels.len(), &found.channels[0].values, kinds(&found)), (1, &tip, vec![FindingKind::Assumed]), "{name}");
        assert!(found.findings[0].to_string().contains(&format!("at 2000 Hz from 0 s on, by {name} = {number} ")), "{:?}", found.findings);
    }
    let told = |bytes: &[u8], notes: Option<&str>, rate: f64, words: &str| {
        let found = one("a.mat", bytes, notes);
        assert!((found.rate() / rate - 1.0).abs() < 1e-9, "{}", found.rate());
        let found: Vec<String> = found.findings.iter().map(ToString::to_string).collect();
        assert!(found.iter().any(|told| told.contains(words)), "{found:?} {words}");
    };
    told(
        &with(&[("fs", 2000.0)], true),
        None,
        1000.0,
        "fs = 2000 in the file is 2000 Hz, the stamps say 1000.000000 Hz; the stamps are used",
    );
    told(&with(&[("fs", 2000.0)], false), Some("rate = \"500 Hz\"\n"), 500.0, "the notes say 500.000000 Hz; the notes are used");
    told(&with(&[("fs", 2000.0), ("dt", 1e-3)], false), None, 2000.0, "dt = 0.001 one of 1000 Hz; the first is taken");
    assert!(!kinds(&one("a.mat", &with(&[("fs", 1000.0), ("dt", 1e-3)], true), None)).contains(&FindingKind::HeaderDisagrees));
    // The first column of a matrix is its time where it has that rate.
    let both = |ramp: Vec<f64>| [mat("m", &[ramp, tip.clone()]), mat("fs", &[vec![1000.0]]).split_off(128)].concat();
    assert_eq!(one("a.mat", &both(ramp.clone()), None).channels.len(), 1);
    assert_eq!(one("a.mat", &both(ramp.iter().map(|t| 7.0 * t).collect()), None).channels.len(), 2);
    for (name, number) in [("fs", 0.0), ("fs", f64::NAN), ("gain", 2000.0)] {
        let refused = read("a.mat", &with(&[(name, number)], false), None);
        assert!(matches!(refused, Err(ReadError::NoTime { .. })), "{name} = {number}: {refused:?}");
    }
}

#[test]
fn the_stamps_of_an_lvm_win_over_its_header() {
    let found = one("a.lvm", lvm().as_bytes(), None);
    assert!((found.rate() - 800.0).abs() < 1e-9);
    assert_eq!(found.channels.iter().map(|c| c.quantity).collect::<Vec<_>>(), [Quantity::Voltage, Quantity::Force]);
    let kinds = kinds(&found);
    assert!(kinds.contains(&FindingKind::RescaledStamps) && kinds.contains(&FindingKind::HeaderDisagrees), "{kinds:?}");
}

/// The header of a second segment is no data: it is told where it ends.
#[test]
fn a_second_segment_is_refused_at_its_place() {
    let segment = lvm().split_once("***End_of_Header***\t\n\t\n").expect("a header").1.to_owned();
    let wrong = read("a.lvm", format!("{}\n{segment}", lvm()).as_bytes(), None).expect_err("two segments").to_string();
    let line = lvm().lines().count() + 1 + segment.lines().position(|line| line.starts_with("***")).expect("a header") + 1;
    assert!(wrong.contains(&format!("line {line}")) && wrong.contains("segment"), "{wrong}");
}

/// Numbers written one after the other in lines of unequal length are no columns, whatever rate is given; a few odd lines are harmless.
#[test]
fn a_text_whose_lines_differ_is_no_table() {
    let text = "1 2\n3 4\n5 6\n".to_owned() + &"1 2 3\n".repeat(30);
    let wrong = read("a.txt", text.as_bytes(), Some("rate = \"10 Hz\"\n")).expect_err("no table").to_string();
    assert!(wrong.contains("line 4") && wrong.contains("29 more of 33 lines") && wrong.contains(".channels.toml"), "{wrong}");
    let odd = "t a\n".to_owned() + &"1 2\n3 4\n5 6\n".repeat(10) + "1 2 3\n";
    assert!(kinds(&one("a.txt", odd.as_bytes(), Some("rate = \"10 Hz\"\n"))).contains(&FindingKind::Ragged));
}

#[test]
fn binary_functions_of_every_order_and_size_are_read() {
    for (double, little) in [(false, false), (false, true), (true, false), (true, true)] {
        let found = one("a.uff", &uff58b(double, little), None);
        let Grid::Stamped(stamps) = &found.grid else { panic!("stamped") };
        assert_eq!(stamps[19], 361.0);
        assert!((found.channels[0].values[19] - 15.5 * 9.80665).abs() < 1e-5, "{double} {little}");
        assert_eq!((found.channels[0].place.as_str(), found.channels[0].direction.as_str()), ("node 5", "+z"));
    }
}

/// Of two arrays the second is cut: half a recording is none. An element that is no array is told.
#[test]
fn a_matrix_file_is_read_element_by_element() {
    let ramp: Vec<f64> = (0..50).map(|k| f64::from(k) * 1e-3).collect();
    let second = mat("tip", &[ramp.iter().map(|t| t.sin()).collect()]).split_off(128);
    let both = [mat("t", std::slice::from_ref(&ramp)), second.clone()].concat();
    let whole = one("a.mat", &both, None);
    assert_eq!((whole.channels.len(), whole.channels[0].name.as_str()), (1, "tip"));
    let told = read("a.mat", &both[..both.len() - 8], None).expect_err("it is cut").to_string();
    let begin = both.len() - second.len();
    assert!(told.contains(&format!("byte {begin}")) && told.contains("was the file cut?"), "{told}");
    let mut odd = both.clone();
    // The class of the second array becomes that of a cell.
    odd[begin + 16] = 1;
    let rate = Some("rate = \"1 kHz\"\n");
    assert!(kinds(&one("a.mat", &odd, rate)).contains(&FindingKind::Skipped));
}

/// A time of 50 samples and channels of 40 are no recording.
#[test]
fn a_matrix_file_without_a_channel_as_long_as_its_time_is_refused() {
    let ramp: Vec<f64> = (0..50).map(|k| f64::from(k) * 1e-3).collect();
    let short = mat("tip", &[ramp[..40].to_vec()]).split_off(128);
    let told = read("a.mat", &[mat("t", &[ramp]), short].concat(), None).expect_err("no channel").to_string();
    assert!(told.contains("no channel is left") && told.contains("tip has 40 samples where the record has 50"), "{told}");
}

/// Lines of samples that never end would fill the memory.
#[test]
fn an_endless_line_is_refused() {
    let text = ["1,2\n3,4\n5,6\n".to_owned(), "7,".repeat(9 << 20)].concat();
    let told = read("a.csv", text.as_bytes(), Some("rate = \"1 Hz\"\n")).expect_err("too long").to_string();
    assert!(told.contains("line 4") && told.contains("16 MiB"), "{told}");
}

#[test]
fn what_is_no_recording_is_refused_with_its_reason() {
    let cases: [(&str, &[u8], &str); 8] = [
        ("a.csv", b"", "empty"),
        ("a.csv", b"no numbers\nat all\n", "no rows of numbers"),
        ("a.csv", b"a,b\n5,1\n3,2\n4,3\n", "no column ascends"),
        ("a.csv", b"t,b\n0,1\n2,2\n1,3\n", "before"),
        ("a.mat", b"MATLAB 7.3 MAT-file", "HDF5"),
        ("a.bin", b"\x01\x02\x00\x00", "binary"),
        ("a.txt", b"\xff\xfet\x00", "UTF-16"),
        ("a.uff", b"    -1\n   164\n         1  SI\n    -1\n", "no data set 55 or 58"),
    ];
    for (name, bytes, why) in cases {
        let told = read(name, bytes, None).expect_err(why).to_string();
        assert!(told.contains(why), "{told}");
    }
    let constant = one("a.csv", b"t,a\n0,1\n1,1\n2,1\n3,1\n", None);
    assert!(kinds(&constant).contains(&FindingKind::Constant));
}

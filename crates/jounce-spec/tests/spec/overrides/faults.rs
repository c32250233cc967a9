//! Faults of overrides.

use jounce_spec::SpecFile;

use super::read_with;
use crate::paper;

/// Key, value, and a part of the fault.
const FAULTS: [(&str, &str, &str); 11] = [
    (
        "stop.tip.gpa",
        "1 mm",
        "--set stop.tip.gpa=1 mm: stop.tip.gpa: unknown key; keys in stop.tip: at, frame, side, gap, law, exponent, stiffness, cubic_stiffness, damping, penetration_m, penetration, force_n, force and 15 more; the nearest key here is `stop.tip.gap`",
    ),
    (
        "stop.tpi.gap",
        "1 mm",
        "--set stop.tpi.gap=1 mm: stop.tpi.gap: this file has no [stop.tpi]; it has: tip; the nearest key here is `stop.tip.gap`",
    ),
    (
        "stop.tip",
        "1 mm",
        "--set stop.tip=1 mm: stop.tip: stop.tip is a table; its keys: ",
    ),
    (
        "",
        "1",
        "--set =1: : unknown key; keys here: beam, plate, patch, layer, mass, ",
    ),
    (
        "stop.tip.gap",
        "1 Hz",
        "--set stop.tip.gap=1 Hz: stop.tip.gap: \"1 Hz\" is a frequency; expected a length in mm, um, cm, m",
    ),
    (
        "stop.tip.gap",
        "1",
        "--set stop.tip.gap=1: stop.tip.gap: 1 has no unit; expected a length",
    ),
    (
        "circuit.load.resistance",
        "0 ohm",
        "--set circuit.load.resistance=0 ohm: circuit.load.resistance is 0 ohm; it must be greater than 0",
    ),
    (
        "mass.table.damping_ratio",
        "nan",
        "--set mass.table.damping_ratio=nan: mass.table.damping_ratio is nan; it must be from 0 to 10",
    ),
    (
        "patch.mfc.length",
        "400 mm",
        "--set patch.mfc.length=400 mm: patch.mfc.length: the patch ends 409 mm from the root; it must not exceed the beam length 315 mm",
    ),
    (
        "stop.tip.frame",
        "tabel",
        "there is no point or mass \"tabel\" (did you mean `table`?); points and masses here: ground, beam.hammer",
    ),
    (
        "run.average_over",
        "30 s",
        "--set run.average_over=30 s: run.average_over is 30 s; it must be at most run.duration = 20 s: write run.average_over = \"20 s\" or run.duration = \"30 s\"",
    ),
];

#[test]
fn faults_name_the_override_as_their_place() {
    for (key, value, message) in FAULTS {
        let fault = read_with(&[(key, value)]).unwrap_err();
        assert!(
            fault.starts_with("--set") && fault.contains(message),
            "{fault}"
        );
    }
}

#[test]
fn a_fault_of_a_table_that_the_file_lacks_has_no_place() {
    let paper = paper();
    let (before, after) = paper.split_once("[damping]\n").unwrap();
    let (_, rest) = after.split_once('\n').unwrap();
    let without_key = format!("{before}[damping]\n{rest}");
    let line = before.lines().count() + 1;
    for (text, place) in [
        (format!("{before}{rest}"), (0, 0)),
        (without_key, (line, 2)),
    ] {
        let faults = SpecFile::from_text(text).spec().unwrap_err();
        let [fault] = faults.as_slice() else {
            panic!("{faults}")
        };
        assert_eq!((fault.line, fault.column), place, "{fault}");
        assert_eq!(fault.key, "damping.ratios");
        let is_said = fault.message.ends_with("; the file has no [damping]");
        assert_eq!(is_said, place.0 == 0, "{fault}");
    }
}

#[test]
fn a_fault_in_the_file_names_the_override_that_causes_it() {
    let mut file = SpecFile::from_text(paper());
    file.set("beam.beam.length", "50 mm").unwrap();
    let faults = file.spec().unwrap_err();
    assert!(!faults.as_slice().is_empty());
    for fault in faults.as_slice() {
        assert!(
            fault.line > 0
                && fault
                    .message
                    .ends_with("; caused by --set beam.beam.length=50 mm"),
            "{fault}"
        );
    }
}

/// An override without which the fault remains is not named.
#[test]
fn a_fault_names_only_the_overrides_that_cause_it() {
    let mut file = SpecFile::from_text(paper());
    for (key, value) in [
        ("run.duration", "2 s"),
        ("run.average_over", "1 s"),
        ("beam.beam.length", "50 mm"),
    ] {
        file.set(key, value).unwrap();
    }
    for fault in file.spec().unwrap_err().as_slice() {
        let (_, causes) = fault.message.split_once("; caused by ").unwrap();
        assert_eq!(causes, "--set beam.beam.length=50 mm", "{fault}");
    }
    // Neither of two alone is the cause.
    let mut file = SpecFile::from_text(paper());
    file.set("stop.tip.at", "ground").unwrap();
    file.set("beam.beam.length", "50 mm").unwrap();
    assert!(file.sets("beam.beam.length") && !file.sets("beam.beam.width"));
}

/// A misspelt table or key gives one fault, without the faults that follow from it.
#[test]
fn a_misspelling_gives_one_fault() {
    for (right, wrong) in [
        ("[beam.beam]", "[beem.beam]"),
        ("length = \"315 mm\"", "lenght = \"315 mm\""),
        ("law = \"hertz\"", "laww = \"hertz\""),
    ] {
        let text = paper();
        assert!(text.contains(right), "{right}");
        let faults = SpecFile::from_text(text.replacen(right, wrong, 1)).spec();
        let faults = faults.unwrap_err();
        assert_eq!(faults.as_slice().len(), 1, "{wrong}: {faults}");
        assert!(faults.to_string().contains("did you mean"), "{faults}");
    }
    let beam = "[beam.b]\nlength = \"1 m\"\nwidth = \"1 cm\"\nthickness = \"1 mm\"\n";
    let faults = |text: &str| SpecFile::from_text(text).spec().unwrap_err().to_string();
    let misspelt = faults(&format!("{beam}materiel = \"steel\"\n"));
    assert!(!misspelt.contains("is missing"), "{misspelt}");
    let missing = faults(beam);
    assert!(missing.contains("or give `material`"), "{missing}");
}

/// The keys of a misspelt table are those that its name means, so its faults and those of the rules
/// between keys are reported too.
#[test]
fn a_misspelt_table_hides_no_other_fault() {
    let beam =
        "material = \"steel\"\nlength = \"50 mm\"\nwidth = \"10 mm\"\nthickness = \"1 mm\"\n";
    let other = beam.replace("50 mm", "50");
    let run = "[run]\nduration = \"1 s\"\naverage_over = \"2 s\"\n[damping]\nbeyond = 0.01\n";
    let of = |text: String| {
        let faults = SpecFile::from_text(text).spec().unwrap_err();
        let lines = faults.as_slice().iter();
        lines
            .map(|fault| (fault.line, fault.key.clone()))
            .collect::<Vec<_>>()
    };
    let fault = |line, key: &str| (line, key.to_owned());
    assert_eq!(
        of(format!(
            "[beem.a]\n{beam}[beam.b]\n{other}[beem.a.point]\ntip = \"60 mm\"\n{run}"
        )),
        [
            fault(1, "beem"),
            fault(8, "beam.b.length"),
            fault(12, "beam.a.point.tip"),
            fault(15, "run.average_over"),
        ]
    );
    assert_eq!(
        of(format!("[beam.a]\n{beam}{}", run.replace("run]", "runn]"))),
        [fault(6, "runn"), fault(8, "run.average_over")]
    );
    assert_eq!(
        of(format!("beem = 1\n[beam.a]\n{beam}{run}")),
        [fault(1, "beem"), fault(9, "run.average_over")]
    );
}

/// A table of numbers is no spec.
#[test]
fn another_text_gives_one_fault() {
    let faults = SpecFile::from_text("time [s],voltage [V]\n0,1\n1,2\n").spec();
    let faults = faults.unwrap_err().to_string();
    let expected = "line 1, column 1: this is no spec: its first line is neither [TABLE] nor KEY = VALUE; `jounce read` reads a recording";
    assert_eq!(faults, expected);
    let quantity = SpecFile::from_text("[beam.b]\nlength = 110 mm\n").spec();
    let quantity = quantity.unwrap_err().to_string();
    assert!(
        quantity.contains("beam.b.length: write the quantity in quotes"),
        "{quantity}"
    );
}

/// Each change of the message, next to that of the user, gives a spec without faults.
#[test]
fn a_window_longer_than_the_run_names_the_overrides_that_fit() {
    for (key, value) in [
        ("run.duration", "1 s"),
        ("run.duration", "333.333 ms"),
        ("run.average_over", "0.7 h"),
    ] {
        let fault = read_with(&[(key, value)]).unwrap_err();
        let named: Vec<(&str, &str)> = fault
            .match_indices(" = \"")
            .map(|(at, equals)| {
                let key = fault[..at].rsplit(' ').next().unwrap();
                (key, fault[at + equals.len()..].split('"').next().unwrap())
            })
            .collect();
        let keys: Vec<&str> = named.iter().map(|(key, _)| *key).collect();
        assert_eq!(keys, ["run.average_over", "run.duration"], "{fault}");
        for change in named {
            read_with(&[(key, value), change]).unwrap();
        }
    }
}

#[test]
fn faults_cross_to_json_with_their_place() {
    let mut file = SpecFile::from_text(paper().replace("length = \"85 mm\"", "length = 85"));
    file.set("stop.tip.gap", "true").unwrap();
    let faults = serde_json::to_value(file.spec().unwrap_err()).unwrap();
    assert_eq!(faults.as_array().unwrap().len(), 2, "{faults}");
    assert_eq!(
        (&faults[0]["line"], &faults[0]["set"]),
        (&0.into(), &"--set stop.tip.gap=true".into())
    );
    assert_eq!(
        (&faults[1]["line"], &faults[1]["column"], &faults[1]["key"]),
        (&18.into(), &10.into(), &"patch.mfc.length".into())
    );
    assert!(faults[1].get("set").is_none());
}

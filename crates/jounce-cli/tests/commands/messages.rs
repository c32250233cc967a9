//! Messages about wrong options and faults in files: each names the option or the place, and what to
//! do.

use crate::{SPEC, jounce};
use jounce::parts::{Branch, BranchKind, BranchQuantity, NotProved};
use jounce::{BranchOptions, BranchResult};

const GAP_OVER: &str = "stop.tip.gap=1mm:2mm:3";

/// Commands with a wrong option, and the message of each; `SPEC` precedes the options.
const WRONG_OPTIONS: [(&str, &[&str], &str); 26] = [
    (
        "check",
        &["--set", "stop.tip.gap=1 mm", "--set", "stop.tip.gap=2 mm"],
        "--set gives stop.tip.gap twice: stop.tip.gap=1 mm and stop.tip.gap=2 mm",
    ),
    (
        "modes",
        &["--order", "3"],
        "--order applies to recordings: name them with --measured FILE..., or omit it",
    ),
    (
        "modes",
        &["--measured", "a.csv"],
        "SPEC does not apply to recordings: omit it, or omit --measured",
    ),
    ("frf", &["--estimator", "h2"], "--estimator applies to"),
    (
        "frf",
        &["--input", "table", "--hold", "table"],
        "--input is table; it moves nothing, so that all responses are 0",
    ),
    (
        "run",
        &["--record", "1 s"],
        "--record is 1 s; the stored end goes to --out DIR or --json",
    ),
    (
        "run",
        &["--tolerance", "1e-8", "--set", "run.tolerance=1e-9"],
        "run.tolerance is set too; omit one of them",
    ),
    (
        "sweep",
        &["--tolerance", "1e-8", "--over", "run.tolerance=1e-9,1e-8"],
        "--over gives the values of run.tolerance; omit one of them",
    ),
    (
        "export",
        &["--matrices", "x", "--spice", "x"],
        "--spice is x; it is the folder of the matrices too",
    ),
    (
        "frf",
        &["--base", "--frequency", "10Hz", "--low", "1Hz"],
        "--low",
    ),
    (
        "frf",
        &["--base", "--input", "table"],
        "omit --input, or omit --base",
    ),
    (
        "basins",
        &["--starts", "x"],
        "--starts is x; it must be a whole number",
    ),
    (
        "basins",
        &["--spread", "wide"],
        "--spread is wide; it must be a number",
    ),
    (
        "basins",
        &["--grid", "voltage=-1V:1V:3x", "--starts", "5"],
        "or omit --grid",
    ),
    (
        "run",
        &["--tolerance", "-1"],
        "--tolerance is -1; it must be from 1e-13 to 0.1",
    ),
    (
        "sweep",
        &["--over", GAP_OVER],
        "--over is stop.tip.gap=1mm:2mm:3; the step is 3",
    ),
    (
        "sweep",
        &["--over", "stop.tip.law=hertz,spring"],
        "stop.tip.law is a name, not a number; give a key with a number",
    ),
    (
        "sweep",
        &[
            "--over",
            "stop.tip.gap=1mm,2mm",
            "--set",
            "stop.tip.gap=1 mm",
        ],
        "--over gives the values of stop.tip.gap; omit --set stop.tip.gap=1 mm",
    ),
    (
        "frf",
        &["--frequency", "-3Hz"],
        "--frequency is -3 Hz; it must be above 0 Hz",
    ),
    (
        "run",
        &["--threads", "2"],
        "`jounce run` has --set, --tolerance",
    ),
    (
        "check",
        &["other.toml"],
        "`jounce check` takes one SPEC; give other.toml in a call of its own",
    ),
    ("show", &["-o", "x.svg"], "`jounce show` has --out"),
    (
        "branch",
        &["--over", GAP_OVER],
        "as in stop.tip.gap=1mm:2mm",
    ),
    (
        "branch",
        &["--over", "reduction.modes=1:3"],
        "is a whole number",
    ),
    (
        "branch",
        &["--over", "stop.tip.gap=2mm:1mm"],
        "the first value must be below the second",
    ),
    (
        "branch",
        &["--over", "stop.tip.gap=1mm:2mm", "--budget", "0"],
        "--budget is 0; it must be at least 1",
    ),
];

#[test]
fn wrong_options_are_refused_by_name() {
    for (command, options, message) in WRONG_OPTIONS {
        let (code, _, stderr) = jounce(&[&[command, SPEC], options].concat());
        assert!(
            code == 2 && stderr.contains(message) && !stderr.contains("panicked"),
            "{command} {options:?}: {code} {stderr}"
        );
    }
}

#[test]
fn faults_of_a_study_name_the_file_and_the_place() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("study.toml");
    let vary = "[vary]\n\"stop.tip.gap\" = \"1mm:2mm:2x\"\n";
    for (text, message) in [
        (vary.to_owned(), "study.toml: the study names no spec"),
        (
            format!("spec = {SPEC:?}\n[quantity]\ncommand = \"modes\"\n"),
            "study.toml: vary names no key: the table [vary] is missing",
        ),
        (
            format!("spec = {SPEC:?}\n{vary}[quantity]\ncount = 3\n"),
            "study.toml:line 4, column 1: quantity.command is missing",
        ),
        (
            format!(
                "spec = {SPEC:?}\n{vary}[quantity]\ncommand = \"sweep\"\nover = \"stop.tip.gap=1mm,2mm\"\n"
            ),
            "study.toml:line 3, column 18: vary.stop.tip.gap: quantity.over gives the values of this key",
        ),
        (
            format!("spec = {SPEC:?}\n[set]\n\"stop.tip.gap\" = \"1 kg\"\n{vary}"),
            "study.toml:line 3, column 18: set: stop.tip.gap",
        ),
        (
            format!("spec = {SPEC:?}\n[set]\n\"stop.tip.gap\" = \"1 mm\"\n{vary}"),
            "study.toml:line 5, column 18: vary.stop.tip.gap: [set] gives this key too",
        ),
        (
            format!("spec = \"none.toml\"\n{vary}"),
            "study.toml:line 1, column 8: spec: ",
        ),
    ] {
        std::fs::write(&file, text).unwrap();
        let out = folder.path().join("out");
        let arguments = ["study", "run", file.to_str().unwrap(), "--out"];
        let (code, _, stderr) = jounce(&[&arguments[..], &[out.to_str().unwrap()]].concat());
        assert!(
            code == 4 && stderr.contains(message) && !stderr.contains("panicked"),
            "{code} {stderr}"
        );
    }
}

#[test]
fn faults_of_features_have_one_line_each() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("features.toml");
    let text =
        "hold = 3\n[free]\n\"beam.beam.length\" = -1\n[[mode]]\nnumber = 0\nfrequency = \"3 mm\"\n";
    std::fs::write(&file, text).unwrap();
    let (code, _, stderr) = jounce(&["fit", SPEC, "--to", file.to_str().unwrap()]);
    let lines: Vec<&str> = stderr.lines().collect();
    assert_eq!((code, lines.len()), (4, 4), "{stderr}");
    for (line, place) in lines
        .iter()
        .zip(["line 1: ", "line 3: ", "line 5: ", "line 6: "])
    {
        assert!(
            line.contains(&format!("features.toml:{place}")),
            "{place}: {line}"
        );
    }
}

/// Faults that show only with the spec name the file of the features too.
#[test]
fn features_that_do_not_fit_the_spec_name_their_file() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("features.toml");
    let mode = "[[mode]]\nnumber = 1\nfrequency = \"9 Hz\"\nfrequency_deviation = 0.01\n";
    for (free, message) in [
        (
            "[free]\n\"beam.beam.young\" = 0.1\n",
            "features.toml: free: beam.beam.young: unknown key",
        ),
        (
            "hold = [\"tabel\"]\n[free]\n\"beam.beam.length\" = 0.1\n",
            "features.toml: cannot hold",
        ),
    ] {
        std::fs::write(&file, format!("{free}{mode}")).unwrap();
        let (code, _, stderr) = jounce(&["fit", SPEC, "--to", file.to_str().unwrap()]);
        assert!(code == 4 && stderr.contains(message), "{code} {stderr}");
    }
}

/// Faults of all overrides are reported together.
#[test]
fn faults_of_overrides_come_together() {
    let set = [
        "--set",
        "stop.tip.stiffnes=3",
        "--set",
        "beam.beam.length=kg",
    ];
    let (code, _, stderr) = jounce(&[&["check", SPEC], &set[..]].concat());
    assert_eq!((code, stderr.lines().count()), (4, 2), "{stderr}");
}

/// A state of another harvester, and a record that its sampling rate spoils.
#[test]
fn a_run_names_what_does_not_fit() {
    let folder = tempfile::tempdir().unwrap();
    let state = folder.path().join("state.json");
    let state = state.to_str().unwrap();
    let short = [
        "--set",
        "run.duration=0.5 s",
        "--set",
        "run.average_over=0.5 s",
    ];
    let run = [&["run", SPEC], &short[..]].concat();
    let (code, ..) = jounce(&[&run[..], &["--save-state", state]].concat());
    assert_eq!(code, 0);
    let fewer = ["--set", "reduction.modes=2", "--start", state];
    let (code, _, stderr) = jounce(&[&run[..], &fewer].concat());
    let named = stderr.contains("--start is ") && stderr.contains("of another harvester: ");
    assert!(code == 4 && named && !stderr.contains("drives"), "{stderr}");
    let slow = ["--json", "--record", "0.2 s", "--sample-rate", "10Hz"];
    let (code, _, stderr) = jounce(&[&run[..], &slow].concat());
    let warning = "warning: --sample-rate is 10 Hz, below twice the drive frequency";
    assert!(code == 0 && stderr.contains(warning), "{stderr}");
}

/// Undecided starts are no attractor, and the expected power contains their transients.
#[test]
fn undecided_starts_give_a_warning() {
    let few = ["--starts", "2", "--max-cycles", "1"];
    let (code, _, stderr) = jounce(&[&["basins", SPEC], &few[..]].concat());
    let warning = "warning: 2 of 2 starts are undecided, so that the expected power contains transients; give a larger --max-cycles";
    assert!(code == 0 && stderr.contains(warning), "{stderr}");
    assert!(!stderr.contains("attractor undecided"), "{stderr}");
}

/// The kind of the event is no option, so that it is not quoted as one.
#[test]
fn events_without_proof_are_a_sentence() {
    let branch = Branch {
        period_cycles: 1,
        points: Vec::new(),
        bifurcations: Vec::new(),
        not_proved: vec![NotProved {
            event: BranchKind::Fold,
            from: 12.25,
            to: 12.5,
            message: "not proved on the smallest steps".to_owned(),
        }],
        termination: Vec::new(),
        not_followed: 0,
        peak: None,
        half_power_bandwidth: None,
    };
    let result = BranchResult {
        key: "drive.shaker.frequency".to_owned(),
        unit: "Hz".to_owned(),
        branches: vec![branch],
        peak: None,
        half_power_bandwidth: None,
        note: String::new(),
        quantity: BranchQuantity::MeanPower,
        options: BranchOptions::default(),
    };
    assert_eq!(
        result.warnings(),
        [
            "from 12.25 to 12.5 Hz, a branch of period 1 may have more or fewer events of the kind fold than listed \
             (not proved on the smallest steps); try a smaller `tolerance`"
        ]
    );
}

//! Goals that a spec cannot have, and free keys without an effect.

use super::{LINEAR, LOAD, outcome_of, problem_of};
use jounce_design::Problem;
use jounce_spec::SpecFile;
use std::path::Path;

const FREE: &str = "[free]\n\"circuit.load.resistance\" = \"10kohm:1Mohm:log\"\n";

fn error_of(spec: &str, text: &str) -> String {
    problem_of(spec, text).map_or_else(|error| error.to_string(), |_| String::new())
}

fn under_noise() -> String {
    LINEAR.replace(
        "amplitude = \"0.7 N\"\nfrequency = \"9.7 Hz\"",
        "signal = \"noise\"\npsd = \"0.1 N^2/Hz\"\nlow = \"5 Hz\"\nhigh = \"20 Hz\"",
    )
}

/// A cantilever whose patch has its stiffness but not its mass.
const CANTILEVER: &str = "[beam.b]\nyoungs_modulus = \"200 GPa\"\ndensity = \"7800 kg/m^3\"\nlength = \"100 mm\"\nwidth = \"20 mm\"\nthickness = \"1 mm\"\n\
    [patch.p]\non = \"b\"\nstart = \"0 mm\"\nlength = \"20 mm\"\nwidth = \"20 mm\"\nthickness = \"0.3 mm\"\nsection = \"thin-skin\"\n\
    youngs_modulus = \"30 GPa\"\ndensity = \"5440 kg/m^3\"\nd31 = \"-170 pC/N\"\ncapacitance = \"50 nF\"\n\
    [circuit.load]\npatch = \"p\"\nresistance = \"100 kohm\"\n\
    [drive.d]\nat = \"b.end\"\namplitude = \"0.1 N\"\nfrequency = \"20 Hz\"\n[damping]\nbeyond = 0.01\n\
    [reduction]\nmodes = 2\n[run]\nduration = \"1 s\"\naverage_over = \"1 s\"\n";

#[test]
fn a_misspelt_goal_is_one_fault_with_the_word() {
    let error = error_of(
        LINEAR,
        &format!("{FREE}[goal]\nmaximize = \"mean-power\"\n"),
    );
    assert!(error.contains("(did you mean `maximise`?)"), "{error}");
    assert!(!error.contains("missing"), "{error}");
    let error = error_of(LINEAR, &format!("{FREE}[goal]\nmaximise = \"mean\"\n"));
    assert!(error.contains("(did you mean `mean-power`?)"), "{error}");
}

#[test]
fn goals_of_orbits_need_periodic_drives() {
    for goal in ["expected-power", "stable-power", "bandwidth"] {
        let text = format!("{FREE}[goal]\nmaximise = [\"mean-power\", \"{goal}\"]\n");
        let error = error_of(&under_noise(), &text);
        assert!(
            error.contains("line 4")
                && error.contains(&format!("goal.maximise lists \"{goal}\""))
                && error.contains("drive `d`")
                && error.contains("choose \"mean-power\""),
            "{error}"
        );
    }
    let text = format!("{FREE}[goal]\nmaximise = \"mean-power\"\n");
    assert_eq!(error_of(&under_noise(), &text), "");
}

#[test]
fn a_bandwidth_needs_a_drive_with_a_frequency() {
    let spec = LINEAR.replace(
        "[drive.d]\nat = \"m.tip\"\nkind = \"force\"\namplitude = \"0.7 N\"\nfrequency = \"9.7 Hz\"",
        "",
    );
    let text = format!("{FREE}[goal]\nmaximise = \"bandwidth\"\n");
    let error = error_of(&spec, &text);
    assert!(error.contains("drive"), "{error}");
}

#[test]
fn every_goal_needs_a_circuit_that_takes_power() {
    let spec = LINEAR
        .replace(
            "capacitance = \"150 nF\"",
            "capacitance = \"150 nF\"\nelectrodes = \"open\"",
        )
        .replace(
            "[circuit.load]\npatch = \"m.p\"\nresistance = \"80 kohm\"",
            "",
        );
    for goal in ["expected-power", "stable-power", "bandwidth", "mean-power"] {
        let text = format!(
            "[free]\n\"drive.d.frequency\" = \"9Hz:10Hz\"\n[goal]\nmaximise = \"{goal}\"\n"
        );
        let error = error_of(&spec, &text);
        assert!(
            error.contains("line 4")
                && error.contains(goal)
                && error.contains("no circuit")
                && error.contains("[circuit.NAME]"),
            "{error}"
        );
    }
}

#[test]
fn a_choice_that_a_goal_cannot_have_is_named() {
    let text = "[free]\n\"drive.d\" = [{ signal = \"sine\" }, { signal = \"noise\", amplitude = \"\", frequency = \"\", psd = \"0.1 N^2/Hz\", low = \"5 Hz\", high = \"20 Hz\" }]\n\
        [goal]\nmaximise = \"expected-power\"\n";
    let error = error_of(LINEAR, text);
    assert!(
        error.contains("signal = \"noise\"") && error.contains("drive `d`"),
        "{error}"
    );
}

#[test]
fn a_key_without_an_effect_is_refused() {
    let goal = "[goal]\nmaximise = \"expected-power\"\n";
    let free = "[free]\n\"patch.p.density\" = \"5000:6000 kg/m^3\"\n\"patch.p.length\" = \"10mm:30mm\"\n\"run.duration\" = \"1s:2s\"\n\
        \"patch.p.material\" = [\"PZT-5A\", \"PZT-5H\"]\n";
    let error = error_of(CANTILEVER, &format!("{free}{goal}"));
    let lines: Vec<&str> = error.lines().collect();
    let [density, duration, material] = lines[..] else {
        panic!("{error}")
    };
    assert!(density.contains("line 2") && density.contains("free.patch.p.density"));
    assert!(duration.contains("line 4") && duration.contains("free.run.duration"));
    assert!(material.contains("line 5") && material.contains("free.patch.p.material"));
    assert!(lines.iter().all(|line| line.contains("remove")), "{error}");
    // Also where no duration of the range is as long as the window of 1 s.
    let short = format!("[free]\n\"run.duration\" = \"0.1s:0.5s\"\n{goal}");
    let error = error_of(CANTILEVER, &short);
    assert!(
        error.contains("line 2") && error.contains("free.run.duration: no goal"),
        "{error}"
    );
    // A limit of the mass depends on the density, and a run on its duration.
    let limited = format!(
        "[free]\n\"patch.p.density\" = \"5000:6000 kg/m^3\"\n{goal}[limits]\nmass = \"50 g\"\n"
    );
    assert_eq!(error_of(CANTILEVER, &limited), "");
    let run = "[free]\n\"run.duration\" = \"1s:2s\"\n[goal]\nmaximise = \"mean-power\"\n";
    assert_eq!(error_of(CANTILEVER, run), "");
}

#[test]
fn a_key_is_free_or_set_by_the_conditions() {
    let text = format!(
        "{FREE}\"drive.d.frequency\" = \"9Hz:10Hz\"\n[goal]\nmaximise = \"expected-power\"\n\
         [[conditions]]\nset = {{ \"drive.d.frequency\" = \"9.5 Hz\" }}\n"
    );
    let error = error_of(LINEAR, &text);
    assert!(
        error.contains("line 3") && error.contains("free.drive.d.frequency"),
        "{error}"
    );
}

/// The tip of the linear harvester moves by less than a millimetre.
#[test]
fn a_gap_that_no_orbit_closes_has_a_warning() {
    let stop = "[stop.s]\nat = \"m.tip\"\nlaw = \"hertz\"\ngap = \"60 mm\"\nstiffness = \"1000 N/m^1.5\"\n";
    let spec = format!("{LINEAR}{stop}");
    let free = "\"stop.s.gap\" = \"50mm:70mm\"\n";
    let found = outcome_of(&spec, &LOAD.replace("[goal]", &format!("{free}[goal]")));
    let [warning] = &found.warnings[..] else {
        panic!("{found:?}")
    };
    assert!(warning.contains("stop.s.gap"), "{warning}");
    let load_alone = outcome_of(&spec, LOAD);
    assert!(load_alone.warnings.is_empty(), "{:?}", load_alone.warnings);
}

/// Where every design fails, a reason is given.
#[test]
fn a_range_without_a_valid_design_gives_the_reason() {
    let text = "evaluations = 20\n[free]\n\"patch.p.start\" = \"85mm:95mm\"\n[goal]\nmaximise = \"expected-power\"\nstarts = 2\n";
    let problem = problem_of(CANTILEVER, text).unwrap();
    let error = jounce_design::design(&problem, &jounce_control::Control::default(), None, None)
        .unwrap_err()
        .to_string();
    assert!(error.contains("patch.p"), "{error}");
}

/// A design of a spec may name that spec, relative to its own folder, but no other one.
#[test]
fn a_design_of_a_spec_may_name_this_spec() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    let spec = write("harvester.toml", LINEAR);
    write("other.toml", &LINEAR.replace("80 kohm", "90 kohm"));
    let named = |name: &str| format!("spec = \"{name}\"\n{LOAD}");
    let design = write("design.toml", &named("harvester.toml"));
    let with_spec = |name: &str| {
        let file = SpecFile::read(&spec).unwrap();
        Problem::with_spec(file, Path::new("elsewhere"), &named(name), folder.path())
    };
    let problem = with_spec("harvester.toml").unwrap();
    assert_eq!(problem.spec, Problem::read(&design).unwrap().spec);
    let error = with_spec("other.toml").unwrap_err().to_string();
    assert!(error.contains("omit the key"), "{error}");
    let missing = with_spec("missing.toml").unwrap_err().to_string();
    assert!(missing.contains("missing.toml"), "{missing}");
}

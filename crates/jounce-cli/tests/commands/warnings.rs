//! Warnings: limits of patches, recordings that end, energies that do not add up.

use crate::jounce;
use serde_json::Value;

/// An oscillator of one mode: a steel strip with a Macro Fiber Composite near its resonance, at 20 g far beyond 600 ppm.
pub const STRIP: &str = "[beam.s]\nmaterial = \"steel\"\nlength = \"120 mm\"\nwidth = \"28 mm\"\nthickness = \"0.5 mm\"\n\
    [patch.m]\non = \"s\"\nmaterial = \"MFC-P2\"\nstart = \"0 mm\"\nlength = \"85 mm\"\nwidth = \"28 mm\"\nthickness = \"0.3 mm\"\n\
    [circuit.m]\npatch = \"m\"\nresistance = \"100 kohm\"\n[damping]\nbeyond = 0.02\n[reduction]\nmodes = 1\n\
    [run]\nstart = \"linear\"\nduration = \"1 s\"\naverage_over = \"0.5 s\"\n";
pub const SINE: &str =
    "[drive.b]\nkind = \"base-acceleration\"\namplitude = \"20 g\"\nfrequency = \"33 Hz\"\n";
const NOISE: &str = "[drive.b]\nkind = \"base-acceleration\"\nsignal = \"noise\"\npsd = \"20 g^2/Hz\"\nhigh = \"60 Hz\"\n";

pub fn write_spec(folder: &tempfile::TempDir, text: &str) -> String {
    let path = folder.path().join("spec.toml");
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

fn exceeds_strain(result: &Value) -> bool {
    result["warnings"]
        .as_array()
        .unwrap()
        .iter()
        .any(|warning| warning["quantity"] == "strain" && warning["patch"] == "m")
}

#[test]
fn every_integrating_command_warns_about_limits() {
    let folder = tempfile::tempdir().unwrap();
    let spec = write_spec(&folder, &format!("{STRIP}{SINE}"));
    let (code, run, text) = jounce(&["run", &spec, "--json"]);
    assert!(
        code == 0 && exceeds_strain(&run) && run["warnings"][0]["warning"] == "limit",
        "{text} {run}"
    );
    let (code, sweep, text) = jounce(&[
        "sweep",
        &spec,
        "--over",
        "drive.b.amplitude=0.01g,20g",
        "--json",
    ]);
    assert_eq!(code, 0, "{text}");
    let points = sweep["points"].as_array().unwrap();
    assert!(
        !exceeds_strain(&points[0]) && exceeds_strain(&points[1]),
        "{sweep}"
    );
    let message = "its limit is 600 ppm; 1 of 2 points exceed the limit, worst at drive.b.amplitude = 196.133000 m/s^2";
    assert!(
        text.contains("warning: patch m: its strain reaches") && text.contains(message),
        "{text}"
    );
    let (code, branch, text) = jounce(&[
        "branch",
        &spec,
        "--over",
        "drive.b.amplitude=0.01g:20g",
        "--seeds",
        "0",
        "--json",
    ]);
    assert_eq!(code, 0, "{text}");
    let points = branch["branches"][0]["points"].as_array().unwrap();
    assert!(
        !exceeds_strain(&points[0]) && exceeds_strain(points.last().unwrap()),
        "{branch}"
    );
    // The same orbit by march and by shooting.
    let reached = |result: &Value| result["warnings"][0]["reached"].as_f64().unwrap().abs();
    assert!((reached(points.last().unwrap()) / reached(&run) - 1.0).abs() < 1e-3);
    assert!(
        text.contains("points exceed the limit, worst at drive.b.amplitude = 196.133000 m/s^2"),
        "{text}"
    );
    let (code, basins, text) = jounce(&["basins", &spec, "--starts", "2", "--json"]);
    assert!(
        code == 0 && exceeds_strain(&basins["attractors"][0]),
        "{text} {basins}"
    );
    assert!(
        text.contains("1 of 1 attractors exceed the limit, worst at attractor 1a"),
        "{text}"
    );
}

#[test]
fn limits_warn_under_noise() {
    let folder = tempfile::tempdir().unwrap();
    let spec = write_spec(
        &folder,
        &format!("{STRIP}{NOISE}").replace("start = \"linear\"\n", ""),
    );
    let (code, ensemble, text) = jounce(&["ensemble", &spec, "--members", "2", "--json"]);
    assert_eq!(code, 0, "{text}");
    let members = ensemble["members"].as_array().unwrap();
    let member_exceeds_strain = |member: &Value| {
        member["warnings"]
            .as_array()
            .unwrap()
            .iter()
            .any(|warning| warning["quantity"] == "strain")
    };
    assert!(
        members.iter().all(member_exceeds_strain)
            && text.contains("2 of 2 members exceed the limit, worst at member"),
        "{text} {ensemble}"
    );
    let (code, run, text) = jounce(&["run", &spec, "--json"]);
    assert!(code == 0 && exceeds_strain(&run), "{text} {run}");
}

#[test]
fn a_recording_shorter_than_the_run_gives_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("road.csv"),
        "time (s),a (g)\n0,0\n0.5,1\n1,-2\n",
    )
    .unwrap();
    let text_of_spec = "[mass.m]\nmass = \"1 kg\"\nfrequency = \"3 Hz\"\ndamping_ratio = 0.1\n[drive.road]\nkind = \"base-acceleration\"\nsignal = \"recording\"\n\
        file = \"road.csv\"\nmean = \"kept\"\n[run]\nduration = \"3 s\"\naverage_over = \"1 s\"\n";
    let spec = write_spec(&folder, text_of_spec);
    let (code, run, text) = jounce(&["run", &spec, "--json"]);
    let warning = &run["warnings"][0];
    assert!(
        code == 0
            && warning["warning"] == "recording-ends"
            && warning["ends_s"] == 1.0
            && warning["from_s"] == 2.0,
        "{run}"
    );
    assert!(
        text.contains(
            "drive road: its recording ends at 1 s, but the averaging window goes from 2 s to 3 s"
        ),
        "{text}"
    );
    let (_, run, text) = jounce(&["run", &spec, "--json", "--set", "run.duration=1 s"]);
    assert!(
        run["warnings"].as_array().unwrap().is_empty() && !text.contains("warning"),
        "{run} {text}"
    );
    assert!(!text.contains("its recording lasts"), "{text}");
    let short = ["run.duration=0.5 s", "run.average_over=0.5 s"];
    let set = ["--set", short[0], "--set", short[1]];
    let (code, _, text) = jounce(&[&["run", &spec], &set[..]].concat());
    let note = "note: drive road: its recording lasts until 1.000000 s, but a run ends at run.duration = 500 ms";
    assert!(code == 0 && text.contains(note), "{text}");
    let stop = "[stop.s]\nat = \"m\"\nlaw = \"spring\"\ngap = \"1 mm\"\nstiffness = \"1 kN/m\"\n";
    let spec = write_spec(&folder, &format!("{text_of_spec}{stop}"));
    let (code, _, text) = jounce(&["branch", &spec, "--over", "mass.m.mass=1kg:2kg"]);
    let advice = "over a key, `jounce sweep`; where a drive is noise, `jounce ensemble`";
    assert!(code == 4 && text.contains(advice), "{code} {text}");
    let sweep = ["sweep", &spec, "--over", "mass.m.mass=1kg:2kg:1kg"];
    let (code, _, text) = jounce(&sweep);
    assert_eq!(code, 0, "{text}");
    let noise = "drive.road={kind = \"base-acceleration\", signal = \"noise\", psd = \"1 m^2/s^3\", high = \"60 Hz\"}";
    let (code, _, text) = jounce(&[&sweep[..], &["--set", noise]].concat());
    assert!(
        code == 4 && text.contains("drive `road` is noise") && !text.contains("jounce sweep"),
        "{code} {text}"
    );
}

/// An oscillator that is pressed past the last point of its table, and within one.
#[test]
fn a_contact_past_the_end_of_its_table_gives_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    let text = "[mass.m]\nmass = \"1 kg\"\nfrequency = \"3 Hz\"\ndamping_ratio = 0.1\n[stop.s]\nat = \"m\"\nlaw = \"table\"\n\
        gap = \"1 mm\"\npenetration_m = [1e-5, 2e-5]\nforce_n = [0.1, 0.3]\n[drive.push]\nat = \"m\"\nkind = \"force\"\n\
        amplitude = \"10 N\"\nfrequency = \"3 Hz\"\n[run]\nstart = \"rest\"\nduration = \"3 s\"\naverage_over = \"1 s\"\n";
    let (code, run, text_out) = jounce(&["run", &write_spec(&folder, text), "--json"]);
    let warning = &run["warnings"][0];
    assert!(
        code == 0
            && warning["warning"] == "past-table"
            && warning["last_m"] == 2e-5
            && warning["penetration_m"].as_f64().unwrap() > 2e-5,
        "{run}"
    );
    assert!(
        text_out.contains("warning: stop s: the penetration reaches"),
        "{text_out}"
    );
    let long = text
        .replace("[1e-5, 2e-5]", "[1e-5, 0.1]")
        .replace("[0.1, 0.3]", "[0.1, 1e4]");
    let (_, run, text_out) = jounce(&["run", &write_spec(&folder, &long), "--json"]);
    assert!(
        run["stops"][0]["max_penetration_m"].as_f64().unwrap() > 0.0
            && run["warnings"].as_array().unwrap().is_empty(),
        "{run} {text_out}"
    );
}

/// With 8 modes a stiff stop breaks each contact of a plate into several short ones, which 20 and 40
/// modes do not: only the 8 modes give a warning, and only they have another contact duration.
#[test]
fn contacts_too_short_for_the_retained_modes_give_a_warning() {
    let spec = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../examples/plate-de-marqui-2009/stop.toml"
    );
    let [few, more, most] = ["8", "20", "40"].map(|modes| {
        let modes = format!("reduction.modes={modes}");
        let stiff = "stop.corner.stiffness=1e7 N/m^1.5";
        let (code, run, text) = jounce(&["run", spec, "--json", "--set", &modes, "--set", stiff]);
        // Numbers have a prefix in place of a power of ten.
        assert!(
            code == 0 && !text.contains("e-4 s") && !text.contains("e3 Hz"),
            "{text}"
        );
        let duration_s = run["stops"][0]["mean_contact_duration_s"].as_f64().unwrap();
        (run["warnings"].clone(), duration_s)
    });
    assert_eq!(few.0[0]["warning"], "short-contact", "{few:?}");
    let over = ["--over", "reduction.modes=8,20", "--fixed-duration"];
    let stiff = ["--set", "stop.corner.stiffness=1e7 N/m^1.5"];
    let (_, sweep, text) = jounce(&[&["sweep", spec, "--json"][..], &over, &stiff].concat());
    assert_eq!(sweep["points"][0]["warnings"], few.0, "{sweep}");
    assert_eq!(sweep["points"][1]["warnings"], Value::Array(Vec::new()));
    let message = "1 of 2 points have this warning, first reduction.modes = 8";
    assert!(text.contains(message), "{text}");
    assert!(few.1 < most.1 / 5.0, "{few:?} {most:?}");
    assert_eq!(more.0, Value::Array(Vec::new()));
    assert!((more.1 / most.1 - 1.0).abs() < 0.02, "{more:?} {most:?}");
}

/// The strip moves by millimetres, so that no gap of half a metre closes. A goal of orbits under noise
/// is wrong input.
#[test]
fn a_design_warns_of_a_key_that_does_not_matter() {
    let folder = tempfile::tempdir().unwrap();
    let stop =
        "[stop.t]\nat = \"s.end\"\nlaw = \"spring\"\ngap = \"500 mm\"\nstiffness = \"1e4 N/m\"\n";
    let sine = SINE.replace("20 g", "1 g");
    write_spec(&folder, &format!("{STRIP}{stop}{sine}"));
    let design = folder.path().join("design.toml");
    let text = "spec = \"spec.toml\"\nevaluations = 60\n[free]\n\"circuit.m.resistance\" = \"10kohm:1Mohm:log\"\n\
        \"stop.t.gap\" = \"400mm:600mm\"\n[goal]\nmaximise = \"stable-power\"\nstarts = 2\n";
    std::fs::write(&design, text).unwrap();
    let design = design.to_str().unwrap();
    let (code, found, stderr) = jounce(&["design", design, "--json"]);
    let warnings = found["warnings"].as_array().unwrap();
    assert!(code == 0 && warnings.len() == 1, "{stderr} {found}");
    assert!(stderr.contains("warning: stop.t.gap: "), "{stderr}");
    write_spec(&folder, &format!("{STRIP}{stop}{NOISE}"));
    let (code, _, stderr) = jounce(&["design", design]);
    assert!(
        code == 4
            && stderr.contains("goal.maximise is \"stable-power\", but drive `b` is not periodic"),
        "{code} {stderr}"
    );
}

/// Bending gives the two faces opposite voltages: without the minus the layers cancel, and two patches
/// of one face with it.
#[test]
fn patches_that_cancel_give_a_warning_with_the_polarity_that_does_not() {
    let spec = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../examples/bimorph-erturk-2009/harvester.toml"
    );
    for wiring in ["series", "parallel"] {
        let wiring = format!("circuit.load.wiring={wiring}");
        let run = |patches: &str| {
            let patches = format!("circuit.load.patches={patches}");
            let keys = [
                "--set",
                &wiring,
                "--set",
                &patches,
                "--set",
                "run.start=linear",
            ];
            let (code, run, text) = jounce(&[&["run", spec, "--json"][..], &keys].concat());
            assert_eq!(code, 0, "{text}");
            (run, text)
        };
        let (right, _) = run("[\"top\", \"-bottom\"]");
        assert_eq!(right["warnings"], Value::Array(Vec::new()));
        let (cancelled, text) = run("[\"top\", \"bottom\"]");
        let power = |run: &Value| run["mean_power_w"].as_f64().unwrap();
        assert!(power(&cancelled) < 1e-9 * power(&right));
        assert_eq!(cancelled["warnings"][0]["warning"], "cancelling");
        assert!(
            text.contains("patches = [\"top\", \"-bottom\"] instead of"),
            "{text}"
        );
    }
}

/// The ball touches its disc for 64 us or longer: 4096 samples per second miss most contacts. With the
/// rate of the warning every contact has samples; the first pulse is steeper than the mean one.
#[test]
fn samples_too_coarse_for_contacts_give_a_warning_with_the_rate_that_is_not() {
    let spec = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../examples/ball-umeda-1996/harvester.toml"
    );
    let run = |rate: &str| {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().to_str().unwrap();
        let (code, run, text) =
            jounce(&["run", spec, "--json", "--out", out, "--sample-rate", rate]);
        assert_eq!(code, 0, "{text}");
        let table = std::fs::read_to_string(folder.path().join("run.csv")).unwrap();
        let forces = table.lines().filter_map(|line| line.rsplit(',').next());
        let force_n = forces
            .filter_map(|value| value.parse::<f64>().ok())
            .fold(0.0, f64::max);
        let share = force_n / run["max_contact_force_n"].as_f64().unwrap();
        (run["warnings"].clone(), share)
    };
    let (coarse, share) = run("4096 Hz");
    assert!(share < 0.6, "{share}");
    assert_eq!(coarse[0]["warning"], "undersampled", "{coarse}");
    let needed_hz = coarse[0]["needed_hz"].as_f64().unwrap();
    let (fine, share) = run(&format!("{needed_hz:.0} Hz"));
    assert!((0.85..=1.0).contains(&share), "{share}");
    assert_eq!(fine, Value::Array(Vec::new()));
}

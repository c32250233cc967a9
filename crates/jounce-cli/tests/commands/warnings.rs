//! Warnings: limits of patches, recordings that end, energies that do not add up.

use crate::jounce;
use serde_json::Value;

/// An oscillator of one mode: a steel strip with a Macro Fiber Composite near its resonance, at 20 g far beyond 600 ppm.
const STRIP: &str = "[beam.s]\nmaterial = \"steel\"\nlength = \"120 mm\"\nwidth = \"28 mm\"\nthickness = \"0.5 mm\"\n\
    [patch.m]\non = \"s\"\nmaterial = \"MFC-P2\"\nstart = \"0 mm\"\nlength = \"85 mm\"\nwidth = \"28 mm\"\nthickness = \"0.3 mm\"\n\
    [circuit.m]\npatch = \"m\"\nresistance = \"100 kohm\"\n[damping]\nbeyond = 0.02\n[reduction]\nmodes = 1\n\
    [run]\nstart = \"linear\"\nduration = \"1 s\"\naverage_over = \"0.5 s\"\n";
const SINE: &str =
    "[drive.b]\nkind = \"base-acceleration\"\namplitude = \"20 g\"\nfrequency = \"33 Hz\"\n";
const NOISE: &str = "[drive.b]\nkind = \"base-acceleration\"\nsignal = \"noise\"\npsd = \"20 g^2/Hz\"\nhigh = \"60 Hz\"\n";

fn write_spec(folder: &tempfile::TempDir, text: &str) -> String {
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
    let message = "600 ppm are recommended; 1 of 2 points pass the limit, worst at drive.b.amplitude = 196.133000 m/s^2";
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
        text.contains("points pass the limit, worst at drive.b.amplitude = 196.133000 m/s^2"),
        "{text}"
    );
    let (code, basins, text) = jounce(&["basins", &spec, "--starts", "2", "--json"]);
    assert!(
        code == 0 && exceeds_strain(&basins["attractors"][0]),
        "{text} {basins}"
    );
    assert!(
        text.contains("1 of 1 attractors pass the limit, worst at attractor 1a"),
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
            && text.contains("2 of 2 members pass the limit, worst at member"),
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
    let text = "[mass.m]\nmass = \"1 kg\"\nfrequency = \"3 Hz\"\ndamping_ratio = 0.1\n[drive.road]\nkind = \"base-acceleration\"\nsignal = \"recording\"\n\
        file = \"road.csv\"\nmean = \"kept\"\n[run]\nduration = \"3 s\"\naverage_over = \"1 s\"\n";
    let spec = write_spec(&folder, text);
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
}

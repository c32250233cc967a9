//! Results as text for people: what they state beyond their numbers.

use crate::{PLANT, SPEC, jounce, outcome, program};

/// Returns stdout and stderr of a command that succeeds.
fn printed(arguments: &[&str]) -> (String, String) {
    let cache = tempfile::tempdir().unwrap();
    let mut command = program();
    command.env("JOUNCE_CACHE", cache.path());
    let (code, stdout, stderr) = outcome(command.args(arguments));
    assert_eq!(code, 0, "{stderr}");
    (stdout, stderr)
}

/// A force on one of two masses that stand apart moves only that one.
#[test]
fn a_response_of_zero_is_said_in_text_and_picture() {
    let folder = tempfile::tempdir().unwrap();
    let mass = |name: &str| {
        format!("[mass.{name}]\nmass = \"1 kg\"\nfrequency = \"10 Hz\"\ndamping_ratio = 0.1\n")
    };
    let run = "[run]\nduration = \"1 s\"\naverage_over = \"1 s\"\n";
    let spec = folder.path().join("two.toml");
    std::fs::write(&spec, format!("{}{}{run}", mass("a"), mass("b"))).unwrap();
    let out = folder.path().join("out");
    let [spec, out] = [&spec, &out].map(|path| path.to_str().unwrap());
    let (text, _) = printed(&["frf", spec, "--input", "a", "--out", out]);
    assert!(text.contains("a.acceleration: highest "), "{text}");
    assert!(
        text.contains("b.acceleration: 0 at every frequency"),
        "{text}"
    );
    let picture = std::fs::read_to_string(format!("{out}/frf-b.acceleration.svg")).unwrap();
    assert!(picture.contains("b.acceleration: 0 at every frequency"));
}

/// A stepped sweep carries the motion over any key. Small values of a key keep their digits.
#[test]
fn a_sweep_names_its_key_and_where_its_points_start() {
    let over = "stop.tip.gap=10um:20um:10um";
    let short = [
        "--set",
        "run.duration=1 s",
        "--set",
        "run.average_over=0.5 s",
    ];
    let sweep = [
        &["sweep", SPEC, "--fixed-duration", "--over", over],
        &short[..],
    ]
    .concat();
    let (text, _) = printed(&sweep);
    assert!(text.starts_with("stop.tip.gap [m]  direction"), "{text}");
    assert!(text.contains("     1.000000e-5  up "), "{text}");
    let carried = "each point starts from the motion at the point before";
    assert!(
        text.contains(carried) && text.contains("--direction independent"),
        "{text}"
    );
    let (text, _) = printed(&[&sweep[..], &["--direction", "independent"]].concat());
    assert!(!text.contains(carried), "{text}");
}

/// Stable parts end at the folds and the Neimark-Sacker points of the plant; its grazings change no stability.
#[test]
fn a_branch_prints_its_stable_ranges_and_where_they_end() {
    let over = ["--over", "drive.shaker.frequency=11Hz:13Hz", "--seeds", "0"];
    let (text, _) = printed(&[&["branch", PLANT], &over[..]].concat());
    assert!(text.contains("  stable from "), "{text}");
    let events = text
        .lines()
        .filter(|line| line.contains(" +- ") && !line.contains("half-power range"));
    for line in events {
        let is_end = line.ends_with("end of a stable range");
        assert_eq!(is_end, !line.trim_start().starts_with("grazing"), "{text}");
    }
    assert!(
        text.contains("range of drive.shaker.frequency in which"),
        "{text}"
    );
    assert!(
        text.contains("branches on which no run at an end of the range settles"),
        "{text}"
    );
}

#[test]
fn attractors_are_printed_with_the_starts_that_found_them() {
    let (text, _) = printed(&["basins", PLANT, "--starts", "4", "--spread", "3"]);
    assert!(
        text.contains("4 random starts (seed 1)") && text.contains("3 gaps"),
        "{text}"
    );
    let grid = ["--grid", "displacement=-1mm:1mm:2x"];
    let (text, _) = printed(&[&["basins", PLANT], &grid[..]].concat());
    assert!(
        text.contains("starts on a grid: displacement=-1mm:1mm:2x"),
        "{text}"
    );
    let over = "drive.shaker.frequency=11Hz:14Hz:1.5Hz";
    let starts = ["--direction", "starts", "--starts", "4", "--no-branches"];
    let (text, _) = printed(&[&["diagram", PLANT, "--over", over], &starts[..]].concat());
    assert!(
        text.contains("the first value of the key at which") && !text.contains("born"),
        "{text}"
    );
}

/// An impact on a rigid stop has no duration, so none is printed and no warning compares it.
#[test]
fn contacts_on_a_rigid_stop_have_no_duration() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let rigid = [
        "stop.tip.law=rigid",
        "stop.tip.restitution=0.5",
        "stop.tip.stiffness=",
    ];
    let sets = rigid.iter().flat_map(|set| ["--set", set]);
    let run: Vec<&str> = ["run", SPEC, "--out", out]
        .into_iter()
        .chain(sets)
        .collect();
    let (text, warnings) = printed(&run);
    assert!(
        text.contains("impact velocity") && !text.contains("contact duration"),
        "{text}"
    );
    assert!(!warnings.contains("a contact lasts"), "{warnings}");
}

/// `rest` and `linear` name the same starts as in the spec.
#[test]
fn a_run_starts_from_rest_or_the_linear_state_by_name() {
    let short = [
        "--set",
        "run.duration=1 s",
        "--set",
        "run.average_over=0.5 s",
    ];
    for name in ["rest", "linear"] {
        let of_spec = format!("run.start={name}");
        let run = |start: [&str; 2]| {
            let (code, json, text) =
                jounce(&[&["run", SPEC, "--json"], &short[..], &start].concat());
            assert_eq!(code, 0, "{text}");
            json["mean_power_w"].as_f64().unwrap()
        };
        assert_eq!(run(["--start", name]), run(["--set", &of_spec]), "{name}");
    }
}

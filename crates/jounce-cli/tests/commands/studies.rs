//! Studies and ensembles.

use crate::{PLANT, SPEC, assert_keys, jounce, program};
#[cfg(unix)]
use std::time::Duration;

const SHAKER: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../examples/random-base/shaker.toml"
);

/// Killed at five moments and taken up again, a study has the bytes of one that ran through.
#[cfg(unix)]
#[test]
fn a_killed_study_resumes() {
    let folder = tempfile::tempdir().unwrap();
    let text = format!(
        "spec = {SPEC:?}\npoints_per_part = 3\n[set]\n\"run.duration\" = \"1 s\"\n\"run.average_over\" = \"0.5 s\"\n\
         [vary]\n\"stop.tip.gap\" = \"0.5mm:1.5mm:30x\"\n\"drive.shaker.frequency\" = \"10Hz:14Hz:10x\"\n"
    );
    let file = folder.path().join("study.toml");
    std::fs::write(&file, text).unwrap();
    let output_path = |name: &str| folder.path().join(name);
    let arguments = |name: &str| {
        [
            "study".into(),
            "run".into(),
            file.clone(),
            "--out".into(),
            output_path(name),
        ]
    };
    program().args(arguments("whole")).assert().success();
    let parts = || {
        std::fs::read_dir(output_path("killed").join("parts")).map_or(0, |entries| entries.count())
    };
    for _ in 0..5 {
        let count_before = parts();
        let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_jounce"))
            .args(arguments("killed"))
            .spawn()
            .unwrap();
        // At work: there is more than before, if only the begin of a file.
        while parts() == count_before && child.try_wait().unwrap().is_none() {
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
        child.kill().unwrap();
        child.wait().unwrap();
    }
    let (code, json, errors) = jounce(&[
        "study",
        "run",
        file.to_str().unwrap(),
        "--out",
        output_path("killed").to_str().unwrap(),
        "--json",
    ]);
    assert_eq!(
        (code, &json["finished"], &json["merged"]),
        (0, &serde_json::json!(100), &serde_json::json!(true)),
        "{errors}"
    );
    let read = |name: &str| std::fs::read(output_path(name).join("study.parquet")).unwrap();
    assert!(read("whole") == read("killed"));
    let (code, json, _) = jounce(&["study", "status", folder.path().to_str().unwrap(), "--json"]);
    assert!(
        code == 4 && json["error"].as_str().unwrap().contains("holds no study"),
        "{json}"
    );
}

/// As lines of text, `study run` ends with the first points and the file of all.
#[test]
fn a_study_shows_its_first_results() {
    let folder = tempfile::tempdir().unwrap();
    let text = format!(
        "spec = {SPEC:?}\n[set]\n\"run.duration\" = \"0.2 s\"\n\"run.average_over\" = \"0.1 s\"\n\
         [vary]\n\"stop.tip.gap\" = \"0.5mm:1.5mm:12x\"\n"
    );
    std::fs::write(folder.path().join("study.toml"), text).unwrap();
    let arguments = ["study", "run", "study.toml", "--out", "out"];
    let (code, stdout, stderr) = crate::jounce_in(folder.path(), &arguments);
    assert_eq!(code, 0, "{stderr}");
    let lines: Vec<&str> = stdout.lines().collect();
    let header = lines.iter().position(|line| line.contains("mean_power_w"));
    let rows = &lines[header.unwrap() + 1..];
    assert_eq!(rows.len(), 12, "{stdout}");
    assert!(rows[0].contains("0.0005000000"), "{stdout}");
    assert!(rows[10].starts_with("... 2 more rows"), "{stdout}");
    let table = std::path::Path::new("out").join("study.parquet");
    assert_eq!(rows[11], format!("all results in {}", table.display()));
    assert!(lines.iter().all(|line| line.len() <= 100), "{stdout}");
}

#[test]
fn noise_prints_every_key() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let (code, json, stderr) = jounce(&["noise", SHAKER, "--json", "--out", out]);
    assert_eq!(code, 0, "{stderr}");
    assert_keys(
        &json,
        &[
            "mean_power_w",
            "loads",
            "patches",
            "points",
            "stops",
            "left_out",
        ],
    );
    assert_keys(
        &json["loads"][0],
        &[
            "spectral_power_w",
            "difference_relative",
            "noise_bandwidth_hz",
            "statistical_bandwidth_hz",
        ],
    );
    assert_keys(
        &json["stops"][0],
        &["reached_hz", "share_beyond", "displacement_rms_m"],
    );
    assert!(
        [
            "noise.csv",
            "noise.parquet",
            "noise.svg",
            "noise.png",
            "noise.pdf"
        ]
        .iter()
        .all(|name| folder.path().join(name).exists())
    );
}

#[test]
fn ensembles_print_every_key() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let short_run = [
        "--set",
        "run.duration=0.6 s",
        "--set",
        "run.average_over=0.5 s",
    ];
    let members = [
        "ensemble",
        SHAKER,
        "--members",
        "2",
        "--spectrum",
        "--json",
        "--out",
        out,
    ];
    let (code, json, stderr) = jounce(&[&members[..], &short_run].concat());
    assert_eq!(code, 0, "{stderr}");
    assert_keys(
        &json["stops"][0],
        &[
            "contact_rate_hz",
            "mean_impact_velocity_m_s",
            "max_contact_duration_s",
            "contact_duty",
        ],
    );
    assert_keys(
        &json["patches"][0],
        &["name", "bandwidth_hz", "bandwidth_half_width_hz"],
    );
    assert!(
        ["ensemble-spectrum.csv", "ensemble-spectrum.svg"]
            .iter()
            .all(|name| folder.path().join(name).exists())
    );
}

#[test]
fn noise_without_its_conditions_is_refused() {
    for (arguments, message) in [
        (vec!["noise", SPEC], "no drive has signal"),
        (
            vec!["ensemble", SHAKER, "--members", "1", "--spectrum"],
            "--members is 1; a spectrum needs at least 2",
        ),
        (vec!["noise", SHAKER, "--low", "40Hz"], "--low is 40 Hz"),
    ] {
        let (code, _, stderr) = jounce(&arguments);
        assert!(
            code != 0 && stderr.contains(message),
            "{arguments:?}: {stderr}"
        );
    }
}

/// The finished part is printed as one object, with the exit code of an interrupted command.
#[cfg(unix)]
#[test]
fn an_interrupted_command_prints_finished_results_and_ends_with_130() {
    let short_run = [
        "--set",
        "run.duration=0.6 s",
        "--set",
        "run.average_over=0.5 s",
    ];
    let ensemble = [
        &["ensemble", SHAKER, "--members", "1000000", "--json"][..],
        &short_run,
    ]
    .concat();
    let basins = vec!["basins", PLANT, "--starts", "1000000", "--json"];
    for (arguments, list, message) in [
        (ensemble, "members", "finished members"),
        (basins, "attractors", "of 1000000 starts"),
    ] {
        // On a busy machine the first result takes longer.
        let interrupted = [3, 12, 48].map(Duration::from_secs).into_iter();
        let (json, errors) = interrupted
            .map(|time| interrupted_after(time, &arguments))
            .find(|(json, _)| {
                json[list]
                    .as_array()
                    .is_some_and(|results| !results.is_empty())
            })
            .expect("a result in 48 s");
        assert!(errors.contains(message), "{json} {errors}");
    }
}

/// A command that is interrupted before its first result says so, with the same exit code.
#[cfg(unix)]
#[test]
fn an_interrupted_command_without_a_result_ends_with_130() {
    let long = ["--set", "run.duration=100000 s"];
    for arguments in [
        vec!["sensitivity", PLANT, "--starts", "1000000"],
        [&["run", PLANT][..], &long].concat(),
    ] {
        let (_, errors) = interrupted_after(Duration::from_secs(3), &arguments);
        assert!(errors.contains("stopped"), "{errors}");
    }
}

/// JSON and stderr of a command that is interrupted after a time.
#[cfg(unix)]
fn interrupted_after(time: Duration, arguments: &[&str]) -> (serde_json::Value, String) {
    let child = std::process::Command::new(env!("CARGO_BIN_EXE_jounce"))
        .args(arguments)
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(time);
    std::process::Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    let output = child.wait_with_output().unwrap();
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(130), "{errors}");
    // Without a finished result there may be no JSON.
    let json = serde_json::from_slice(&output.stdout).unwrap_or_default();
    (json, errors)
}

/// A harvester whose base has a name has the linear responses of one on the ground: its base is the ground once no drive moves it.
#[test]
fn a_named_base_gives_the_result_of_the_ground() {
    let folder = tempfile::tempdir().unwrap();
    let spec = |base: &str| {
        let patch = "[patch.p]\non = \"arm\"\nmaterial = \"PZT-5A\"\nstart = \"0 mm\"\nlength = \"30 mm\"\nwidth = \"20 mm\"\nthickness = \"0.2 mm\"\n";
        let text = format!(
            "[beam.arm]\nmaterial = \"steel\"\nlength = \"100 mm\"\nwidth = \"20 mm\"\nthickness = \"1 mm\"\nroot = \"{base}\"\n\
             [damping]\nratios = [0.01]\nbeyond = 0.01\n{patch}[circuit.load]\npatch = \"p\"\nresistance = \"100 kohm\"\n\
             [mass.tip]\non = \"arm.end\"\nmass = \"2 g\"\n\
             [stop.s]\nat = \"arm.end\"\nframe = \"{base}\"\nlaw = \"hertz\"\ngap = \"1 mm\"\nstiffness = \"1000 N/m^1.5\"\n\
             [drive.shaker]\nkind = \"base-acceleration\"\nat = \"{base}\"\nsignal = \"noise\"\npsd = \"0.02 g^2/Hz\"\nhigh = \"90 Hz\"\n"
        );
        let file = folder.path().join(format!("{base}.toml"));
        std::fs::write(&file, text).unwrap();
        file.to_str().unwrap().to_owned()
    };
    let (head, ground) = (spec("head"), spec("ground"));
    let struck_file = folder.path().join("struck.parquet");
    for command in [
        &["frf", "--base", "--low", "10Hz", "--high", "200Hz"][..],
        &[
            "frf", "--input", "arm.end", "--low", "10Hz", "--high", "200Hz",
        ],
        &["modes"],
        &["noise"],
        &[
            "rig",
            "--hammer",
            "arm.end",
            "--hits",
            "1",
            "--rate",
            "4096 Hz",
            "--block",
            "1 s",
            "--to",
            struck_file.to_str().unwrap(),
        ],
    ] {
        let output = |file: &str| {
            let arguments: Vec<&str> = [command[0], file]
                .into_iter()
                .chain(command[1..].iter().copied())
                .chain(["--json"])
                .collect();
            let (code, mut json, errors) = jounce(&arguments);
            assert_eq!(code, 0, "{command:?} {file}: {errors}");
            json.as_object_mut().unwrap().remove("manifest");
            json
        };
        assert_eq!(output(&head), output(&ground), "{command:?}");
    }
}

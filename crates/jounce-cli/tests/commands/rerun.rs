//! `jounce rerun`: tables of every command are made again, and every change is found.

use crate::{SPEC, outcome, program, with_json};
use serde_json::Value;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");

/// Runs the program in a folder; returns the exit code, the JSON on stdout and stderr.
fn call(folder: &Path, arguments: &[&str]) -> (i32, Value, String) {
    let mut command = program();
    command.args(arguments).current_dir(folder);
    with_json(outcome(command.env("JOUNCE_CACHE", folder.join("cache"))))
}

/// Runs a command line with `--out out`, which must succeed.
fn write(folder: &Path, line: &str) {
    let arguments: Vec<&str> = line.split(' ').chain(["--out", "out"]).collect();
    let (code, _, text) = call(folder, &arguments);
    assert_eq!(code, 0, "{line}: {text}");
}

fn rerun(folder: &Path, file: &str) -> (i32, Value, String) {
    call(folder, &["rerun", file, "--json"])
}

/// Returns the tables in a folder, in all formats.
fn tables(folder: &Path) -> Vec<PathBuf> {
    let files = std::fs::read_dir(folder).unwrap();
    let mut paths: Vec<PathBuf> = files.map(|file| file.unwrap().path()).collect();
    paths.sort();
    let name = |path: &PathBuf| path.file_name().unwrap().to_str().unwrap().to_owned();
    let endings = [".csv", ".parquet", ".json"];
    let is_table = |path: &PathBuf| {
        let name = name(path);
        endings.iter().any(|end| name.ends_with(end)) && !name.ends_with(".manifest.json")
    };
    paths.retain(is_table);
    paths
}

/// Writes the tables of a command and makes one of each name again, in turn in every format.
fn assert_equal_again(folder: &Path, line: &str) {
    let _ = std::fs::remove_dir_all(folder.join("out"));
    write(folder, line);
    let tables = tables(&folder.join("out"));
    assert!(!tables.is_empty(), "{line}");
    for (index, table) in tables.iter().enumerate() {
        if index % 3 == (index / 3) % 3 {
            let (code, json, text) = rerun(folder, table.to_str().unwrap());
            assert_eq!(code, 0, "{line}: {}: {text}", table.display());
            assert_eq!(json["equal"], true, "{json}");
            assert!(json["columns"].as_u64().unwrap() > 0, "{json}");
        }
    }
}

/// Returns a folder with a copy of the paper's spec, `a.toml`, with short runs.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(SPEC).unwrap();
    let text = text.replace("duration = \"20 s\"", "duration = \"2 s\"");
    let text = text.replace("average_over = \"10 s\"", "average_over = \"1 s\"");
    std::fs::write(folder.path().join("a.toml"), text).unwrap();
    folder
}

#[test]
fn simulations_are_made_again() {
    let folder = folder();
    let lines = [
        "modes a.toml --set reduction.modes=5",
        "frf a.toml --low=5Hz --high 50Hz --points 20",
        "run a.toml --set stop.tip.gap=0.5mm --save-state end.json",
        "run a.toml --start end.json",
        "sweep a.toml --over stop.tip.gap=1mm,2mm --direction both --threads 2 --fixed-duration",
    ];
    for line in lines {
        assert_equal_again(folder.path(), line);
    }
    let noise = format!("noise {EXAMPLES}/random-base/harvester.toml --points 20");
    assert_equal_again(folder.path(), &noise);
    let ensemble = format!(
        "ensemble {EXAMPLES}/random-base/shaker.toml --members 2 --set run.duration=1s --set run.average_over=0.5s"
    );
    assert_equal_again(folder.path(), &ensemble);
}

#[test]
fn orbits_are_made_again() {
    let folder = folder();
    let lines = [
        "branch a.toml --over drive.shaker.frequency=12Hz:12.2Hz --seeds 0",
        "bifurcations a.toml --over drive.shaker.frequency=12Hz:13Hz --against stop.tip.gap=0.95mm:1.05mm --seeds 0",
        "basins a.toml --starts 3 --seed 7",
        "diagram a.toml --over drive.shaker.frequency=12Hz:12.2Hz:0.1Hz",
        "sensitivity a.toml --key stop.tip.gap --starts 4",
    ];
    for line in lines {
        assert_equal_again(folder.path(), line);
    }
}

#[test]
fn fits_and_recordings_are_made_again() {
    let folder = folder();
    let features = Path::new(EXAMPLES).join("impact-harvester-2019/measured.toml");
    std::fs::copy(features, folder.path().join("measured.toml")).unwrap();
    write(folder.path(), "run a.toml");
    std::fs::rename(
        folder.path().join("out/run.parquet"),
        folder.path().join("rec.parquet"),
    )
    .unwrap();
    let lines = [
        "fit a.toml --to measured.toml",
        "read rec.parquet",
        "power rec.parquet --resistance 1Mohm",
        "spectra rec.parquet",
    ];
    for line in lines {
        assert_equal_again(folder.path(), line);
    }
    recordings_that_change_are_named(folder.path());
}

fn recordings_that_change_are_named(folder: &Path) {
    let recording = folder.join("rec.parquet");
    let mut bytes = std::fs::read(&recording).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&recording, bytes).unwrap();
    let (code, _, text) = rerun(folder, "out/spectra.csv");
    assert_eq!(code, 4);
    assert!(text.contains("rec.parquet: the file has changed"), "{text}");
    std::fs::remove_file(&recording).unwrap();
    let (code, _, text) = rerun(folder, "out/spectra.csv");
    assert_eq!(code, 4);
    assert!(
        text.contains("rec.parquet: ") && text.contains("run in the folder"),
        "{text}"
    );
}

#[test]
fn designs_and_tests_of_a_rig_are_made_again() {
    let folder = folder();
    let design = "spec = \"a.toml\"\nevaluations = 6\n[free]\n\"stop.tip.gap\" = \"0.5mm:2mm\"\n[goal]\nmaximise = \"mean-power\"\n";
    std::fs::write(folder.path().join("design.toml"), design).unwrap();
    assert_equal_again(folder.path(), "design design.toml");
    for line in [
        "rig a.toml --hammer beam.hammer --hits 3 --to hit.parquet",
        "rig a.toml --set run.duration=4s --set run.average_over=3s --to run.parquet",
    ] {
        let arguments: Vec<&str> = line.split(' ').collect();
        let (code, _, text) = call(folder.path(), &arguments);
        assert_eq!(code, 0, "{line}: {text}");
    }
    for line in [
        "frf --measured hit.parquet",
        "modes --measured hit.parquet",
        "contact hit.parquet",
        "segments run.parquet --drive 13Hz",
    ] {
        assert_equal_again(folder.path(), line);
    }
}

#[test]
fn a_drive_of_a_recording_is_made_again_from_a_spec_that_is_gone() {
    let folder = tempfile::tempdir().unwrap();
    let specs = folder.path().join("specs");
    std::fs::create_dir(&specs).unwrap();
    let samples: String = (0..200)
        .map(|k| format!("{},{}\n", f64::from(k) / 100.0, f64::from(k % 7) - 3.0))
        .collect();
    std::fs::write(
        folder.path().join("floor.csv"),
        format!("time (s),floor (m/s^2)\n{samples}"),
    )
    .unwrap();
    let spec = "[mass.a]\nmass = \"1 kg\"\nfrequency = \"5 Hz\"\ndamping_ratio = 0.1\n\n[stop.s]\nat = \"a\"\nlaw = \"spring\"\ngap = \"1 mm\"\n\
                stiffness = \"1e5 N/m\"\n\n[drive.d]\nkind = \"base-acceleration\"\nsignal = \"recording\"\nfile = \"../floor.csv\"\n\n\
                [run]\nduration = \"2 s\"\naverage_over = \"1 s\"\n";
    std::fs::write(specs.join("b.toml"), spec).unwrap();
    let absolute = specs.join("b.toml").to_str().unwrap().to_owned();
    for name in ["specs/b.toml", absolute.as_str()] {
        write(folder.path(), &format!("run {name}"));
        std::fs::rename(specs.join("b.toml"), specs.join("c.toml")).unwrap();
        let (code, json, text) = rerun(folder.path(), "out/run.csv");
        assert_eq!(
            (code, &json["equal"]),
            (0, &Value::Bool(true)),
            "{name}: {text}"
        );
        std::fs::write(specs.join("b.toml"), "another = 1\n").unwrap();
        assert_eq!(rerun(folder.path(), "out/run.csv").0, 0, "{name}");
        std::fs::rename(specs.join("c.toml"), specs.join("b.toml")).unwrap();
    }
}

#[test]
fn a_change_by_hand_is_found_in_every_format() {
    let folder = folder();
    write(folder.path(), "modes a.toml");
    let out = folder.path().join("out");
    let (_, modes, _) = call(folder.path(), &["modes", "a.toml", "--json"]);
    let frequency_hz = modes["modes"][0]["frequency_hz"].as_f64().unwrap();
    for name in ["modes.csv", "modes.json"] {
        let path = out.join(name);
        let text = std::fs::read_to_string(&path).unwrap();
        let digits = frequency_hz.to_string();
        let (before, last) = digits.split_at(digits.len() - 1);
        let other = if last == "1" { "2" } else { "1" };
        assert!(text.contains(&digits), "{text}");
        std::fs::write(
            &path,
            text.replacen(&digits, &format!("{before}{other}"), 1),
        )
        .unwrap();
        let (code, json, text) = rerun(folder.path(), &format!("out/{name}"));
        assert_eq!(code, 1, "{name}: {text}");
        assert_eq!(json["difference"]["what"], "value", "{json}");
        let expected = format!(
            "different: column frequency_hz, row 1: the file has {before}{other}, computed {digits}"
        );
        assert!(text.contains(&expected), "{text}");
    }
    let path = out.join("modes.parquet");
    let mut bytes = std::fs::read(&path).unwrap();
    let is_value = |window: &[u8]| window == frequency_hz.to_le_bytes();
    let places: Vec<usize> = (0..bytes.len() - 8)
        .filter(|&at| is_value(&bytes[at..at + 8]))
        .collect();
    assert!(!places.is_empty());
    places.iter().for_each(|&at| bytes[at] ^= 1);
    std::fs::write(&path, &bytes).unwrap();
    let (code, json, text) = rerun(folder.path(), "out/modes.parquet");
    assert_eq!(
        (code, json["difference"]["row"].as_u64()),
        (1, Some(1)),
        "{text}"
    );
    let length = bytes.len();
    bytes[length - 5] ^= 1;
    std::fs::write(&path, &bytes).unwrap();
    let (code, _, text) = rerun(folder.path(), "out/modes.parquet");
    assert!(code == 4 && text.contains("modes.parquet"), "{text}");
}

#[test]
fn files_without_a_record_and_of_other_versions_are_named() {
    let folder = folder();
    write(folder.path(), "modes a.toml");
    let notes = folder.path().join("out/modes.manifest.json");
    let mut manifest: Value = serde_json::from_slice(&std::fs::read(&notes).unwrap()).unwrap();
    manifest["manifest"]["version"] = "0.0.9".into();
    std::fs::write(&notes, manifest.to_string()).unwrap();
    let (code, json, _) = rerun(folder.path(), "out/modes.csv");
    assert_eq!((code, json["stored_version"].as_str()), (0, Some("0.0.9")));
    let mut edited = manifest.clone();
    edited["manifest"]["record"]["inputs"][0]["text"] = "[mass.a]\n".into();
    std::fs::write(&notes, edited.to_string()).unwrap();
    let (code, _, text) = rerun(folder.path(), "out/modes.csv");
    assert_eq!(code, 4);
    assert!(text.contains("changed by hand"), "{text}");
    let mut other = manifest.clone();
    other["manifest"]["record"]["arguments"] = vec!["explore", "a.toml"].into();
    std::fs::write(&notes, other.to_string()).unwrap();
    let (code, _, text) = rerun(folder.path(), "out/modes.csv");
    assert_eq!(code, 4);
    assert!(
        text.contains("its record names the command \"explore\""),
        "{text}"
    );
    manifest["manifest"]
        .as_object_mut()
        .unwrap()
        .remove("record");
    std::fs::write(&notes, manifest.to_string()).unwrap();
    let (code, _, text) = rerun(folder.path(), "out/modes.csv");
    assert_eq!(code, 4);
    assert!(
        text.contains("has no record of its command (command \"modes\", jounce 0.0.9)"),
        "{text}"
    );
    std::fs::remove_file(&notes).unwrap();
    for (file, expected) in [
        ("out/modes.csv", "its notes"),
        ("a.toml", "only tables have a record"),
        ("out/no.csv", "no.csv"),
    ] {
        let (code, _, text) = rerun(folder.path(), file);
        assert_eq!(code, 4, "{file}");
        assert!(text.contains(expected), "{file}: {text}");
    }
}

/// The record holds no folder of results and no number of threads.
#[test]
fn equal_results_have_equal_files() {
    let folder = folder();
    let line = [
        "sweep",
        "a.toml",
        "--over",
        "stop.tip.gap=1mm,2mm",
        "--fixed-duration",
    ];
    for (out, threads) in [("one", "1"), ("two", "2")] {
        let (code, _, text) = call(
            folder.path(),
            &[&line[..], &["--threads", threads, "--out", out]].concat(),
        );
        assert_eq!(code, 0, "{text}");
    }
    for name in [
        "sweep.csv",
        "sweep.manifest.json",
        "sweep.parquet",
        "sweep.json",
    ] {
        let read = |out: &str| std::fs::read(folder.path().join(out).join(name)).unwrap();
        assert!(read("one") == read("two"), "{name}");
    }
}

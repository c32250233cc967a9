//! `jounce rerun`: files of every command are made again, and every change is found.

use crate::{SPEC, outcome, program, with_json};
use serde_json::Value;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");

/// Runs the program in a folder; returns the exit code, the JSON on stdout and stderr.
pub fn call(folder: &Path, arguments: &[&str]) -> (i32, Value, String) {
    let mut command = program();
    command.args(arguments).current_dir(folder);
    with_json(outcome(command.env("JOUNCE_CACHE", folder.join("cache"))))
}

/// Runs a command line with `--out out`, which must succeed.
pub fn write(folder: &Path, line: &str) {
    let arguments: Vec<&str> = line.split(' ').chain(["--out", "out"]).collect();
    let (code, _, text) = call(folder, &arguments);
    assert_eq!(code, 0, "{line}: {text}");
}

pub fn rerun(folder: &Path, file: &str) -> (i32, Value, String) {
    call(folder, &["rerun", file, "--json"])
}

/// Returns the files of results in a folder with one of these endings.
fn files(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let files = std::fs::read_dir(folder).unwrap();
    let mut paths: Vec<PathBuf> = files.map(|file| file.unwrap().path()).collect();
    paths.sort();
    let name = |path: &PathBuf| path.file_name().unwrap().to_str().unwrap().to_owned();
    let is_result = |path: &PathBuf| {
        let name = name(path);
        endings.iter().any(|end| name.ends_with(end)) && !name.ends_with(".manifest.json")
    };
    paths.retain(is_result);
    paths
}

/// Makes a file again, which must be equal.
fn assert_equal(folder: &Path, file: &Path) -> Value {
    let (code, json, text) = rerun(folder, file.to_str().unwrap());
    assert_eq!(code, 0, "{}: {text}", file.display());
    assert_eq!(json["equal"], true, "{json}");
    json
}

/// Writes the files of a command and makes one table of each name again, in turn in every format,
/// and one picture.
fn assert_equal_again(folder: &Path, line: &str) {
    let _ = std::fs::remove_dir_all(folder.join("out"));
    write(folder, line);
    let tables = files(&folder.join("out"), &[".csv", ".parquet", ".json"]);
    assert!(!tables.is_empty(), "{line}");
    for (index, table) in tables.iter().enumerate() {
        if index % 3 == (index / 3) % 3 {
            let json = assert_equal(folder, table);
            assert!(json["columns"].as_u64().unwrap() > 0, "{line}: {json}");
        }
    }
    let pictures = files(&folder.join("out"), &[".svg", ".png", ".pdf"]);
    if let Some(picture) = pictures.get(line.len() % pictures.len().max(1)) {
        assert_equal(folder, picture);
    }
}

/// Returns a folder with a copy of the paper's spec, `a.toml`, with short runs.
pub fn folder() -> tempfile::TempDir {
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
#[ignore = "long: runs with ./test --long"]
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
#[ignore = "long: runs with ./test --long"]
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
#[ignore = "long: runs with ./test --long"]
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
        assert_equal(folder.path(), Path::new(arguments[arguments.len() - 1]));
    }
    for line in [
        "read hit.parquet --span 0s:1s --to part.csv",
        "show a.toml --set stop.tip.gap=2mm --out tip.svg",
        "show a.toml --out tip.png",
        "show a.toml --out tip.pdf",
    ] {
        let arguments: Vec<&str> = line.split(' ').collect();
        let (code, _, text) = call(folder.path(), &arguments);
        assert_eq!(code, 0, "{line}: {text}");
        assert_equal(folder.path(), Path::new(arguments[arguments.len() - 1]));
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

#[test]
#[ignore = "computes the paper twice; part of ./test --all"]
fn files_of_the_reproduction_are_made_again() {
    let folder = folder();
    write(folder.path(), "reproduce");
    for file in ["out/figures/figure-4.svg", "out/tables/table-2.csv"] {
        assert_equal(folder.path(), Path::new(file));
    }
}

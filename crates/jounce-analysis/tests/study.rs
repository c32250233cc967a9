//! Studies: their points, identical tables for any split, stop or damage of the work, and immediate
//! errors for invalid texts.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use jounce_analysis::run::{RunPlan, StartState, simulate};
use jounce_analysis::study::{Folder, Shard, Study, StudyError};
use jounce_analysis::{Model, Sweep, SweepOrder};
use jounce_control::Control;
use jounce_io::table::{Table, Values};
use jounce_model::linear::{FrfInput, FrfResponse, frf};
use jounce_spec::SpecFile;
use std::path::{Path, PathBuf};

const GRID: &str = r#"
spec = "harvester.toml"
points_per_part = 3
[set]
"run.duration" = "0.5 s"
"run.average_over" = "0.25 s"
[vary]
"stop.tip.gap" = "0.5mm,1mm"
"drive.shaker.frequency" = "11Hz:13Hz:2x"
"circuit.load.resistance" = "100kohm:1Mohm:2log"
"#;

fn example_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/impact-harvester-2019")
}

fn study(text: &str) -> Study {
    Study::parse(text, &example_folder()).unwrap()
}

/// Returns the bytes of the merged table after the given number of shards, on the threads of a
/// pool.
fn merged_bytes(study: &Study, folder: &Path, shards: usize) -> Vec<u8> {
    for index in 1..=shards {
        let folder_state = Folder::of(folder, study).unwrap();
        folder_state
            .run(
                study,
                Shard { index, of: shards },
                &Control::default(),
                &|_| (),
            )
            .unwrap();
    }
    std::fs::read(Folder::open(folder).unwrap().merge().unwrap()).unwrap()
}

#[test]
fn a_grid_runs_through_its_first_key_fastest() {
    let study = study(GRID);
    assert_eq!(
        (study.design.len(), study.parts(), study.points(2)),
        (8, 3, 6..8)
    );
    assert_eq!(study.design.point(0), [0.5e-3, 11.0, 1e5]);
    assert_eq!(study.design.point(1), [1e-3, 11.0, 1e5]);
    assert_eq!(study.design.point(6), [0.5e-3, 13.0, 1e6]);
}

#[test]
fn a_list_takes_its_values_side_by_side_and_drawn_points_stay_in_their_range() {
    let list = study(&GRID.replace("spec =", "sampling = \"list\"\nspec ="));
    assert_eq!(
        (list.design.len(), list.design.point(1)),
        (2, vec![1e-3, 13.0, 1e6])
    );
    for sampling in ["random", "latin-hypercube", "sobol"] {
        let text = format!(
            "spec = \"harvester.toml\"\nsampling = \"{sampling}\"\npoints = 64\n[vary]\n\"stop.tip.gap\" = \"0.5mm:1.5mm\"\n\
             \"circuit.load.resistance\" = \"1kohm:1Mohm:log\"\n"
        );
        let drawn = study(&text);
        let points: Vec<Vec<f64>> = (0..64).map(|index| drawn.design.point(index)).collect();
        assert!(
            points
                .iter()
                .all(|point| (0.5e-3..=1.5e-3).contains(&point[0])
                    && (1e3..=1e6).contains(&point[1])),
            "{sampling}"
        );
        // Half of the loads lie below the geometric mean of the ends: exactly so for cells of one
        // point each.
        let low = points
            .iter()
            .filter(|point| point[1] < 1e3 * 1e3_f64.sqrt())
            .count();
        assert!(
            if sampling == "random" {
                (16..48).contains(&low)
            } else {
                low == 32
            },
            "{sampling}: {low}"
        );
    }
}

#[test]
fn a_row_is_the_run_that_the_changed_spec_gives() {
    let study = study(GRID);
    let table = study.part(1, &Control::default()).unwrap().unwrap();
    let mut file = SpecFile::read(example_folder().join("harvester.toml")).unwrap();
    // Point 5: the second gap, the first frequency, the second load.
    let keys = [
        ("stop.tip.gap", "1 mm"),
        ("drive.shaker.frequency", "11 Hz"),
        ("circuit.load.resistance", "1 Mohm"),
    ];
    for (key, value) in keys
        .into_iter()
        .chain([("run.duration", "0.5 s"), ("run.average_over", "0.25 s")])
    {
        file.set(key, value).unwrap();
    }
    let prepared = Model::new(file.spec().unwrap()).unwrap();
    let plan = RunPlan {
        duration_s: 0.5,
        average_over_s: 0.25,
        tolerance: prepared.spec.run.tolerance,
        record_s: 0.0,
    };
    let result = simulate(
        &prepared.kernel,
        &StartState::rest(&prepared.kernel.plant),
        &plan,
    )
    .unwrap();
    assert_eq!(
        table.floats("mean_power_w").unwrap()[2],
        result.mean_power_w
    );
    assert_eq!(
        table.floats("voltage_rms_v").unwrap()[2],
        result.loads[0].voltage_rms_v
    );
    assert!(result.mean_power_w > 0.0);
}

#[test]
fn any_number_of_shards_gives_the_same_bytes() {
    let (study, folder) = (study(GRID), tempfile::tempdir().unwrap());
    let reference = merged_bytes(&study, &folder.path().join("whole"), 1);
    assert_eq!(
        reference,
        merged_bytes(&study, &folder.path().join("three"), 3)
    );
    let (table, manifest) = Table::read(&folder.path().join("whole/study.parquet")).unwrap();
    assert_eq!(
        (table.rows(), manifest.options["study_sha256"].as_str()),
        (8, study.hash_hex())
    );
    let Values::Count(points) = &table.column("point").unwrap().values else {
        panic!("numbers of points are counts")
    };
    assert!(points.iter().copied().eq(0..8));
}

#[test]
fn damaged_parts_are_recomputed() {
    let (study, folder) = (study(GRID), tempfile::tempdir().unwrap());
    let reference = merged_bytes(&study, folder.path(), 1);
    let part = |number| {
        folder
            .path()
            .join(format!("parts/part-{number:06}.parquet"))
    };
    let bytes = std::fs::read(part(0)).unwrap();
    std::fs::write(part(0), &bytes[..bytes.len() / 2]).unwrap();
    std::fs::copy(part(1), part(2)).unwrap();
    let folder_state = Folder::open(folder.path()).unwrap();
    assert_eq!(
        (
            folder_state.status().finished,
            folder_state.status().damaged.len(),
            folder_state.missing()
        ),
        (1, 2, vec![0, 2])
    );
    assert!(matches!(
        folder_state.merge(),
        Err(StudyError::Table(_) | StudyError::Damaged { .. })
    ));
    assert_eq!(reference, merged_bytes(&study, folder.path(), 1));
}

#[test]
fn a_stopped_study_keeps_its_finished_parts_and_continues() {
    let (study, folder) = (study(GRID), tempfile::tempdir().unwrap());
    let folder_state = Folder::of(folder.path(), &study).unwrap();
    let control = Control::default();
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    pool.install(|| {
        folder_state.run(&study, Shard::WHOLE, &control, &|points| {
            if points > 0 {
                control.stop()
            }
        })
    })
    .unwrap();
    assert_eq!(folder_state.status().finished, 1);
    let error = folder_state.merge().unwrap_err();
    assert!(
        error.to_string().starts_with("2 of 3 parts are missing"),
        "{error}"
    );
    let reference = merged_bytes(&study, &folder.path().join("other"), 1);
    assert_eq!(reference, merged_bytes(&study, folder.path(), 2));
}

#[test]
fn a_folder_belongs_to_one_study_and_a_shard_to_one_process() {
    let folder = tempfile::tempdir().unwrap();
    let folder_state = Folder::of(folder.path(), &study(GRID)).unwrap();
    let other = Folder::of(folder.path(), &study(&GRID.replace("0.5mm", "0.6mm"))).unwrap_err();
    assert!(matches!(other, StudyError::OtherStudy { .. }), "{other}");
    let nothing = Folder::open(&folder.path().join("parts")).unwrap_err();
    assert!(nothing.to_string().contains("holds no study"), "{nothing}");
    let lock = std::fs::File::create(folder.path().join(".shard-1-of-2.lock")).unwrap();
    lock.lock().unwrap();
    let study = study(GRID);
    let busy = folder_state
        .run(
            &study,
            Shard { index: 1, of: 2 },
            &Control::default(),
            &|_| (),
        )
        .unwrap_err();
    assert!(
        busy.to_string()
            .contains("another process works on shard 1/2"),
        "{busy}"
    );
    folder_state
        .run(
            &study,
            Shard { index: 2, of: 2 },
            &Control::default(),
            &|_| (),
        )
        .unwrap();
    assert_eq!(folder_state.status().finished, 1);
}

#[test]
fn a_point_without_a_result_has_a_reason() {
    let study = study(&GRID.replace("0.5mm,1mm", "1mm,2mm").replace(
        "\"circuit.load.resistance\" = \"100kohm:1Mohm:2log\"",
        "\"patch.mfc.start\" = \"9mm,300mm\"",
    ));
    let table = study.part(1, &Control::default()).unwrap().unwrap();
    let Values::Text(reasons) = &table.column("failure").unwrap().values else {
        panic!("reasons are texts")
    };
    let power = table.floats("mean_power_w").unwrap();
    assert!(
        reasons[0].is_empty()
            && power[0] > 0.0
            && reasons[1].contains("patch.mfc")
            && power[1].is_nan(),
        "{reasons:?} {power:?}"
    );
}

/// First number of a column.
fn first_number(table: &Table, column: &str) -> f64 {
    match &table.column(column).unwrap().values {
        Values::Count(counts) => counts[0] as f64,
        _ => table.floats(column).unwrap()[0],
    }
}

/// Returns the only row of a study of one point of the paper's harvester.
fn single_row(quantity: &str) -> Table {
    let set = "[set]\n\"run.duration\" = \"2 s\"\n\"run.average_over\" = \"1 s\"\n";
    let text = format!(
        "spec = \"harvester.toml\"\n{set}[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\n{quantity}\n"
    );
    study(&text).part(0, &Control::default()).unwrap().unwrap()
}

#[test]
fn a_frequency_response_has_the_peak_of_the_linear_harvester() {
    let folder_state =
        single_row("command = \"frf\"\nlow = \"2 Hz\"\nhigh = \"20 Hz\"\npoints = 2001");
    let mut spec = SpecFile::read(example_folder().join("harvester.toml"))
        .unwrap()
        .spec()
        .unwrap();
    spec.stop.clear();
    let modes = jounce_model::structure::modes(&spec).unwrap();
    let plant = jounce_model::plant::Plant::new(
        jounce_model::plant::System::assemble(&spec, modes).unwrap(),
    )
    .unwrap();
    let (input, response) = (
        FrfInput::Force("table".to_owned()),
        FrfResponse::LoadVoltage("load".to_owned()),
    );
    let hz = first_number(&folder_state, "peak_frequency_hz");
    let at = |hz: f64| {
        frf(&plant, &input, std::slice::from_ref(&response), &[hz]).unwrap()[0].value[0].norm()
    };
    assert_eq!(first_number(&folder_state, "peak_voltage"), at(hz));
    // The neighbours on the frequency grid are lower.
    assert!(
        at(hz * 1.0012) < at(hz) && at(hz / 1.0012) < at(hz),
        "{hz} Hz"
    );
}

#[test]
fn a_sweep_as_a_quantity_is_the_sweep() {
    let folder_state = single_row(
        "command = \"sweep\"\nover = \"drive.shaker.frequency=11Hz:13Hz:1Hz\"\nfixed_duration = true",
    );
    let mut file = SpecFile::read(example_folder().join("harvester.toml")).unwrap();
    for (key, value) in [
        ("stop.tip.gap", "1 mm"),
        ("run.duration", "2 s"),
        ("run.average_over", "1 s"),
    ] {
        file.set(key, value).unwrap();
    }
    let (spec, range) = (
        file.spec().unwrap(),
        file.range("drive.shaker.frequency=11Hz:13Hz:1Hz").unwrap(),
    );
    let sweep = Sweep {
        spec: &spec,
        range: &range,
        direction: SweepOrder::Up,
        fixed_duration: true,
        folder: example_folder(),
    };
    let points = sweep.run(None, &Control::default(), &|_| ()).unwrap();
    let highest = points
        .iter()
        .max_by(|a, b| a.mean_power_w.total_cmp(&b.mean_power_w))
        .unwrap();
    assert_eq!(
        (
            first_number(&folder_state, "peak_power_w"),
            first_number(&folder_state, "peak_parameter")
        ),
        (highest.mean_power_w, highest.parameter)
    );
    let not_settled = points.iter().filter(|point| !point.settled).count();
    assert_eq!(first_number(&folder_state, "unsettled"), not_settled as f64);
}

#[test]
fn every_quantity_fills_its_columns() {
    let quantities = [
        ("command = \"modes\"\ncount = 2", "frequency_2_hz"),
        (
            "command = \"frf\"\nlow = \"2 Hz\"\nhigh = \"20 Hz\"\npoints = 50",
            "peak_voltage",
        ),
        (
            "command = \"sweep\"\nover = \"drive.shaker.frequency=12Hz,12.2Hz\"\nfixed_duration = true",
            "average_power_w",
        ),
        (
            "command = \"diagram\"\nover = \"drive.shaker.frequency=12Hz,12.2Hz\"\ndirection = \"up\"",
            "longest_period_cycles",
        ),
        ("command = \"basins\"\nstarts = 2", "expected_power_w"),
        (
            "command = \"branch\"\nover = \"drive.shaker.frequency=12Hz:12.5Hz\"\nseeds = 0",
            "peak_power_w",
        ),
    ];
    for (quantity, column) in quantities {
        let text = format!(
            "spec = \"harvester.toml\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\n{quantity}\n"
        );
        let table = study(&text).part(0, &Control::default()).unwrap().unwrap();
        assert!(
            first_number(&table, column) > 0.0,
            "{quantity}: {:?}",
            table.column("failure")
        );
    }
    let noisy = example_folder().join("../random-base");
    for quantity in ["command = \"ensemble\"\nmembers = 2", "command = \"noise\""] {
        let short = "[set]\n\"run.duration\" = \"1 s\"\n\"run.average_over\" = \"0.5 s\"\n";
        let text = format!(
            "spec = \"harvester.toml\"\n{short}[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\n{quantity}\n"
        );
        let table = Study::parse(&text, &noisy)
            .unwrap()
            .part(0, &Control::default())
            .unwrap()
            .unwrap();
        assert!(
            table.floats("mean_power_w").unwrap()[0] > 0.0,
            "{quantity}: {:?}",
            table.column("failure")
        );
    }
}

#[test]
fn all_faults_of_a_text_come_at_once_with_their_lines() {
    let text = "spec = \"harvester.toml\"\nsampling = \"grod\"\nseed = -1\npoint = 3\n[vary]\n\"stop.tip.gapp\" = \"1mm\"\n\"stop.tip.gap\" = \"1kg\"\n[quantity]\ncommand = \"guess\"\n";
    let Err(StudyError::Faults(faults)) = Study::parse(text, &example_folder()) else {
        panic!("this text is wrong")
    };
    let mut lines: Vec<usize> = faults.iter().map(|fault| fault.line).collect();
    lines.sort_unstable();
    assert_eq!(lines, [2, 3, 4, 6, 7, 9], "{faults:?}");
    let invalid = [
        ("", "names no spec"),
        ("spec = ", "no TOML"),
        ("spec = \"none.toml\"", "none.toml"),
        ("spec = \"harvester.toml\"", "vary names no key"),
        (
            "spec = \"harvester.toml\"\nsampling = \"sobol\"\n[vary]\n\"stop.tip.gap\" = \"1mm:2mm\"",
            "points is missing",
        ),
        (
            "spec = \"harvester.toml\"\nsampling = \"random\"\npoints = 3\n[vary]\n\"stop.tip.gap\" = \"1mm:2mm:3x\"",
            "range",
        ),
        (
            "spec = \"harvester.toml\"\npoints = 3\n[vary]\n\"stop.tip.gap\" = \"1mm\"",
            "does not go with",
        ),
        (
            "spec = \"harvester.toml\"\n[vary]\n\"stop.tip.gap\" = \"1mm:2mm:9x\"\n\"stop.tip.stiffness\" = \"1N/m^1.5:2N/m^1.5:1000000x\"\n\"drive.shaker.frequency\" = \"1Hz:2Hz:1000x\"",
            "more than",
        ),
        (
            "spec = \"harvester.toml\"\n[set]\n\"stop.tip.gap\" = \"1kg\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"",
            "kg",
        ),
        (
            "spec = \"harvester.toml\"\n[vary.stop]\ntip = 3",
            "whole path",
        ),
        (
            "spec = \"harvester.toml\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\ncommand = \"branch\"",
            "over is missing",
        ),
        (
            "spec = \"harvester.toml\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\ncommand = \"frf\"\nlow = \"9 kg\"",
            "quantity.low",
        ),
        (
            "spec = \"harvester.toml\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\ncommand = \"diagram\"\nover = \"drive.shaker.frequency=14Hz,10Hz\"",
            "must rise",
        ),
        (
            "spec = \"harvester.toml\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\ncommand = \"sweep\"\nover = \"drive.shaker.frequency=10Hz:14Hz:1Hz\"\ndirection = \"left\"",
            "up, down, both, independent",
        ),
        (
            "spec = \"harvester.toml\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\ncommand = \"bifurcations\"\nover = \"drive.shaker.frequency=4Hz:20Hz\"",
            "against is missing",
        ),
        (
            "spec = \"harvester.toml\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\ncommand = \"run\"\nstarts = 3",
            "no such key",
        ),
        (
            "spec = \"harvester.toml\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\ncommand = \"noise\"",
            "noise needs a drive",
        ),
    ];
    for (text, expected) in invalid {
        let error = Study::parse(text, &example_folder())
            .unwrap_err()
            .to_string();
        assert!(error.contains(expected), "{text}\n-> {error}");
    }
}

//! Quantities of a point, against the analyses themselves.

use crate::{example_folder, study};
use jounce_analysis::study::Study;
use jounce_analysis::{Sweep, SweepOrder};
use jounce_control::Control;
use jounce_io::table::{Table, Values};
use jounce_model::linear::{FrfInput, FrfOutput, frf};
use jounce_spec::SpecFile;

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
        FrfOutput::LoadVoltage("load".to_owned()),
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

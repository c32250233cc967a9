//! `rectified-shu-lien-2006`: power against the load for four interfaces, and the charging of the
//! storage.

use crate::comparison::check;
use crate::loads::{logarithmic_range, over_resistance};
use crate::rows::folder;
use jounce_analysis::Model;
use jounce_analysis::run::{RunPlan, RunResult, simulate};
use jounce_plot::{Trace, power_against_resistance, time_histories};
use jounce_spec::SpecFile;
use std::path::Path;

const EXAMPLE: &str = "rectified-shu-lien-2006";

/// Diodes of the spec, almost without resistance.
const DIODES: (&str, &str) = ("circuit.rectifier.diode_resistance", "1 uohm");

fn run(
    settings: &[(&str, &str)],
    duration_s: f64,
    average_over_s: f64,
    record_s: f64,
) -> (Model, RunResult) {
    let text = std::fs::read_to_string(folder(EXAMPLE).join("harvester.toml")).unwrap();
    // Not every interface has diodes with a resistance; those that have one set it again.
    let text: String = text
        .lines()
        .filter(|line| !line.starts_with("diode_resistance"))
        .map(|line| format!("{line}\n"))
        .collect();
    let mut file = SpecFile::from_text(text);
    settings
        .iter()
        .for_each(|(key, value)| file.set(key, value).unwrap());
    let prepared = Model::new(file.spec().unwrap()).unwrap();
    let start = prepared.start(Path::new(".")).unwrap();
    let plan = RunPlan {
        duration_s,
        average_over_s,
        tolerance: 1e-7,
        record_s,
    };
    let result = simulate(&prepared.kernel, &start, &plan).unwrap();
    (prepared, result)
}

#[test]
fn power_of_the_interfaces_against_the_load() {
    let resistance_ohm = logarithmic_range(0.03, 30.0, 31);
    let weak = ("modal.cell.patch.element.coupling_n_per_v", "[0.1]");
    let kinds: [(&str, &str, Option<&str>); 4] = [
        ("bridge", "bridge", None),
        ("parallel SSHI, Q = 5", "parallel-sshi", Some("5")),
        ("series SSHI, Q = 5", "series-sshi", Some("5")),
        ("SECE", "sece", None),
    ];
    let lines: Vec<_> = kinds
        .into_iter()
        .map(|(label, interface, quality)| {
            over_resistance(label, &resistance_ohm, |_, words| {
                let mut settings = vec![
                    weak,
                    ("circuit.rectifier.interface", interface),
                    ("circuit.rectifier.resistance", words),
                ];
                settings.extend([
                    ("circuit.rectifier.storage", "20 F"),
                    ("drive.shaker.frequency", "0.15915494309189535 Hz"),
                ]);
                settings.extend(
                    Some(DIODES).filter(|_| matches!(interface, "bridge" | "parallel-sshi")),
                );
                settings
                    .extend(quality.map(|quality| ("circuit.rectifier.quality_factor", quality)));
                run(&settings, 5000.0, 600.0, 0.0).1.mean_power_w
            })
        })
        .collect();
    let title =
        "Mean power at resonance against the load, squared coupling 0.01, damping ratio 0.02";
    check(
        EXAMPLE,
        "power",
        &power_against_resistance(title, "W", &lines),
    );
}

/// The storage charges within some cycles; the voltage of the patch alternates against it.
#[test]
fn the_storage_as_it_charges() {
    let settings = [
        ("circuit.rectifier.storage", "20 F"),
        ("circuit.rectifier.resistance", "3 ohm"),
        DIODES,
    ];
    let (duration_s, count) = (240.0, 2400);
    let (prepared, result) = run(&settings, duration_s, duration_s, duration_s);
    let plant = &prepared.kernel.plant;
    let time_s: Vec<f64> = (0..count)
        .map(|k| duration_s * f64::from(k) / f64::from(count - 1))
        .collect();
    let instants = result.trajectory.at(&prepared.kernel, &time_s);
    let states: Vec<Vec<f64>> = instants
        .iter()
        .map(|at| plant.to_physical(&at.state, at.time_s))
        .collect();
    let storage = 2 * plant.system.modes.len() + plant.electrical.bridges[0].storage.unwrap();
    let trace = |quantity: &str, unit: &str, value: &dyn Fn(&Vec<f64>) -> f64| Trace {
        quantity: quantity.into(),
        unit: unit.into(),
        values: states.iter().map(value).collect(),
    };
    let traces = [
        trace("Displacement", "m", &|state| state[0]),
        trace("Voltage of the element", "V", &|state| {
            plant.patch_voltages_v(state)[0]
        }),
        trace("Voltage of the storage", "V", &|state| state[storage]),
    ];
    let title = "A bridge charges its storage: 20 F and 3 Ω in the units of the paper, from rest";
    check(
        EXAMPLE,
        "run-time",
        &time_histories(title, &time_s, &traces),
    );
}

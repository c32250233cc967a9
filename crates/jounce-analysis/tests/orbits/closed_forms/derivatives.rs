//! Derivatives of the mean power of an orbit by keys: of a linear harvester against its closed form,
//! and of the bench against differences of orbits.

use super::super::harvesters::bench_with_keys;
use jounce_analysis::{
    DerivativeAccuracy, DerivativeKey, KeyLine, Model, Recognition, Recognizer, orbit_derivatives,
};
use jounce_model::reference::PiezoResistor;
use jounce_orbits::{Orbit, OrbitQuantity, ParametricModel};
use jounce_spec::{NumericKey, SpecFile};
use std::f64::consts::TAU;

/// The stable orbit that the motion from rest reaches.
fn orbit(model: &Model) -> Orbit {
    orbit_of(model).unwrap()
}

/// The stable orbit that the motion from rest reaches, if it reaches one.
pub fn orbit_of(model: &Model) -> Option<Orbit> {
    let line = KeyLine::at(model);
    let kernel = line.at(0.0).unwrap().kernel;
    let recognizer = Recognizer {
        family: &line,
        kernel: &kernel,
        parameter: 0.0,
        options: Recognition {
            goal: 1e-11,
            ..Recognition::at(1e-12)
        },
    };
    let start = kernel.plant.resting_physical();
    let end = recognizer.settle(&start, &[]);
    Some(end.orbit()?.orbit.clone())
}

fn model(file: &SpecFile, changes: &[(&NumericKey, f64)]) -> Model {
    let mut spec = file.spec().unwrap();
    NumericKey::set_all(&mut spec, changes).unwrap();
    Model::new(spec).unwrap()
}

/// Returns the mean power and its derivatives by keys, each with its error, all relative to the power
/// and the values of the keys.
fn logarithmic(file: &SpecFile, keys: &[NumericKey]) -> (f64, Vec<[f64; 2]>) {
    let base = model(file, &[]);
    let scales: Vec<f64> = keys
        .iter()
        .map(|key| key.get(&base.spec).unwrap())
        .collect();
    let wanted: Vec<DerivativeKey<'_>> = keys
        .iter()
        .zip(&scales)
        .map(|(key, scale)| DerivativeKey { key, scale: *scale })
        .collect();
    let accuracy = DerivativeAccuracy::Estimated;
    let quantities = [OrbitQuantity::MeanPower];
    let found = orbit_derivatives(&base, &orbit(&base), &wanted, &quantities, accuracy).unwrap();
    let power_w = found.values[0];
    let rows = found.by_key.into_iter().map(Result::unwrap);
    let relative = rows
        .zip(&scales)
        .map(|(row, scale)| [row[0].value, row[0].error].map(|x| x * scale / power_w))
        .collect();
    (power_w, relative)
}

const LINEAR: &str = r#"
[modal.m]
frequency_hz = [10.0]
damping_ratio = [0.02]
[modal.m.point]
tip = [1.3]
[modal.m.patch.p]
coupling_n_per_v = [0.004]
capacitance = "150 nF"
[circuit.load]
patch = "m.p"
resistance = "80 kohm"
[drive.d]
at = "m.tip"
kind = "force"
amplitude = "0.7 N"
frequency = "9.7 Hz"
[run]
duration = "1 s"
average_over = "1 s"
"#;

/// Mean power of the linear harvester by resistance, frequency, amplitude and damping ratio.
fn power_w([resistance_ohm, drive_hz, force_n, damping_ratio]: [f64; 4]) -> f64 {
    let mass_kg = 1.3_f64.powi(-2);
    let harvester = PiezoResistor {
        mass_kg,
        frequency_rad_s: TAU * 10.0,
        damping_ratio,
        coupling_n_per_v: 0.004 * mass_kg.sqrt(),
        capacitance_f: 150e-9,
        resistance_ohm,
    };
    let voltage_v = force_n * harvester.voltage_per_newton(drive_hz).norm();
    0.5 * voltage_v.powi(2) / resistance_ohm
}

#[test]
fn derivatives_of_a_linear_harvester_have_their_closed_form() {
    let file = SpecFile::from_text(LINEAR);
    let paths = [
        "circuit.load.resistance",
        "drive.d.frequency",
        "drive.d.amplitude",
        "modal.m.damping_ratio.1",
    ];
    let keys = paths.map(|path| file.numeric_key(path).unwrap());
    let at = [80e3, 9.7, 0.7, 0.02];
    let (power, found) = logarithmic(&file, &keys);
    assert!((power / power_w(at) - 1.0).abs() < 1e-9, "{power}");
    for (k, [value, error]) in found.into_iter().enumerate() {
        let shifted = |factor: f64| {
            let mut at = at;
            at[k] *= factor;
            power_w(at).ln()
        };
        // Fourth order, of a smooth closed form.
        let h = 1e-4;
        let slope = |h: f64| (shifted(1.0 + h) - shifted(1.0 - h)) / (2.0 * h);
        let expected = (4.0 * slope(h) - slope(2.0 * h)) / 3.0;
        assert!(
            (value - expected).abs() < 1e-7 * expected.abs().max(1.0),
            "{}: {value} {expected}",
            paths[k]
        );
        assert!(error < 1e-5, "{}: {error}", paths[k]);
    }
}

#[test]
fn derivatives_with_contact_are_differences_of_orbits() {
    let file = bench_with_keys(&[("drive.shaker.frequency", "11 Hz")]);
    let paths = [
        "stop.tip.gap",
        "stop.tip.stiffness",
        "circuit.load.resistance",
        "drive.shaker.frequency",
        "drive.shaker.amplitude",
        "modal.harvester.damping_ratio.2",
        "modal.harvester.frequency_hz.2",
    ];
    let keys = paths.map(|path| file.numeric_key(path).unwrap());
    let (_, found) = logarithmic(&file, &keys);
    let spec = file.spec().unwrap();
    for (key, [value, error]) in keys.iter().zip(found) {
        let nominal = key.get(&spec).unwrap();
        let power = |factor: f64| {
            orbit(&model(&file, &[(key, nominal * factor)]))
                .mean_power_w
                .ln()
        };
        let slope = |h: f64| (power(1.0 + h) - power(1.0 - h)) / (2.0 * h);
        let expected = (4.0 * slope(2e-4) - slope(4e-4)) / 3.0;
        let scale = expected.abs().max(1.0);
        eprintln!("{}: {value} {expected}, error {error:.1e}", key.path());
        assert!(
            (value - expected).abs() < 1e-6 * scale,
            "{}: {value} {expected}",
            key.path()
        );
    }
}

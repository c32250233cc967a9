//! Peaks of the mean power over the frequency, and their derivatives by keys.

use jounce_analysis::{
    Basins, Cloud, DerivativeKey, InitialStates, Model, PeakPlace, Recognition, nearest_peak,
};
use jounce_linalg::c64;
use jounce_spec::{NumericKey, Spec, SpecFile};
use std::f64::consts::TAU;
use std::path::Path;

/// Returns the nearest peak of the orbit that a cloud of starts reaches.
fn peak(model: &Model) -> PeakPlace {
    let cloud = Cloud {
        starts: 2,
        seed: 1,
        spread: 1.0,
    };
    let study = Basins {
        base: model,
        starts: InitialStates::Cloud(cloud),
        recognition: Recognition::at(1e-10),
    };
    let attractors = study.run().unwrap().attractors;
    let orbit = attractors[0].orbit().unwrap();
    let found = nearest_peak(model, orbit.period_cycles, orbit.start()).unwrap();
    found.unwrap()
}

/// Returns a spec with a key multiplied by a factor.
fn changed(spec: &Spec, path: &str, factor: f64) -> Spec {
    let mut spec = spec.clone();
    let key = NumericKey::find(&spec, path).unwrap();
    let value = key.get(&spec).unwrap();
    key.set(&mut spec, factor * value).unwrap();
    spec
}

/// Returns the relative derivatives of the frequency and the power of a peak by keys, with errors.
fn derivatives(model: &Model, peak: &PeakPlace, paths: &[&str]) -> Vec<[[f64; 2]; 2]> {
    let keys: Vec<NumericKey> = paths
        .iter()
        .map(|path| NumericKey::find(&model.spec, path).unwrap())
        .collect();
    let value = |key: &NumericKey| key.get(&model.spec).unwrap();
    let wanted: Vec<DerivativeKey<'_>> = keys
        .iter()
        .map(|key| DerivativeKey {
            key,
            scale: value(key),
        })
        .collect();
    let found = peak.derivatives(model, &wanted).unwrap();
    let relative = |(key, found): (&NumericKey, &jounce_analysis::PeakDerivative)| {
        let pairs = [
            (found.frequency_hz, peak.frequency_hz),
            (found.mean_power_w, peak.mean_power_w),
        ];
        pairs.map(|(derivative, size)| {
            let factor = value(key) / size;
            [derivative.value * factor, derivative.error * factor.abs()]
        })
    };
    keys.iter().zip(&found).map(relative).collect()
}

/// Returns the derivative by the logarithm of a key from values at changed keys.
fn slope(value: impl Fn(f64) -> f64, h: f64) -> f64 {
    let at = |h: f64| (value(1.0 + h) - value(1.0 - h)) / (2.0 * h);
    (4.0 * at(h) - at(2.0 * h)) / 3.0
}

/// One mode with a patch and a resistor, driven by a force:
///
/// ```text
/// q = F / (w^2 - W^2 + 2 i zeta w W + theta^2 Z)    V = -theta Z q    Z = i W / (1 / R + i W C)
/// ```
#[derive(Clone, Copy)]
struct OneMode {
    frequency_hz: f64,
    damping_ratio: f64,
    coupling_n_per_v: f64,
    capacitance_f: f64,
    resistance_ohm: f64,
}

impl OneMode {
    fn power_w(&self, frequency_hz: f64) -> f64 {
        let (w, drive) = (TAU * self.frequency_hz, TAU * frequency_hz);
        let i = c64::new(0.0, 1.0);
        let z = i * drive / (self.resistance_ohm.recip() + i * drive * self.capacitance_f);
        let stiffness = w * w - drive * drive + i * (2.0 * self.damping_ratio * w * drive);
        let q = c64::new(0.1, 0.0) / (stiffness + z * self.coupling_n_per_v.powi(2));
        let voltage = z * q * self.coupling_n_per_v;
        voltage.norm_sqr() / (2.0 * self.resistance_ohm)
    }

    /// Frequency of the largest power, by bisection of the slope.
    fn peak_hz(&self) -> f64 {
        let slope = |hz: f64| {
            let at = |k: f64| self.power_w(hz * (1.0 + k * 1e-4)).ln();
            8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))
        };
        let (mut low, mut high) = (0.95 * self.frequency_hz, 1.1 * self.frequency_hz);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if slope(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
}

#[test]
fn the_peak_of_one_mode_and_its_derivatives_are_those_of_the_closed_form() {
    let one = OneMode {
        frequency_hz: 10.0,
        damping_ratio: 0.02,
        coupling_n_per_v: 0.02,
        capacitance_f: 1e-6,
        resistance_ohm: 20e3,
    };
    let spec = Spec::from_toml(
        "[modal.h]\nfrequency_hz = [10.0]\ndamping_ratio = [0.02]\nparticipation_sqrt_kg = [0.8]\n[modal.h.point]\ntip = [1.0]\n\
         [modal.h.patch.p]\ncoupling_n_per_v = [0.02]\ncapacitance = \"1 uF\"\n[circuit.c]\npatch = \"h.p\"\nresistance = \"20 kohm\"\n\
         [drive.d]\nat = \"h.tip\"\namplitude = \"0.1 N\"\nfrequency = \"9.5 Hz\"\n[run]\nduration = \"10 s\"\naverage_over = \"5 s\"\n",
    )
    .unwrap();
    let model = Model::new(spec).unwrap();
    let peak = peak(&model);
    let expected_hz = one.peak_hz();
    let error = peak.frequency_hz / expected_hz - 1.0;
    assert!(error.abs() < 1e-8, "{} {expected_hz}", peak.frequency_hz);
    let error = peak.mean_power_w / one.power_w(expected_hz) - 1.0;
    assert!(error.abs() < 1e-9, "{}", peak.mean_power_w);
    let (resistance, capacitance) = ("circuit.c.resistance", "modal.h.patch.p.capacitance");
    let with = |path: &str, factor: f64| match path == resistance {
        true => OneMode {
            resistance_ohm: factor * one.resistance_ohm,
            ..one
        },
        false => OneMode {
            capacitance_f: factor * one.capacitance_f,
            ..one
        },
    };
    let paths = [resistance, capacitance];
    for (path, [frequency, power]) in paths.iter().zip(derivatives(&model, &peak, &paths)) {
        let of_frequency = slope(|factor| with(path, factor).peak_hz(), 1e-3) / expected_hz;
        let of_power = |factor: f64| {
            let changed = with(path, factor);
            changed.power_w(changed.peak_hz())
        };
        let of_power = slope(of_power, 1e-3) / one.power_w(expected_hz);
        for ([value, error], expected) in [(frequency, of_frequency), (power, of_power)] {
            eprintln!("{path}: {value:.9e} +- {error:.1e}, expected {expected:.9e}");
            let deviation = (value - expected).abs();
            assert!(deviation < 1e-7, "{path}: {value} {expected}");
            assert!(error < 1e-6, "{path}: {error}");
        }
    }
}

#[test]
#[ignore = "long: runs with ./test --long"]
fn derivatives_of_a_peak_with_contact_are_those_of_peaks_at_changed_keys() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples/impact-harvester-2019/harvester.toml");
    let mut spec = SpecFile::read(&path).unwrap().spec().unwrap();
    let frequency = NumericKey::find(&spec, "drive.shaker.frequency").unwrap();
    frequency.set(&mut spec, 12.4).unwrap();
    let model = Model::new(spec).unwrap();
    let found = peak(&model);
    let paths = ["stop.tip.gap", "stop.tip.stiffness", "beam.beam.length"];
    for (path, [frequency, power]) in paths.iter().zip(derivatives(&model, &found, &paths)) {
        let at = |factor: f64| peak(&model.changed(changed(&model.spec, path, factor)).unwrap());
        let of_frequency = slope(|factor| at(factor).frequency_hz.ln(), 2e-4);
        let of_power = slope(|factor| at(factor).mean_power_w.ln(), 2e-4);
        for ([value, error], expected) in [(frequency, of_frequency), (power, of_power)] {
            eprintln!(
                "{path} at {:.6} Hz: {value:.9e} +- {error:.1e}, expected {expected:.9e}",
                found.frequency_hz
            );
            let deviation = (value - expected).abs() / expected.abs().max(1.0);
            assert!(deviation < 1e-6, "{path}: {value} {expected}");
        }
    }
}

//! Designs whose best values have a closed form.

use super::outcome_of;
use jounce_analysis::Model;
use jounce_linalg::c64;
use jounce_spec::{Quantity, SpecFile};
use std::f64::consts::TAU;
use std::path::Path;

/// A patch whose stiffness and mass do not matter, from the root of a uniform cantilever at its first
/// resonance: the power into the optimal load is `slope(L)^2 / L`, with the slope of the mode at the
/// end of the patch, and largest where the strain there is half the mean strain covered.
///
/// Source: statement of L. Zhao, S. Fan, J. Cheng (2017).
#[test]
fn the_best_patch_covers_the_root_up_to_half_the_mean_strain() {
    let spec = "[beam.b]\nyoungs_modulus = \"200 GPa\"\ndensity = \"8000 kg/m^3\"\nlength = \"100 mm\"\nwidth = \"20 mm\"\nthickness = \"1 mm\"\n\
        [patch.p]\non = \"b\"\nstart = \"0 mm\"\nlength = \"30 mm\"\nwidth = \"20 mm\"\nthickness = \"0.01 mm\"\n\
        youngs_modulus = \"3 GPa\"\nd31 = \"-170 pC/N\"\npermittivity = \"1.5e-8 F/m\"\nsection = \"thin-skin\"\n\
        [circuit.load]\npatch = \"p\"\nresistance = \"100 kohm\"\n\
        [drive.d]\nat = \"b.end\"\namplitude = \"0.1 N\"\nfrequency = \"80.77 Hz\"\n[damping]\nbeyond = 0.05\n\
        [reduction]\nmodes = 1\n[run]\nduration = \"1 s\"\naverage_over = \"1 s\"\n";
    let found = outcome_of(
        spec,
        "[free]\n\"patch.p.length\" = \"10mm:90mm\"\n\"circuit.load.resistance\" = \"100ohm:100kohm:log\"\n\
         [goal]\nmaximise = \"expected-power\"\nstarts = 2\n",
    );
    let length_m = (Quantity::Length.read(&found.best.set["patch.p.length"])).unwrap();
    let expected_m = 0.1 * half_of_mean_strain();
    assert!(
        (length_m / expected_m - 1.0).abs() < 1e-4,
        "{length_m} {expected_m}"
    );
}

/// One mode of the bimorph of Erturk and Inman at its short-circuit resonance `w` and its
/// open-circuit resonance `w_o = w sqrt(1 + k^2)`, with `k^2 = theta^2 / (C w^2)`:
///
/// ```text
/// w C R = 1 / sqrt(1 + (k^2 / 2 zeta)^2),   w_o C R = sqrt(1 + k^4 / (4 zeta^2 (1 + k^2)))
/// ```
///
/// Both are `1 / |Y|` of the electric port, `Y = i W C + i W theta^2 / (w^2 - W^2 + 2 i zeta w W)`.
///
/// Source: A. Erturk, D. J. Inman, Smart Mater. Struct. 18 (2009) 025009.
#[test]
fn the_best_loads_of_a_bimorph_at_both_resonances_are_those_of_the_closed_form() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples/bimorph-erturk-2009/harvester.toml");
    let mut file = SpecFile::read(&path).unwrap();
    file.set("reduction.modes", "1").unwrap();
    let plant = Model::new(file.spec().unwrap()).unwrap().kernel.plant;
    let modes = &plant.system.modes;
    let capacitance_f = plant.electrical.nodes[0].capacitance_f;
    let (w, zeta) = (modes.frequency_rad_s[0], modes.damping_ratio[0]);
    // In series each layer has half of the voltage.
    let of_layer = |name: &str| 0.5 * modes.patch[name].coupling_n_per_v[0].abs();
    let theta = of_layer("top") + of_layer("bottom");
    let k2 = theta * theta / (capacitance_f * w * w);
    let open = w * (1.0 + k2).sqrt();
    let at_short = 1.0 / (1.0 + (0.5 * k2 / zeta).powi(2)).sqrt() / (w * capacitance_f);
    let at_open =
        (1.0 + k2 * k2 / (4.0 * zeta * zeta * (1.0 + k2))).sqrt() / (open * capacitance_f);
    let force = modes.participation_sqrt_kg[0] * 9.81;
    for (drive, best_ohm) in [(w, at_short), (open, at_open)] {
        let mechanical = c64::new(w * w - drive * drive, 2.0 * zeta * w * drive);
        let i = c64::new(0.0, drive);
        let admittance = i * capacitance_f + i * (theta * theta) / mechanical;
        assert!((admittance.norm() * best_ohm - 1.0).abs() < 1e-10);
        let current = i * (theta * force) / mechanical;
        let voltage = current / (admittance + 1.0 / best_ohm);
        let expected_w = 0.5 * voltage.norm_sqr() / best_ohm;
        file.set("drive.base.frequency", &format!("{:?} Hz", drive / TAU))
            .unwrap();
        let found = outcome_of(
            &file.text(),
            "[free]\n\"circuit.load.resistance\" = \"1kohm:10Mohm:log\"\n\
             [goal]\nmaximise = \"expected-power\"\nstarts = 2\n",
        );
        let text = &found.best.set["circuit.load.resistance"];
        let found_ohm = Quantity::Resistance.read(text).unwrap();
        let power_w = found.best.mean_power_w;
        eprintln!("{found_ohm} ohm of {best_ohm}, {power_w} W of {expected_w}");
        assert!(
            (power_w / expected_w - 1.0).abs() < 1e-8,
            "{power_w} {expected_w}"
        );
        assert!(
            (found_ohm / best_ohm - 1.0).abs() < 1e-3,
            "{found_ohm} {best_ohm}"
        );
    }
}

/// Returns the length at which the strain of the first mode of a cantilever is half of its mean from
/// the root, relative to the length of the beam.
fn half_of_mean_strain() -> f64 {
    let k = 1.875_104_068_711_961_f64;
    let ratio = (k.cosh() + k.cos()) / (k.sinh() + k.sin());
    // w = cosh - cos - ratio (sinh - sin), over k x
    let slope =
        |x: f64| k * ((k * x).sinh() + (k * x).sin() - ratio * ((k * x).cosh() - (k * x).cos()));
    let curvature = |x: f64| {
        k * k * ((k * x).cosh() + (k * x).cos() - ratio * ((k * x).sinh() + (k * x).sin()))
    };
    let (mut low, mut high) = (0.1, 0.9);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if curvature(middle) > 0.5 * slope(middle) / middle {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

#[test]
fn the_closed_form_is_that_of_the_literature() {
    assert!((half_of_mean_strain() - 0.5105).abs() < 5e-5);
}

//! Powers and multipliers of weakly coupled interfaces.

use crate::rectified::orbit;
use jounce_spec::SpecFile;
use std::f64::consts::{PI, TAU};

/// Angular frequency of the drive, coupling and damping ratio of the weakly coupled cell.
const WEAK: (f64, f64, f64) = (0.8, 1e-5, 0.05);

fn weakly_coupled_cell(interface: &str, quality: Option<&str>, battery_v: f64) -> SpecFile {
    let (w, theta, zeta) = WEAK;
    let frequency = format!("{} Hz", w / TAU);
    let battery = format!("{battery_v} V");
    SpecFile::from_text(format!(
        "[modal.cell]\nfrequency_hz = [{}]\ndamping_ratio = [{zeta}]\n[modal.cell.point]\nmass = [1.0]\n[modal.cell.patch.element]\n\
         coupling_n_per_v = [{theta}]\ncapacitance = \"1 F\"\n[circuit.rectifier]\npatch = \"cell.element\"\ninterface = \"{interface}\"\n\
         battery = \"{battery}\"\n{}{}[drive.shaker]\nat = \"cell.mass\"\namplitude = \"1 N\"\nfrequency = \"{frequency}\"\n",
        1.0 / TAU,
        quality.map_or(String::new(), |quality| format!(
            "quality_factor = {quality}\n"
        )),
        if quality.is_some_and(|_| interface == "series-sshi") || interface == "sece" {
            ""
        } else {
            "diode_resistance = \"1 uohm\"\n"
        },
    ))
}

/// Ratio of the voltages across an inversion with a quality factor of 5.
fn inversion() -> f64 {
    (-PI / (2.0 * 5.0_f64)).exp()
}

/// Interface, quality factor, voltage of the battery and power in closed form.
fn cases() -> [(&'static str, Option<&'static str>, f64, f64); 4] {
    let (w, theta, zeta) = WEAK;
    let current = theta * w / ((1.0 - w * w).powi(2) + (2.0 * zeta * w).powi(2)).sqrt();
    let q = inversion();
    [
        (
            "bridge",
            None,
            0.5 * current / w,
            current * current / (TAU * w),
        ),
        (
            "parallel-sshi",
            Some("5"),
            current / (w * (1.0 - q)),
            current * current / (PI * w * (1.0 - q)),
        ),
        (
            "series-sshi",
            Some("5"),
            0.5 * current / w,
            (1.0 + q) / (1.0 - q) * current * current / (TAU * w),
        ),
        (
            "sece",
            None,
            current / w,
            4.0 * current * current / (TAU * w),
        ),
    ]
}

/// Weak coupling, `theta = 1e-5`: the powers of the interfaces are in closed form (Guyomar et al.
/// 2005, Lefeuvre et al. 2006). A storage of 20 F ripples by about a part in a hundred, which is of
/// second order in the power.
#[test]
fn weakly_coupled_interfaces_have_their_closed_forms() {
    let (w, _, zeta) = WEAK;
    for (interface, quality, battery, power) in cases() {
        let file = weakly_coupled_cell(interface, quality, battery);
        let (_, orbit) = orbit(&file, 0.0);
        let modulus = (-zeta * TAU / w).exp();
        // The two switches of a cycle reduce a voltage by the ratio of the inversion.
        let electrical = if interface == "series-sshi" {
            inversion().powi(2)
        } else {
            0.0
        };
        eprintln!(
            "{interface}: {:.2e} off, multipliers {:?}",
            orbit.mean_power_w / power - 1.0,
            orbit.multipliers
        );
        assert!(
            (orbit.mean_power_w / power - 1.0).abs() < 1e-8,
            "{interface}: {:e} against {power:e}",
            orbit.mean_power_w
        );
        // The circuit does not affect the motion.
        let near = |size: f64| {
            orbit
                .multipliers
                .iter()
                .any(|value| (value.norm() - size).abs() < 1e-8)
        };
        assert!(
            near(modulus) && near(electrical),
            "{interface}: {:?}",
            orbit.multipliers
        );
    }
}

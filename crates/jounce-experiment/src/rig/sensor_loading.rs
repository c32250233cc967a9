//! Effect of the instruments on the harvester.
//!
//! A cable is a capacitor and a resistor in parallel with its patch. With the charge `theta q` that
//! a motion `q` releases, the voltage falls from `theta q / (C + ..)` of the bare patch to
//!
//! ```text
//! V = - i w theta q / (i w (C + C_cable) + 1 / R + 1 / R_cable)
//! ```
//!
//! Both act back on the motion, as in a laboratory. An accelerometer is a mass fixed to its point.

use jounce_spec::{Mass, Spec};

use super::RigError;

/// Cable to the amplifier, one for each patch.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Cable {
    /// Capacitance including the amplifier input, F.
    pub capacitance_f: f64,
    /// Resistance of the insulation and the amplifier input, ohm; `None` without leakage.
    pub leakage_ohm: Option<f64>,
}

impl Cable {
    /// Connects a cable to every patch of a spec.
    ///
    /// # Errors
    /// A capacitance below 0, a resistance that is not above 0.
    pub fn wire(&self, spec: &mut Spec) -> Result<(), RigError> {
        let setting_error = |name, value, allowed| {
            Err(RigError::Setting {
                name,
                value,
                allowed,
            })
        };
        if !(self.capacitance_f >= 0.0 && self.capacitance_f.is_finite()) {
            return setting_error(
                "the capacitance of the cable in farad",
                self.capacitance_f,
                "0 or more",
            );
        }
        if let Some(value) = self
            .leakage_ohm
            .filter(|ohm| !(*ohm > 0.0 && ohm.is_finite()))
        {
            return setting_error("the resistance of the cable in ohm", value, "above 0");
        }
        for patch in spec.patch.values_mut() {
            let own_f = if spec.plate.contains_key(&patch.on) {
                patch.clamped_in_plane_capacitance_f()
            } else {
                patch.clamped_capacitance_f()
            };
            patch.capacitance_f = Some(own_f + self.capacitance_f);
            patch.permittivity_f_m = None;
            patch.leakage_ohm = match (patch.leakage_ohm, self.leakage_ohm) {
                (Some(patch_ohm), Some(cable_ohm)) => {
                    Some(patch_ohm * cable_ohm / (patch_ohm + cable_ohm))
                }
                (patch_ohm, cable_ohm) => patch_ohm.or(cable_ohm),
            };
        }
        Ok(())
    }
}

/// Fixes an accelerometer of a given mass to each point.
///
/// # Errors
/// A mass that is not above 0.
pub fn add_accelerometers(
    spec: &mut Spec,
    points: &[String],
    mass_kg: f64,
) -> Result<(), RigError> {
    if !(mass_kg > 0.0 && mass_kg.is_finite()) {
        return Err(RigError::Setting {
            name: "the mass of an accelerometer in kilogram",
            value: mass_kg,
            allowed: "above 0",
        });
    }
    for point in points {
        let name = (1..)
            .map(|k| format!("accelerometer_{k}"))
            .find(|name| !spec.mass.contains_key(name))
            .unwrap_or_default();
        let mass = Mass {
            on: point.clone(),
            mass_kg,
            rotary_inertia_kg_m2: 0.0,
            stiffness_n_m: None,
            damping_ratio: None,
            velocity_m_s: None,
            friction_n_s_m: None,
        };
        spec.mass.insert(name, mass);
    }
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use jounce_model::linear::{FrfInput, FrfOutput, frf};
    use jounce_model::plant::{Plant, System};
    use jounce_model::structure;
    use jounce_spec::SpecFile;
    use std::f64::consts::TAU;

    const BEAM: &str = "[beam.beam]\nlength = \"300 mm\"\nwidth = \"20 mm\"\nthickness = \"2 mm\"\nyoungs_modulus = \"70 GPa\"\n\
        density = \"2700 kg/m^3\"\n[reduction]\nmodes = 3\n[damping]\nratios = [0.01, 0.01, 0.01]\n";
    const PATCH: &str = "[patch.p]\non = \"beam\"\nstart = \"5 mm\"\nlength = \"50 mm\"\nwidth = \"20 mm\"\nthickness = \"0.3 mm\"\n\
        youngs_modulus = \"30 GPa\"\ndensity = \"5400 kg/m^3\"\nd31 = \"-170 pC/N\"\ncapacitance = \"100 nF\"\n\
        [circuit.load]\npatch = \"p\"\nresistance = \"1 Mohm\"\n[reduction]\nmodes = 1\n[damping]\nratios = [0.01]\n";

    fn plant(spec: &Spec) -> Plant {
        Plant::new(System::assemble(spec, structure::modes(spec).unwrap()).unwrap()).unwrap()
    }

    /// One mode: patch, cable and load form a divider, which gives the ratio of voltage to
    /// displacement, at every frequency. Measured 1e-12.
    #[test]
    fn cable_lowers_the_voltage_as_a_divider() {
        let unloaded =
            SpecFile::from_text(&(BEAM.split("[reduction]").next().unwrap().to_owned() + PATCH))
                .spec()
                .unwrap();
        let mut wired = unloaded.clone();
        Cable {
            capacitance_f: 60e-9,
            leakage_ohm: Some(2e6),
        }
        .wire(&mut wired)
        .unwrap();
        let hz: Vec<f64> = (1..60).map(f64::from).collect();
        let responses = [
            FrfOutput::Voltage("p".to_owned()),
            FrfOutput::Displacement("beam.end".to_owned()),
        ];
        let per_metre = |spec: &Spec| {
            let result = frf(
                &plant(spec),
                &FrfInput::Force("beam.end".to_owned()),
                &responses,
                &hz,
            )
            .unwrap();
            result[0]
                .value
                .iter()
                .zip(&result[1].value)
                .map(|(v, x)| v / x)
                .collect::<Vec<_>>()
        };
        // The charge per metre is equal; only the admittance differs.
        let admittance =
            |w: f64, farad: f64, siemens: f64| jounce_linalg::c64::new(siemens, w * farad);
        for ((f, unloaded), wired) in hz.iter().zip(per_metre(&unloaded)).zip(per_metre(&wired)) {
            let w = TAU * f;
            let expected = admittance(w, 100e-9, 1e-6) / admittance(w, 160e-9, 1e-6 + 0.5e-6);
            assert!(
                (wired / unloaded / expected - 1.0).norm() < 1e-9,
                "{f} Hz: {}",
                wired / unloaded / expected
            );
        }
    }

    /// A cantilever with a mass m at its end, a = m / (rho A L): `1 + cos l cosh l + a l (cos l
    /// sinh l - sin l cosh l) = 0`, frequencies as `l^2`. Measured 2e-15 for the first three.
    #[test]
    fn an_accelerometer_lowers_the_frequencies_as_a_tip_mass_does() {
        let unloaded = SpecFile::from_text(BEAM).spec().unwrap();
        let mut loaded = unloaded.clone();
        add_accelerometers(&mut loaded, &["beam.end".to_owned()], 5e-3).unwrap();
        let mass_ratio = 5e-3 / (2700.0 * 0.3 * 0.02 * 0.002);
        let root = |a: f64, from: f64, to: f64| {
            let f = |l: f64| {
                1.0 + l.cos() * l.cosh() + a * l * (l.cos() * l.sinh() - l.sin() * l.cosh())
            };
            let (mut low, mut high) = (from, to);
            for _ in 0..200 {
                let centre = 0.5 * (low + high);
                if f(low) * f(centre) <= 0.0 {
                    high = centre
                } else {
                    low = centre
                }
            }
            low
        };
        let ratio = |k: usize| {
            let w = |spec: &Spec| structure::modes(spec).unwrap().frequency_rad_s[k];
            w(&loaded) / w(&unloaded)
        };
        for (k, (from, to)) in [(1.2, 2.0), (3.7, 4.75), (6.5, 7.9)]
            .into_iter()
            .enumerate()
        {
            let expected = (root(mass_ratio, from, to) / root(0.0, from, to)).powi(2);
            eprintln!(
                "mode {}: {:.6} of the bare one, {:.1e} off",
                k + 1,
                expected,
                ratio(k) / expected - 1.0
            );
            assert!(
                (ratio(k) / expected - 1.0).abs() < 1e-9,
                "{k}: {} {expected}",
                ratio(k)
            );
        }
    }

    #[test]
    fn impossible_instruments_are_errors() {
        let mut spec = SpecFile::from_text(BEAM).spec().unwrap();
        assert!(matches!(
            Cable {
                capacitance_f: -1.0,
                leakage_ohm: None
            }
            .wire(&mut spec),
            Err(RigError::Setting { .. })
        ));
        assert!(matches!(
            Cable {
                capacitance_f: 0.0,
                leakage_ohm: Some(0.0)
            }
            .wire(&mut spec),
            Err(RigError::Setting { .. })
        ));
        assert!(matches!(
            add_accelerometers(&mut spec, &[], f64::NAN),
            Err(RigError::Setting { .. })
        ));
    }
}

//! Limits of the model that a run exceeds: points of a force table, modes that a contact needs,
//! thickness of a beam, a plate, a composite or a thin skin, damping ratios of modes that are not
//! retained.

use super::{RunResult, Warning};
use jounce_dynamics::Kernel;
use jounce_model::plant::Plant;
use jounce_spec::{Plate, Section, Spec, StopLaw, material};
use std::f64::consts::{PI, TAU};

/// Highest retained frequency times the contact duration below which the modes do not resolve a
/// contact: the spectrum of a half-sine pulse of duration `T`, `cos(pi f T) / (1 - (2 f T)^2)`, has
/// its first zero at `f T = 3 / 2`.
///
/// Source: W. G. Halvorsen, D. L. Brown, Impulse technique for structural frequency response testing,
/// Sound and Vibration 11 (1977) 8.
const LEAST_FREQUENCY_TIME: f64 = 1.5;

/// Error of the first frequency of a beam, and of the highest retained one of a plate, above which the
/// theory of thin beams and plates is not accurate.
const MAX_SHEAR_ERROR: f64 = 0.02;

/// Relative difference below which two thicknesses are equal.
const THICKNESS_ROUNDOFF: f64 = 1e-9;

/// Shear correction factor of a homogeneous plate (Mindlin).
const SHEAR_FACTOR: f64 = PI * PI / 12.0;

/// Wave number of the first mode of a cantilever times its length.
const CANTILEVER_ROOT: f64 = 1.875_104;

/// `E / (kappa G)` of a rectangular section with a Poisson's ratio of 0.3.
///
/// Source: G. R. Cowper, The shear coefficient in Timoshenko's beam theory, J. Appl. Mech. 33 (1966)
/// 335.
const BEAM_SHEAR: f64 = 2.6 * (12.0 + 11.0 * 0.3) / (10.0 * 1.3);

/// Returns the warnings of the limits that contacts exceed.
pub(super) fn of_contacts(spec: &Spec, kernel: &Kernel, result: &RunResult) -> Vec<Warning> {
    let mut warnings = passed_tables(spec, result);
    warnings.extend(short_contacts(spec, highest_hz(&kernel.plant), result));
    warnings
}

/// Returns the warnings of the limits that the model exceeds.
pub(super) fn of_model(spec: &Spec, plant: &Plant) -> Vec<Warning> {
    let mut warnings = thick_beams(spec);
    warnings.extend(thick_plates(spec, highest_hz(plant)));
    warnings.extend(composites(spec));
    warnings.extend(thick_skins(spec));
    warnings.extend(unused_ratios(spec, plant));
    warnings
}

/// Highest retained frequency, Hz.
fn highest_hz(plant: &Plant) -> f64 {
    let rad_s = &plant.system.modes.frequency_rad_s;
    rad_s.iter().copied().fold(0.0, f64::max) / TAU
}

/// Tables whose last point the contact passed.
fn passed_tables(spec: &Spec, result: &RunResult) -> Vec<Warning> {
    let passed = result.stops.iter().filter_map(|of| {
        let stop = spec.stop.get(&of.name)?;
        let last_m = stop.table.penetration_m.last().copied()?;
        let is_past = matches!(stop.law, StopLaw::Table { .. }) && of.max_penetration_m > last_m;
        is_past.then(|| Warning::PastTable {
            stop: of.name.clone(),
            penetration_m: of.max_penetration_m,
            last_m,
        })
    });
    passed.collect()
}

/// Stops on beams and plates whose contacts are too short for the retained modes. Masses and
/// structures given by modes have no further ones; the impacts of rigid stops have no duration.
fn short_contacts(spec: &Spec, highest_hz: f64, result: &RunResult) -> Vec<Warning> {
    let deformed = result.stops.iter().filter(|of| !of.is_rigid);
    let short = deformed.filter_map(|of| {
        let stop = spec.stop.get(&of.name)?;
        let is_flexible = [&stop.at, &stop.frame].iter().any(|place| {
            let body = place.split('.').next().unwrap_or_default();
            spec.beam.contains_key(body) || spec.plate.contains_key(body)
        });
        let duration_s = of.mean_contact_duration_s;
        let needed_hz = LEAST_FREQUENCY_TIME / duration_s;
        (is_flexible && duration_s > 0.0 && highest_hz < needed_hz).then(|| Warning::ShortContact {
            stop: of.name.clone(),
            duration_s,
            highest_hz,
            needed_hz,
        })
    });
    short.collect()
}

/// Beams whose thickness is not small against their length. To the first order in `(h / L)^2`, shear and
/// rotary inertia lower the frequency of a wave by the share below; its wave number `k` is that of the
/// first mode of a cantilever.
///
/// ```text
/// (k h)^2 / 24 (1 + E / (kappa G)),   k L = 1.8751
/// ```
///
/// Source: S. P. Timoshenko, On the correction for shear of the differential equation for transverse
/// vibrations of prismatic bars, Phil. Mag. 41 (1921) 744.
fn thick_beams(spec: &Spec) -> Vec<Warning> {
    let thick = spec.beam.iter().filter_map(|(name, beam)| {
        let ratio = CANTILEVER_ROOT * beam.thickness_m / beam.length_m;
        let error = ratio * ratio / 24.0 * (1.0 + BEAM_SHEAR);
        (error > MAX_SHEAR_ERROR).then(|| Warning::ThickBeam {
            beam: name.clone(),
            length_m: beam.length_m,
            thickness_m: beam.thickness_m,
            error,
        })
    });
    thick.collect()
}

/// Plates whose thickness is not small against the half-wavelength of the highest retained mode.
fn thick_plates(spec: &Spec, highest_hz: f64) -> Vec<Warning> {
    let thick = spec.plate.iter().filter_map(|(name, plate)| {
        let half_wavelength_m = half_wavelength_m(plate, highest_hz);
        let error = shear_error(plate, half_wavelength_m);
        (error > MAX_SHEAR_ERROR).then(|| Warning::ThickPlate {
            plate: name.clone(),
            thickness_m: plate.thickness_m,
            half_wavelength_m,
            error,
        })
    });
    thick.collect()
}

/// Patches of a library composite with another thickness than the product, whose constants are those of
/// its fibres and foils together.
fn composites(spec: &Spec) -> Vec<Warning> {
    let other = spec.patch.iter().filter_map(|(name, patch)| {
        let product_m = material::product_thickness_m(&patch.material)?;
        let difference = (patch.thickness_m / product_m - 1.0).abs();
        (difference > THICKNESS_ROUNDOFF).then(|| Warning::CompositeThickness {
            patch: name.clone(),
            material: patch.material.clone(),
            thickness_m: patch.thickness_m,
            product_m,
        })
    });
    other.collect()
}

/// Patches of the section `thin-skin` that are thicker than their beam. With a laminate any ratio of
/// thicknesses is allowed: the ceramic of a bimorph is often thicker than its shim.
fn thick_skins(spec: &Spec) -> Vec<Warning> {
    let thick = spec.patch.iter().filter_map(|(name, patch)| {
        let beam = spec.beam.get(&patch.on)?;
        let is_thick = patch.section == Section::ThinSkin && patch.thickness_m > beam.thickness_m;
        is_thick.then(|| Warning::ThickSkin {
            patch: name.clone(),
            thickness_m: patch.thickness_m,
            beam_thickness_m: beam.thickness_m,
        })
    });
    thick.collect()
}

/// Damping ratios that no retained mode takes.
fn unused_ratios(spec: &Spec, plant: &Plant) -> Option<Warning> {
    let listed = spec.damping.ratios.len();
    let unused = plant.system.modes.unused_damping_ratios;
    (unused > 0).then(|| Warning::UnusedRatios {
        listed,
        used: listed - unused,
    })
}

/// Half the length of a straight wave of a frequency on a thin plate, m.
fn half_wavelength_m(plate: &Plate, frequency_hz: f64) -> f64 {
    let stiffness_n_m = plate.youngs_modulus_pa * plate.thickness_m.powi(3)
        / (12.0 * (1.0 - plate.poisson_ratio * plate.poisson_ratio));
    let mass_kg_m2 = plate.density_kg_m3 * plate.thickness_m;
    PI / (TAU * frequency_hz * (mass_kg_m2 / stiffness_n_m).sqrt()).sqrt()
}

/// Relative error of the frequency of a thin plate due to shear and rotary inertia, for this
/// half-wavelength `l`, to the first order in `(h / l)^2`:
///
/// ```text
/// pi^2 / 24 (h / l)^2 (1 + 2 / (kappa (1 - nu)))
/// ```
///
/// Source: R. D. Mindlin, Influence of rotatory inertia and shear on flexural motions of isotropic,
/// elastic plates, J. Appl. Mech. 18 (1951) 31.
fn shear_error(plate: &Plate, half_wavelength_m: f64) -> f64 {
    let ratio = plate.thickness_m / half_wavelength_m;
    let shear = 2.0 / (SHEAR_FACTOR * (1.0 - plate.poisson_ratio));
    PI * PI / 24.0 * ratio * ratio * (1.0 + shear)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use jounce_spec::starter::Starter;

    /// The first order against the exact frequency of a simply supported plate by Mindlin's theory,
    /// `w^2` from `(1 - I w^2 / G) (D k^2 - I w^2 + G) ...`, here the lower root of its quadratic.
    #[test]
    fn shear_error_is_that_of_mindlin() {
        let spec = Spec::from_toml(Starter::of("plate-with-stop").unwrap().spec).unwrap();
        let plate = spec.plate.values().next().unwrap();
        let (h, nu) = (plate.thickness_m, plate.poisson_ratio);
        let (modulus, density) = (plate.youngs_modulus_pa, plate.density_kg_m3);
        let stiffness = modulus * h.powi(3) / (12.0 * (1.0 - nu * nu));
        let shear = SHEAR_FACTOR * modulus * h / (2.0 * (1.0 + nu));
        let [mass, inertia] = [density * h, density * h.powi(3) / 12.0];
        for slenderness in [10.0, 20.0, 40.0] {
            let k2 = (PI / (slenderness * h)).powi(2);
            // (D k^2 + G - I w^2) (G k^2 - m w^2) = G^2 k^2
            let a = inertia * mass;
            let b = (stiffness * k2 + shear) * mass + inertia * shear * k2;
            let c = stiffness * shear * k2 * k2;
            let square = 2.0 * c / (b + (b * b - 4.0 * a * c).sqrt());
            let thin = k2 * (stiffness / mass).sqrt();
            let exact = thin / square.sqrt() - 1.0;
            let found = shear_error(plate, slenderness * h);
            // The next term is of the order of the square of the error.
            assert!(
                (found - exact).abs() < 3.0 * exact * exact,
                "{found:e} {exact:e}"
            );
            let hertz = thin / TAU;
            assert!((half_wavelength_m(plate, hertz) / (slenderness * h) - 1.0).abs() < 1e-12);
        }
    }
}

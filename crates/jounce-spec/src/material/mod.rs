//! Materials with their sources, reduced to the constants of a slender beam.
//!
//! A narrow beam carries only axial stress. A ceramic of compliance `s11E` (1/Pa), charge
//! coefficient `d31` (C/N) and permittivity `eps33T` (F/m) at constant stress then has
//!
//! ```text
//! Y = 1 / s11E,      e31bar = d31 / s11E,      eps33bar = eps33T - d31^2 / s11E
//! ```
//!
//! with the modulus at short circuit `Y` (Pa), the charge per strain `e31bar` (C/m^2) and the
//! permittivity at constant strain `eps33bar` (F/m). Source: Erturk and Inman, Piezoelectric Energy
//! Harvesting (2011), appendix A.

mod electroelastic;
mod hill;
mod library;
pub mod porous;

pub use library::{CONTACT, LIBRARY, PIEZOELECTRIC, STRUCTURAL};

/// Permittivity of vacuum, F/m (CODATA 2018).
pub const VACUUM_PERMITTIVITY_F_M: f64 = 8.854_187_812_8e-12;

/// Material of the library.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Material {
    /// Name in a spec.
    pub name: &'static str,
    /// Young's modulus along the beam, at short circuit, Pa.
    pub youngs_modulus_pa: f64,
    /// Poisson's ratio of an isotropic material, for contacts.
    pub poisson_ratio: Option<f64>,
    /// Density, kg/m^3.
    pub density_kg_m3: f64,
    /// Yield strength of a metal, from its softest to its hardest common temper, Pa.
    pub yield_strength_pa: Option<[f64; 2]>,
    /// Largest recommended strain along the beam, dimensionless.
    pub strain_limit: Option<f64>,
    /// Lowest and highest allowed voltage, V.
    pub voltage_limits_v: Option<[f64; 2]>,
    /// Piezoelectric constants, for a piezoelectric material.
    pub active: Option<Active>,
    /// Source of the numbers.
    pub source: &'static str,
}

/// Piezoelectric constants of a material.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Active {
    /// Strain along the beam per field, m/V: `d31` for a field through the thickness, `d33` for a
    /// field along the beam.
    pub charge_coefficient_m_per_v: f64,
    /// Permittivity at constant strain of the layer as a plate capacitor, F/m.
    pub permittivity_f_m: f64,
    /// Distance between interdigitated electrodes, m; `None` for electrodes on the two faces.
    pub electrode_spacing_m: Option<f64>,
    /// Poisson's ratio in the plane of the patch at short circuit, `-s12E / s11E`, for plates;
    /// `None` where it is not known.
    pub in_plane_poisson_ratio: Option<f64>,
}

/// Constants of a fibre composite across its fibres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Across {
    /// Young's modulus `E2` at short circuit, Pa.
    pub youngs_modulus_pa: f64,
    /// Shear modulus `G12` in the plane, Pa.
    pub shear_modulus_pa: f64,
}

/// Piezoelectric ceramic or film with electrodes on its two faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ceramic {
    /// `s11E`, compliance along the beam at constant field, 1/Pa.
    pub compliance_per_pa: f64,
    /// `d31`, m/V.
    pub d31_m_per_v: f64,
    /// `eps33T / eps0`, relative permittivity at constant stress.
    pub relative_permittivity: f64,
}

impl Ceramic {
    /// Returns `Y = 1 / s11E`, Pa.
    pub const fn youngs_modulus_pa(&self) -> f64 {
        1.0 / self.compliance_per_pa
    }

    /// Returns `eps33bar = eps33T - d31^2 / s11E`, F/m.
    pub const fn clamped_permittivity_f_m(&self) -> f64 {
        self.relative_permittivity * VACUUM_PERMITTIVITY_F_M
            - self.d31_m_per_v * self.d31_m_per_v / self.compliance_per_pa
    }
}

/// Returns the material with a name.
pub fn named(name: &str) -> Option<&'static Material> {
    LIBRARY.iter().find(|material| material.name == name)
}

/// Returns the constants of a library composite across its fibres; `None` for any other material.
pub fn across_fibres(name: &str) -> Option<Across> {
    let known = library::ACROSS.iter().find(|(known, _)| *known == name);
    known.map(|(_, across)| *across)
}

/// Returns the thickness to which the constants of a library composite apply, m; `None` for any other
/// material.
pub fn product_thickness_m(name: &str) -> Option<f64> {
    across_fibres(name).map(|_| library::MFC_THICKNESS_M)
}

/// Returns all electroelastic constants of a library material, if known; they are the basis of a
/// porous material. Their beam constants differ slightly from [`named`], which uses another source.
pub fn full_constants(name: &str) -> Option<electroelastic::Electroelastic> {
    (name == "PZT-5A").then_some(electroelastic::PZT_5A)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn the_words_of_a_spec_are_the_library() {
        let active = |is_active: bool| {
            LIBRARY
                .iter()
                .filter(move |material| material.active.is_some() == is_active)
                .map(|material| material.name)
        };
        assert!(active(true).eq(PIEZOELECTRIC.iter().copied()));
        assert!(active(false).eq(STRUCTURAL.iter().copied()));
        let isotropic = LIBRARY
            .iter()
            .filter(|material| material.poisson_ratio.is_some());
        assert!(isotropic.clone().all(|material| {
            material
                .yield_strength_pa
                .is_some_and(|[low, high]| low < high)
        }));
        assert!(
            isotropic
                .map(|material| material.name)
                .eq(CONTACT.iter().copied())
        );
    }

    /// Erturk and Inman (2011), table E.2, thin beams: 61.0 and 60.6 GPa, -10.4 and -16.6 C/m^2,
    /// 13.3 and 25.55 nF/m, as printed.
    #[test]
    fn ceramics_reduce_to_the_published_beam_constants() {
        for (name, modulus_gpa, charge_c_m2, permittivity_nf_m) in [
            ("PZT-5A", 61.0, -10.4, 13.3),
            ("PZT-5H", 60.6, -16.6, 25.55),
        ] {
            let material = named(name).unwrap();
            let active = material.active.unwrap();
            assert!(
                (material.youngs_modulus_pa / 1e9 - modulus_gpa).abs() < 0.05,
                "{name}"
            );
            let charge = active.charge_coefficient_m_per_v * material.youngs_modulus_pa;
            assert!((charge - charge_c_m2).abs() < 0.05, "{name}: {charge}");
            assert!(
                (active.permittivity_f_m * 1e9 - permittivity_nf_m).abs() < 0.05,
                "{name}: {}",
                active.permittivity_f_m
            );
        }
    }
}

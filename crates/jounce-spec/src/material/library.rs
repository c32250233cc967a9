//! Material data: one entry for each material, with its source.

use super::{Across, Active, Ceramic, Material};

/// Names of the patch materials in a spec.
pub const PIEZOELECTRIC: &[&str] = &["PZT-5A", "PZT-5H", "PSI-5A4E", "PVDF", "MFC-P1", "MFC-P2"];

/// Names of the beam materials in a spec.
pub const STRUCTURAL: &[&str] = &["aluminium", "steel", "brass", "bronze", "silicon"];

/// Names of the materials of contacts in a spec: isotropic, with Poisson's ratio.
pub const CONTACT: &[&str] = &["aluminium", "steel", "brass", "bronze"];

/// Thickness of a Macro Fiber Composite with its foils, m; the effective constants refer to this
/// thickness.
pub(super) const MFC_THICKNESS_M: f64 = 0.3e-3;

/// `E2`, `G12` of a Macro Fiber Composite (MFC engineering properties); the table gives no
/// coefficient across the fibres.
const MFC_ACROSS: Across = Across {
    youngs_modulus_pa: 15.857e9,
    shear_modulus_pa: 5.515e9,
};

const MFC_SOURCE: &str = "Smart Material Corp., MFC engineering properties (E1, E2, G12, nu12, d31 and d33 at low field, capacitance per area, voltage range, \
     600 ppm recommended for harvesting); constants are those of the whole 0.3 mm; electrode spacing 0.5 mm: Bilgen et al. (2010)";

/// Fibre composites with their constants across the fibres.
pub(super) const ACROSS: &[(&str, Across)] = &[("MFC-P1", MFC_ACROSS), ("MFC-P2", MFC_ACROSS)];

/// All materials.
pub const LIBRARY: &[Material] = &[
    ceramic(
        "PZT-5A",
        Ceramic {
            compliance_per_pa: 16.4e-12,
            d31_m_per_v: -171e-12,
            relative_permittivity: 1700.0,
        },
        Some(5.74 / 16.4),
        7750.0,
        "Jaffe, Cook and Jaffe, Piezoelectric Ceramics (1971); Erturk and Inman, Piezoelectric Energy Harvesting (2011), table E.1",
    ),
    ceramic(
        "PZT-5H",
        Ceramic {
            compliance_per_pa: 16.5e-12,
            d31_m_per_v: -274e-12,
            relative_permittivity: 3400.0,
        },
        Some(4.78 / 16.5),
        7500.0,
        "Jaffe, Cook and Jaffe, Piezoelectric Ceramics (1971); Erturk and Inman, Piezoelectric Energy Harvesting (2011), table E.1",
    ),
    Material {
        name: "PSI-5A4E",
        youngs_modulus_pa: 66e9,
        poisson_ratio: None,
        density_kg_m3: 7800.0,
        yield_strength_pa: None,
        strain_limit: None,
        voltage_limits_v: None,
        active: Some(Active {
            charge_coefficient_m_per_v: -190e-12,
            permittivity_f_m: 1500.0 * super::VACUUM_PERMITTIVITY_F_M,
            electrode_spacing_m: None,
            in_plane_poisson_ratio: None,
        }),
        source: "Piezo Systems Inc. data sheet, as used by Erturk and Inman, Smart Mater. Struct. 18 (2009) 025009; permittivity at constant strain",
    },
    ceramic(
        "PVDF",
        Ceramic {
            compliance_per_pa: 1.0 / 3e9,
            d31_m_per_v: 23e-12,
            relative_permittivity: 12.5,
        },
        None,
        1780.0,
        "TE Connectivity (Measurement Specialties), Piezo Film Sensors Technical Manual: modulus 2 to 4 GPa, d31 23 pC/N, 110 pF/m",
    ),
    Material {
        name: "MFC-P1",
        youngs_modulus_pa: 30.336e9,
        poisson_ratio: None,
        density_kg_m3: 5440.0,
        yield_strength_pa: None,
        strain_limit: Some(600e-6),
        voltage_limits_v: Some([-500.0, 1500.0]),
        active: Some(Active {
            charge_coefficient_m_per_v: 400e-12,
            permittivity_f_m: 0.30e-5 * MFC_THICKNESS_M,
            electrode_spacing_m: Some(0.5e-3),
            in_plane_poisson_ratio: Some(0.31),
        }),
        source: MFC_SOURCE,
    },
    Material {
        name: "MFC-P2",
        youngs_modulus_pa: 30.336e9,
        poisson_ratio: None,
        density_kg_m3: 5440.0,
        yield_strength_pa: None,
        strain_limit: Some(600e-6),
        voltage_limits_v: Some([-60.0, 360.0]),
        active: Some(Active {
            charge_coefficient_m_per_v: -170e-12,
            permittivity_f_m: 7.8e-5 * MFC_THICKNESS_M,
            electrode_spacing_m: None,
            in_plane_poisson_ratio: Some(0.31),
        }),
        source: MFC_SOURCE,
    },
    structural(
        "aluminium",
        70e9,
        Some(0.33),
        2700.0,
        Some([55e6, 275e6]),
        "nominal; ASM Handbook vol. 2 (6061: 69 GPa, 0.33, 2700 kg/m^3; yield strength of tempers O to T6)",
    ),
    structural(
        "steel",
        200e9,
        Some(0.29),
        7850.0,
        Some([170e6, 580e6]),
        "nominal; ASM Handbook vol. 1 (carbon steel); Poisson's ratio: Kaye and Laby, Tables of Physical and Chemical Constants, 2.2.2; \
         yield strength (hot-rolled 1006 to cold-drawn 1050): SAE Handbook (1986), p. 2.15",
    ),
    structural(
        "brass",
        110e9,
        Some(0.35),
        8530.0,
        Some([75e6, 435e6]),
        "nominal; ASM Handbook vol. 2 (C26000); Poisson's ratio (70 Cu, 30 Zn): Kaye and Laby, Tables of Physical and Chemical Constants, 2.2.2; \
         yield strength (annealed to hard): Copper Development Association",
    ),
    structural(
        "bronze",
        110e9,
        Some(0.34),
        8860.0,
        Some([130e6, 550e6]),
        "nominal; ASM Handbook vol. 2 (phosphor bronze C51000; 0.34); yield strength (annealed to hard): Copper Development Association",
    ),
    structural(
        "silicon",
        169e9,
        None,
        2329.0,
        None,
        "beam along <110>; Hopcroft, Nix and Kenny, J. Microelectromech. Syst. 19 (2010) 229",
    ),
];

const fn ceramic(
    name: &'static str,
    ceramic: Ceramic,
    in_plane_poisson_ratio: Option<f64>,
    density_kg_m3: f64,
    source: &'static str,
) -> Material {
    Material {
        name,
        youngs_modulus_pa: ceramic.youngs_modulus_pa(),
        poisson_ratio: None,
        density_kg_m3,
        yield_strength_pa: None,
        strain_limit: None,
        voltage_limits_v: None,
        active: Some(Active {
            charge_coefficient_m_per_v: ceramic.d31_m_per_v,
            permittivity_f_m: ceramic.clamped_permittivity_f_m(),
            electrode_spacing_m: None,
            in_plane_poisson_ratio,
        }),
        source,
    }
}

const fn structural(
    name: &'static str,
    youngs_modulus_pa: f64,
    poisson_ratio: Option<f64>,
    density_kg_m3: f64,
    yield_strength_pa: Option<[f64; 2]>,
    source: &'static str,
) -> Material {
    Material {
        name,
        youngs_modulus_pa,
        poisson_ratio,
        density_kg_m3,
        yield_strength_pa,
        strain_limit: None,
        voltage_limits_v: None,
        active: None,
        source,
    }
}

//! Harvester of the paper, its parts, and its frequencies by another method.

use jounce_model::structure::Modes;
use jounce_spec::{Beam, Damping, Electrodes, Face, Mass, Patch, Reduction, Section, Spec};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Natural frequencies of the thin-skin harvester by the transfer matrix of its three segments,
/// 40-digit arithmetic, Hz.
pub const ON_TABLE_HZ: [f64; 8] = [
    0.998931832834536,
    8.66905653443684,
    50.26820062707481,
    140.9193366022377,
    278.9234532928412,
    457.647982765851,
    681.9405521799193,
    960.5178221634098,
];
pub const CLAMPED_HZ: [f64; 7] = [
    8.663433852811874,
    50.25778210080092,
    140.9098042609002,
    278.9133338189189,
    457.6372560265866,
    681.9308235339752,
    960.508546783906,
];

pub fn paper_beam(root: &str) -> Beam {
    Beam {
        material: String::new(),
        length_m: 0.315,
        width_m: 0.03,
        thickness_m: 0.98e-3,
        youngs_modulus_pa: 65e9,
        density_kg_m3: 2750.0,
        root: root.into(),
        root_stiffness_n_m_rad: None,
        point: BTreeMap::from([("tip".into(), 0.305), ("hammer".into(), 0.015)]),
    }
}

pub fn paper_patch(section: Section) -> Patch {
    Patch {
        on: "beam".into(),
        face: Face::Top,
        material: String::new(),
        start_m: 0.009,
        length_m: 0.085,
        width_m: 0.03,
        thickness_m: 0.3e-3,
        youngs_modulus_pa: 30.336e9,
        density_kg_m3: 5440.0,
        d31_m_per_v: Some(-170e-12),
        d33_m_per_v: None,
        electrode_spacing_m: None,
        capacitance_f: Some(177e-9),
        permittivity_f_m: None,
        strain_limit: None,
        leakage_ohm: None,
        electrodes: Electrodes::Circuit,
        section,
        pores: Default::default(),
        foils: Default::default(),
        on_plate: Default::default(),
        across: Default::default(),
    }
}

pub fn paper_table() -> Mass {
    sprung_mass("ground", 12.0, 12.0 * TAU * TAU, 0.3)
}

pub fn sprung_mass(on: &str, mass_kg: f64, stiffness_n_m: f64, damping_ratio: f64) -> Mass {
    Mass {
        on: on.into(),
        mass_kg,
        rotary_inertia_kg_m2: 0.0,
        stiffness_n_m: Some(stiffness_n_m),
        damping_ratio: Some(damping_ratio),
        velocity_m_s: None,
        friction_n_s_m: None,
    }
}

pub fn attached_mass(on: &str, mass_kg: f64, rotary_inertia_kg_m2: f64) -> Mass {
    Mass {
        on: on.into(),
        mass_kg,
        rotary_inertia_kg_m2,
        stiffness_n_m: None,
        damping_ratio: None,
        velocity_m_s: None,
        friction_n_s_m: None,
    }
}

/// Structure of `examples/impact-harvester-2019/harvester.toml`.
pub fn paper(section: Section) -> Spec {
    Spec {
        beam: BTreeMap::from([("beam".into(), paper_beam("table"))]),
        patch: BTreeMap::from([("mfc".into(), paper_patch(section))]),
        mass: BTreeMap::from([("table".into(), paper_table())]),
        damping: Damping {
            ratios: vec![
                0.00194, 0.00925, 0.00864, 0.00359, 0.00126, 0.00274, 0.00160,
            ],
            beyond: None,
        },
        ..Spec::default()
    }
}

pub fn bare_cantilever(count: usize) -> Spec {
    Spec {
        beam: BTreeMap::from([("beam".into(), paper_beam("ground"))]),
        damping: Damping {
            ratios: Vec::new(),
            beyond: Some(0.01),
        },
        reduction: Reduction {
            modes: count,
            mesh_tolerance: 1e-9,
        },
        ..Spec::default()
    }
}

pub fn table() -> [String; 1] {
    ["table".to_owned()]
}

pub fn frequency_hz(modes: &Modes) -> Vec<f64> {
    modes
        .frequency_rad_s
        .iter()
        .map(|frequency| frequency / TAU)
        .collect()
}

pub fn greatest_relative_difference(values: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(values.len(), expected.len());
    values
        .iter()
        .zip(expected)
        .map(|(one, other)| ((one - other) / other).abs())
        .fold(0.0, f64::max)
}

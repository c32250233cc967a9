//! `[patch.NAME]`: constants across the fibres of a patch on a plate.

/// Constants that a plate needs of a patch whose two directions differ; not used on a beam.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct AcrossFibres {
    /// `transverse_youngs_modulus` at short circuit, along y of the plate, Pa.
    pub youngs_modulus_pa: Option<f64>,
    /// `shear_modulus` in the plane of the plate, Pa.
    pub shear_modulus_pa: Option<f64>,
    /// `d32`, m/V: strain along y of the plate per field.
    pub d32_m_per_v: Option<f64>,
}

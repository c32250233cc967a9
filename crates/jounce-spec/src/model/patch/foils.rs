//! `[patch.NAME]`: the foils of a composite patch.

/// Kapton HN, Pa: DuPont, Kapton HN data sheet, tensile modulus at 23 degrees C.
const KAPTON_PA: f64 = 2.5e9;
/// Kapton HN, kg/m^3: the same data sheet.
const KAPTON_KG_M3: f64 = 1420.0;
/// Poisson's ratio of Kapton: DuPont, Kapton, table of physical properties (mean of three samples).
const KAPTON_POISSON_RATIO: f64 = 0.34;

/// The two foils that enclose the active layer of a Macro Fiber Composite, with their electrodes.
///
/// ```text
/// foil | active layer of fibres and epoxy, `thickness` | foil | bond, a [layer.NAME] | beam
/// ```
///
/// Electrodes count as part of the foils. Source of the order of layers: Bilgen, Erturk and Inman,
/// J. Vib. Acoust. 132 (2010) 051005.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PatchFoils {
    /// `foil_thickness` of each, m; `None` without foils.
    pub thickness_m: Option<f64>,
    /// `foil_youngs_modulus`, Pa; `None`: that of Kapton.
    pub youngs_modulus_pa: Option<f64>,
    /// `foil_density`, kg/m^3; `None`: that of Kapton.
    pub density_kg_m3: Option<f64>,
    /// `foil_poisson_ratio`, for a patch on a plate; `None`: that of Kapton.
    pub poisson_ratio: Option<f64>,
}

impl PatchFoils {
    /// Returns the thickness of each foil, m; 0 without foils.
    pub fn each_m(&self) -> f64 {
        self.thickness_m.unwrap_or(0.0)
    }

    /// Returns Young's modulus, Pa.
    pub fn modulus_pa(&self) -> f64 {
        self.youngs_modulus_pa.unwrap_or(KAPTON_PA)
    }

    /// Returns the density, kg/m^3.
    pub fn mass_per_volume_kg_m3(&self) -> f64 {
        self.density_kg_m3.unwrap_or(KAPTON_KG_M3)
    }

    /// Returns Poisson's ratio.
    pub fn contraction(&self) -> f64 {
        self.poisson_ratio.unwrap_or(KAPTON_POISSON_RATIO)
    }
}

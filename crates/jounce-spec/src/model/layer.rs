//! `[layer.NAME]`

use crate::material;

use super::{Face, OnPlate, Section};

/// A passive layer on one face of a beam or a plate, under the patches there: a bond line, a shim, a coating.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// `on`: name of the beam or plate.
    pub on: String,
    /// `face`: `"top"` (default) or `"bottom"`.
    pub face: Face,
    /// `material`: library material with default modulus and density; empty if omitted.
    pub material: String,
    /// `start`: distance from the root of the beam or the left edge of the plate, m; default 0.
    pub start_m: f64,
    /// `length`
    pub length_m: f64,
    /// `width`
    pub width_m: f64,
    /// `thickness`
    pub thickness_m: f64,
    /// `youngs_modulus`
    pub youngs_modulus_pa: f64,
    /// `density`; required with `laminate`, not used by `thin-skin`.
    pub density_kg_m3: f64,
    /// `section`; default `laminate`.
    pub section: Section,
    /// `across_start` and `poisson_ratio`: for a layer on a plate.
    pub on_plate: OnPlate,
}

impl Layer {
    /// Returns Poisson's ratio: as given, or that of the material; `None` if neither is known.
    pub fn poisson_ratio(&self) -> Option<f64> {
        let of_material = || material::named(&self.material)?.poisson_ratio;
        self.on_plate.poisson_ratio.or_else(of_material)
    }
}

//! `[layer.NAME]`

use super::{Face, Section};

/// A passive layer on one face of a beam, under the patches there: a bond line, a shim, a coating.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// `on`: name of the beam.
    pub on: String,
    /// `face`: `"top"` (default) or `"bottom"`.
    pub face: Face,
    /// `material`: library material with default modulus and density; empty if omitted.
    pub material: String,
    /// `start`: distance from the root, m; default 0.
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
}

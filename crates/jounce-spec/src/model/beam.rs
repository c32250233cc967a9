//! `[beam.NAME]`

use std::collections::BTreeMap;

/// A uniform beam whose root is clamped to the ground or another base, a mass or a point of another
/// beam. A chain of beams models a stepped beam.
#[derive(Debug, Clone, PartialEq)]
pub struct Beam {
    /// `material`: library material with default modulus and density; empty if omitted.
    pub material: String,
    /// `length`
    pub length_m: f64,
    /// `width`
    pub width_m: f64,
    /// `thickness`
    pub thickness_m: f64,
    /// `youngs_modulus`
    pub youngs_modulus_pa: f64,
    /// `density`
    pub density_kg_m3: f64,
    /// `root`: `"ground"`, another base, the name of a mass, or a point of another beam,
    /// `"arm.end"`; default `"ground"`.
    pub root: String,
    /// `root_stiffness`: rotary stiffness of the clamp at the root, N m/rad. `None`: rigid.
    pub root_stiffness_n_m_rad: Option<f64>,
    /// `[beam.NAME.point]`: distance of named points from the root, m. `NAME.root` and `NAME.end`
    /// always exist.
    pub point: BTreeMap<String, f64>,
}

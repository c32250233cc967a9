//! `[beam.NAME]`

use std::collections::BTreeMap;

/// A uniform beam; its root is clamped to the ground or another base, to a mass or to a point of another beam. A stepped beam is a chain of these.
#[derive(Debug, Clone, PartialEq)]
pub struct Beam {
    /// `material`: a name of the library, which gives modulus and density where they are not given; empty without.
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
    /// `root`: `"ground"`, another base, the name of a mass, or a point of another beam, `"arm.end"`; default `"ground"`.
    pub root: String,
    /// `root_stiffness`: rotary stiffness of the clamp at the root, N m/rad. `None`: rigid.
    pub root_stiffness_n_m_rad: Option<f64>,
    /// `[beam.NAME.point]`: named places along the beam, distance from the root, m. `NAME.root` and `NAME.end` always exist.
    pub point: BTreeMap<String, f64>,
}

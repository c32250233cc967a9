//! `[patch.NAME]`: pores of the material.

use crate::material::porous::{PoreGeometry, PorosityScheme};
use crate::material::{self, VACUUM_PERMITTIVITY_F_M};

/// Porosity of a patch and the related keys.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PatchPores {
    /// `porosity`: volume fraction of pores, 0 to below 1; `None` for the dense material of the
    /// library.
    pub porosity: Option<f64>,
    /// `pore_shape`; default `spheres`.
    pub shape: PoreShape,
    /// `pore_aspect_ratio`: length along the poling direction over width; for spheroids.
    pub aspect_ratio: Option<f64>,
    /// `porosity_scheme`; default `mori-tanaka`.
    pub scheme: PorosityScheme,
    /// Effective constants of the patch; `None` without pores, or if the scheme has no solution.
    pub composite: Option<Composite>,
}

/// Constants of a porous patch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Composite {
    /// Young's modulus at short circuit in the plane of the patch, Pa.
    pub youngs_modulus_pa: f64,
    /// Poisson's ratio at short circuit in the plane of the patch, `-s12E / s11E`.
    pub poisson_ratio: f64,
    /// Density, kg/m^3.
    pub density_kg_m3: f64,
    /// `d31`, m/V.
    pub d31_m_per_v: f64,
    /// Permittivity at constant strain along a beam, of the layer as a plate capacitor, F/m.
    pub permittivity_f_m: f64,
    /// Permittivity at constant stress, F/m.
    pub free_permittivity_f_m: f64,
}

/// Shape of pores aligned with the poling direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PoreShape {
    /// `"spheres"`
    #[default]
    Spheres,
    /// `"spheroids"`, with an aspect ratio.
    Spheroids,
    /// `"cylinders"`, infinitely long.
    Cylinders,
}

impl PatchPores {
    /// Returns the composite of these pores in a library material, for which all constants must be
    /// known (see [`material::full_constants`]).
    pub fn composite_of(&self, name: &str) -> Option<Composite> {
        let porosity = self.porosity?;
        let (dense, material) = (material::full_constants(name)?, material::named(name)?);
        let pores = match self.shape {
            PoreShape::Spheres => PoreGeometry::Spheroids(1.0),
            PoreShape::Spheroids => PoreGeometry::Spheroids(self.aspect_ratio?),
            PoreShape::Cylinders => PoreGeometry::Cylinders,
        };
        let porous = dense.porous(porosity, pores, self.scheme)?;
        let ceramic = porous.ceramic();
        Some(Composite {
            youngs_modulus_pa: ceramic.youngs_modulus_pa(),
            poisson_ratio: porous.in_plane_poisson_ratio(),
            density_kg_m3: (1.0 - porosity) * material.density_kg_m3,
            d31_m_per_v: ceramic.d31_m_per_v,
            permittivity_f_m: ceramic.clamped_permittivity_f_m(),
            free_permittivity_f_m: ceramic.relative_permittivity * VACUUM_PERMITTIVITY_F_M,
        })
    }
}

//! `[patch.NAME]`: the pores of its material.

use crate::material;
use crate::material::porous::{PoreGeometry, Scheme};

/// What `porosity` and the keys beside it say.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PatchPores {
    /// `porosity`: part of the volume that is pores, 0 to below 1; `None` for the material of the library as it is.
    pub porosity: Option<f64>,
    /// `pore_shape`; default `spheres`.
    pub shape: PoreShape,
    /// `pore_aspect_ratio`: length along the pole over width; of spheroids.
    pub aspect_ratio: Option<f64>,
    /// `porosity_scheme`; default `mori-tanaka`.
    pub scheme: PorosityScheme,
    /// What follows for the patch; `None` without pores, or where the scheme has no answer.
    pub composite: Option<Composite>,
}

/// Constants of a porous patch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Composite {
    /// Young's modulus at short circuit along the beam, Pa.
    pub youngs_modulus_pa: f64,
    /// Mass per volume, kg/m^3.
    pub density_kg_m3: f64,
    /// `d31`, m/V.
    pub d31_m_per_v: f64,
    /// Permittivity at constant strain of the layer as a plate capacitor, F/m.
    pub permittivity_f_m: f64,
}

/// Shapes of pores, aligned with the pole.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PoreShape {
    /// `"spheres"`
    #[default]
    Spheres,
    /// `"spheroids"`, with an aspect ratio.
    Spheroids,
    /// `"cylinders"`, endless.
    Cylinders,
}

/// How pores act on each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PorosityScheme {
    /// `"mori-tanaka"`: each pore lies in the mean field of the matrix.
    #[default]
    MoriTanaka,
    /// `"self-consistent"`: each pore lies in the composite.
    SelfConsistent,
}

impl PatchPores {
    /// The composite of these pores in a material of the library, of which all constants must be known (see
    /// [`material::full_constants`]).
    pub fn composite_of(&self, name: &str) -> Option<Composite> {
        let porosity = self.porosity?;
        let (dense, material) = (material::full_constants(name)?, material::named(name)?);
        let pores = match self.shape {
            PoreShape::Spheres => PoreGeometry::Spheroids(1.0),
            PoreShape::Spheroids => PoreGeometry::Spheroids(self.aspect_ratio?),
            PoreShape::Cylinders => PoreGeometry::Cylinders,
        };
        let scheme = match self.scheme {
            PorosityScheme::MoriTanaka => Scheme::MoriTanaka,
            PorosityScheme::SelfConsistent => Scheme::SelfConsistent,
        };
        let ceramic = dense.porous(porosity, pores, scheme)?.ceramic();
        Some(Composite {
            youngs_modulus_pa: ceramic.youngs_modulus_pa(),
            density_kg_m3: (1.0 - porosity) * material.density_kg_m3,
            d31_m_per_v: ceramic.d31_m_per_v,
            permittivity_f_m: ceramic.clamped_permittivity_f_m(),
        })
    }
}

//! `[patch.NAME]`

mod across;
mod electrodes;
mod foils;
mod in_plane;
mod pores;

use super::OnPlate;

pub use across::AcrossFibres;
pub use electrodes::Electrodes;
pub use foils::PatchFoils;
pub use pores::{Composite, PatchPores, PoreShape};

/// Start of the names of the library materials that are fibre composites with their foils.
pub(crate) const FIBRE_COMPOSITE_PREFIX: &str = "MFC-";

/// A piezoelectric patch bonded to one face of a beam or a plate.
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    /// `on`: name of the beam or plate.
    pub on: String,
    /// `face`: `"top"` (default) or `"bottom"`.
    pub face: Face,
    /// `material`: library material that supplies the values omitted here; empty if omitted.
    pub material: String,
    /// `start`: distance from the root of the beam or the left edge of the plate, m.
    pub start_m: f64,
    /// `length`
    pub length_m: f64,
    /// `width`
    pub width_m: f64,
    /// `thickness`; with foils that of the active layer alone.
    pub thickness_m: f64,
    /// `youngs_modulus`
    pub youngs_modulus_pa: f64,
    /// `density`; required with `laminate`; not used by `thin-skin` (the paper neglects the mass of
    /// the patch), default 0 there.
    pub density_kg_m3: f64,
    /// `d31`, m/V: strain along the beam per field through the thickness.
    pub d31_m_per_v: Option<f64>,
    /// `d33`, m/V: strain along the beam per field along it, between electrodes `electrode_spacing`
    /// apart; excludes `d31`.
    pub d33_m_per_v: Option<f64>,
    /// `electrode_spacing`, m; goes with `d33`.
    pub electrode_spacing_m: Option<f64>,
    /// `capacitance`, clamped, F; excludes `permittivity`.
    pub capacitance_f: Option<f64>,
    /// `permittivity` at constant strain of the layer as a plate capacitor, F/m.
    pub permittivity_f_m: Option<f64>,
    /// `leakage_resistance` across the capacitance, ohm; `None` if omitted.
    pub leakage_ohm: Option<f64>,
    /// `electrodes`; by default a circuit names the patch.
    pub electrodes: Electrodes,
    /// `strain_limit`: largest allowed strain, dimensionless: along a beam or the fibres, else the
    /// larger principal strain in the plane of a plate.
    pub strain_limit: Option<f64>,
    /// `section`; default `laminate`.
    pub section: Section,
    /// `porosity`, `pore_shape`, `pore_aspect_ratio`, `porosity_scheme`: the pores of the material.
    pub pores: PatchPores,
    /// `foil_thickness`, `foil_youngs_modulus`, `foil_density`, `foil_poisson_ratio`: foils that
    /// enclose the active layer.
    pub foils: PatchFoils,
    /// `across_start` and `poisson_ratio`: for a patch on a plate.
    pub on_plate: OnPlate,
    /// `transverse_youngs_modulus`, `shear_modulus`, `d32`: for a patch on a plate.
    pub across: AcrossFibres,
}

impl Patch {
    /// Returns the free strain along the beam per volt, 1/V: `d31 / thickness`, or `d33 /
    /// electrode_spacing`; NaN if neither is known.
    pub fn free_strain_per_v(&self) -> f64 {
        let along = self
            .d33_m_per_v
            .zip(self.electrode_spacing_m)
            .map(|(d33, spacing)| d33 / spacing);
        along
            .or(self.d31_m_per_v.map(|d31| d31 / self.thickness_m))
            .unwrap_or(f64::NAN)
    }

    /// Returns the thickness with the foils, m.
    pub fn total_thickness_m(&self) -> f64 {
        self.thickness_m + 2.0 * self.foils.each_m()
    }

    /// Returns the clamped capacitance, F: as given, or `permittivity * width * length /
    /// thickness`; NaN if neither is known.
    pub fn clamped_capacitance_f(&self) -> f64 {
        let plate = || {
            self.permittivity_f_m
                .map(|permittivity| permittivity * self.width_m * self.length_m / self.thickness_m)
        };
        self.capacitance_f.or_else(plate).unwrap_or(f64::NAN)
    }
}

/// Face of a beam that carries a patch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Face {
    /// Face on the side of positive displacement.
    #[default]
    Top,
    /// Face on the side of negative displacement.
    Bottom,
}

/// Model of the beam section with a patch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Section {
    /// `"thin-skin"`: `EI_b + E_p b_p h_p (h/2)^2` about the mid-plane of the beam, without the
    /// mass of the patch (the model of the paper).
    ThinSkin,
    /// `"laminate"`: full section about the shifted neutral axis, with the mass of the patch.
    #[default]
    Laminate,
}

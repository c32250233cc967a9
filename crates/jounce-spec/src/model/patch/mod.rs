//! `[patch.NAME]`

mod electrodes;
mod foils;
mod pores;

use super::OnPlate;
use crate::material;

pub use electrodes::Electrodes;
pub use foils::PatchFoils;
pub use pores::{Composite, PatchPores, PoreShape};

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
    /// `strain_limit`: largest allowed strain along the beam, dimensionless.
    pub strain_limit: Option<f64>,
    /// `section`; default `laminate`.
    pub section: Section,
    /// `porosity`, `pore_shape`, `pore_aspect_ratio`, `porosity_scheme`: the pores of the material.
    pub pores: PatchPores,
    /// `foil_thickness`, `foil_youngs_modulus`, `foil_density`: foils that enclose the active
    /// layer.
    pub foils: PatchFoils,
    /// `across_start` and `poisson_ratio`: for a patch on a plate.
    pub on_plate: OnPlate,
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

    /// Returns Poisson's ratio in the plane of the electrodes: as given, or that of the material;
    /// `None` if neither is known.
    pub fn poisson_ratio(&self) -> Option<f64> {
        let of_material = || {
            material::named(&self.material)?
                .active?
                .in_plane_poisson_ratio
        };
        self.on_plate.poisson_ratio.or_else(of_material)
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

    /// Returns the capacitance at constant strain in both directions of its plane, F: on a plate.
    ///
    /// The library gives the permittivity at constant strain along a beam, `eps33T - d31^2 / s11E`. In
    /// the plane of a plate it is `eps33T - 2 d31^2 E_p / (1 - nu_p)`. A given value is used as it is.
    pub fn clamped_in_plane_capacitance_f(&self) -> f64 {
        let library = material::named(&self.material)
            .and_then(|known| Some((known.youngs_modulus_pa, known.active?)))
            .filter(|(_, active)| Some(active.permittivity_f_m) == self.permittivity_f_m);
        let (Some((modulus_pa, active)), None) = (library, self.capacitance_f) else {
            return self.clamped_capacitance_f();
        };
        let at_constant_stress =
            active.permittivity_f_m + active.charge_coefficient_m_per_v.powi(2) * modulus_pa;
        let (d31, poisson_ratio) = (self.d31_m_per_v, self.poisson_ratio());
        let softened = 2.0 * d31.unwrap_or(f64::NAN).powi(2) * self.youngs_modulus_pa
            / (1.0 - poisson_ratio.unwrap_or(f64::NAN));
        (at_constant_stress - softened) * self.width_m * self.length_m / self.thickness_m
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

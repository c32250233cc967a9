//! `[patch.NAME]`: constants in the plane of a plate.
//!
//! ```text
//! a         = (d31, d32)  or  (d33, d32) h_p / s            free strain per voltage times thickness, m/V
//! e         = Q a                                           force per length and voltage at constant strain, N/(m V)
//! eps_S     = eps_T - a^T Q a                               permittivity at constant strain in both directions, F/m
//! ```
//!
//! with `Q` the stiffness of the [`Lamina`], `h_p` the thickness and `s` the distance between the
//! electrodes. A ceramic poled through its thickness has `d32 = d31` and `e = d31 E / (1 - nu)` in
//! both directions, which equals `e31 - c13 e33 / c33`.

use super::super::Lamina;
use super::{FIBRE_COMPOSITE_PREFIX, Patch};
use crate::material;

impl Patch {
    /// True for a composite of fibres along x: a library composite, interdigitated electrodes, or an
    /// active layer between foils that is no porous ceramic.
    pub fn is_fibre_composite(&self) -> bool {
        let is_between_foils = self.foils.thickness_m.is_some() && self.pores.porosity.is_none();
        self.is_library_composite() || self.d33_m_per_v.is_some() || is_between_foils
    }

    fn is_library_composite(&self) -> bool {
        self.material.starts_with(FIBRE_COMPOSITE_PREFIX)
    }

    /// Returns Poisson's ratio in the plane at short circuit, `nu12` of a fibre composite: as given,
    /// that of the porous ceramic, or that of the material; `None` if none is known.
    pub fn poisson_ratio(&self) -> Option<f64> {
        let of_pores = || self.pores.composite.map(|porous| porous.poisson_ratio);
        let of_material = || {
            let active = material::named(&self.material)?.active?;
            // A ceramic is isotropic around its poling direction, which lies across the plane.
            (self.is_library_composite() || !self.is_fibre_composite())
                .then_some(active.in_plane_poisson_ratio)?
        };
        let given = self.on_plate.poisson_ratio;
        given.or_else(of_pores).or_else(of_material)
    }

    /// Returns Young's modulus along y, Pa: as given, that of the library composite, or that along x
    /// of a ceramic; `None` if none is known.
    pub fn transverse_modulus_pa(&self) -> Option<f64> {
        let of_material = || material::across_fibres(&self.material).map(|of| of.youngs_modulus_pa);
        let isotropic = || (!self.is_fibre_composite()).then_some(self.youngs_modulus_pa);
        let given = self.across.youngs_modulus_pa;
        given.or_else(of_material).or_else(isotropic)
    }

    /// Returns the shear modulus in the plane, Pa: as given, that of the library composite, or that
    /// of an isotropic ceramic; `None` if none is known.
    pub fn shear_modulus_pa(&self) -> Option<f64> {
        let of_material = || material::across_fibres(&self.material).map(|of| of.shear_modulus_pa);
        let is_isotropic = !self.is_fibre_composite() && self.across.youngs_modulus_pa.is_none();
        let isotropic = || {
            let poisson_ratio = self.poisson_ratio().filter(|_| is_isotropic)?;
            Some(Lamina::isotropic(self.youngs_modulus_pa, poisson_ratio).shear_modulus_pa)
        };
        let given = self.across.shear_modulus_pa;
        given.or_else(of_material).or_else(isotropic)
    }

    /// Returns the strain along y per field, m/V: as given, or `d31` of a ceramic; `None` if
    /// neither is known.
    pub fn transverse_coefficient_m_per_v(&self) -> Option<f64> {
        let isotropic = self.d31_m_per_v.filter(|_| !self.is_fibre_composite());
        self.across.d32_m_per_v.or(isotropic)
    }

    /// Returns the active layer as a lamina; NaN where a constant is not known.
    pub fn lamina(&self) -> Lamina {
        let known = |value: Option<f64>| value.unwrap_or(f64::NAN);
        Lamina {
            youngs_modulus_pa: [self.youngs_modulus_pa, known(self.transverse_modulus_pa())],
            poisson_ratio: known(self.poisson_ratio()),
            shear_modulus_pa: known(self.shear_modulus_pa()),
        }
    }

    /// Returns `a`: free strain along x and along y per volt, times the thickness, m/V.
    fn free_strain_thickness_m_per_v(&self) -> [f64; 2] {
        let known = |value: Option<f64>| value.unwrap_or(f64::NAN);
        let across_m_per_v = known(self.transverse_coefficient_m_per_v());
        match self.d33_m_per_v.zip(self.electrode_spacing_m) {
            Some((d33, spacing_m)) => {
                [d33, across_m_per_v].map(|d| d * self.thickness_m / spacing_m)
            }
            None => [known(self.d31_m_per_v), across_m_per_v],
        }
    }

    /// Returns `e = Q a`: force per length along x and along y per volt at constant strain, N/(m V).
    pub fn blocked_force_n_m_v(&self) -> [f64; 2] {
        let [q11, q12, q22] = self.lamina().normal_stiffness_pa();
        let [x, y] = self.free_strain_thickness_m_per_v();
        [q11 * x + q12 * y, q12 * x + q22 * y]
    }

    /// Returns the capacitance at constant strain in both directions of its plane, F: on a plate.
    ///
    /// The library and the schemes of porous ceramics give the permittivity at constant strain along
    /// a beam; that at constant stress follows from it. A value given in the spec is used as it is,
    /// as is the capacitance per area that the data sheet of a library composite states.
    pub fn clamped_in_plane_capacitance_f(&self) -> f64 {
        let Some(at_constant_stress) = self.free_permittivity_f_m() else {
            return self.clamped_capacitance_f();
        };
        let (force, free) = (
            self.blocked_force_n_m_v(),
            self.free_strain_thickness_m_per_v(),
        );
        let softened = force[0] * free[0] + force[1] * free[1];
        (at_constant_stress - softened) * self.width_m * self.length_m / self.thickness_m
    }

    /// Returns `eps33T` of the material, F/m, if the permittivity of the patch is that of its
    /// material.
    fn free_permittivity_f_m(&self) -> Option<f64> {
        if self.capacitance_f.is_some() || self.is_library_composite() {
            return None;
        }
        if let Some(porous) = self.pores.composite {
            return (self.permittivity_f_m == Some(porous.permittivity_f_m))
                .then_some(porous.free_permittivity_f_m);
        }
        let known = material::named(&self.material)?;
        let active = known.active?;
        let coefficient = active.charge_coefficient_m_per_v;
        (self.permittivity_f_m == Some(active.permittivity_f_m)).then_some(
            active.permittivity_f_m + coefficient * coefficient * known.youngs_modulus_pa,
        )
    }
}

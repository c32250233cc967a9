//! Electroelastic constants of a poled material, and derived constants.

use super::{Ceramic, VACUUM_PERMITTIVITY_F_M};
use jounce_linalg::{Mat, inverse};

/// Electroelastic constants of a material poled along axis 3, isotropic around it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Electroelastic {
    /// Stiffness `C11` at constant electric field, as all stiffnesses, Pa.
    pub c11_pa: f64,
    /// Stiffness `C12`, Pa.
    pub c12_pa: f64,
    /// Stiffness `C13`, Pa.
    pub c13_pa: f64,
    /// Stiffness `C33`, Pa.
    pub c33_pa: f64,
    /// Stiffness `C44`, Pa.
    pub c44_pa: f64,
    /// Charge per strain `e31`, C/m^2.
    pub e31_c_m2: f64,
    /// Charge per strain `e33`, C/m^2.
    pub e33_c_m2: f64,
    /// Charge per strain `e15`, C/m^2.
    pub e15_c_m2: f64,
    /// Permittivity at constant strain, transverse to the poling axis, F/m.
    pub permittivity_11_f_m: f64,
    /// Permittivity at constant strain, along the poling axis, F/m.
    pub permittivity_33_f_m: f64,
}

/// PZT-5A, full constants (handbook values, as used by Dunn and Taya (1993)).
pub const PZT_5A: Electroelastic = Electroelastic {
    c11_pa: 121e9,
    c12_pa: 75.4e9,
    c13_pa: 75.2e9,
    c33_pa: 111e9,
    c44_pa: 21.1e9,
    e31_c_m2: -5.4,
    e33_c_m2: 15.8,
    e15_c_m2: 12.3,
    permittivity_11_f_m: 916.0 * VACUUM_PERMITTIVITY_F_M,
    permittivity_33_f_m: 830.0 * VACUUM_PERMITTIVITY_F_M,
};

impl Electroelastic {
    /// Returns the constants of a patch: compliance along axis 1, `d31`, and relative permittivity
    /// at constant stress.
    pub fn ceramic(&self) -> Ceramic {
        let [d31_m_per_v, _, permittivity_f_m] = self.free();
        let relative_permittivity = permittivity_f_m / VACUUM_PERMITTIVITY_F_M;
        Ceramic {
            compliance_per_pa: self.compliance()[(0, 0)],
            d31_m_per_v,
            relative_permittivity,
        }
    }

    /// Returns Poisson's ratio at short circuit in the plane across the poling axis, `-s12 / s11`.
    pub fn in_plane_poisson_ratio(&self) -> f64 {
        let compliance = self.compliance();
        -compliance[(0, 1)] / compliance[(0, 0)]
    }

    /// Returns `d31` and `d33`, m/V, and the permittivity at constant stress along the poling axis,
    /// F/m: `d = e S`, `kappa_T = kappa + d e^T`.
    pub fn free(&self) -> [f64; 3] {
        let compliance = self.compliance();
        let e3 = [self.e31_c_m2, self.e31_c_m2, self.e33_c_m2];
        let d = |j: usize| (0..3).map(|i| e3[i] * compliance[(i, j)]).sum::<f64>();
        let permittivity = self.permittivity_33_f_m + (0..3).map(|j| d(j) * e3[j]).sum::<f64>();
        [d(0), d(2), permittivity]
    }

    /// Returns the compliance of the three normal strains, 1/Pa.
    fn compliance(&self) -> Mat<f64> {
        let (a, b, c, d) = (self.c11_pa, self.c12_pa, self.c13_pa, self.c33_pa);
        let rows = [[a, b, c], [b, a, c], [c, c, d]];
        inverse(&Mat::from_fn(3, 3, |i, j| rows[i][j]))
    }

    /// Returns the scale of `-E`, V/m, that gives all entries of `L` similar magnitude.
    pub(super) fn field_scale(&self) -> f64 {
        (self.c33_pa / self.permittivity_33_f_m).sqrt()
    }

    pub(super) fn tensor(&self, scale: f64) -> Mat<f64> {
        let mut l = Mat::zeros(9, 9);
        let c66_pa = (self.c11_pa - self.c12_pa) / 2.0;
        let stiffness = [
            (0, 0, self.c11_pa),
            (1, 1, self.c11_pa),
            (0, 1, self.c12_pa),
            (0, 2, self.c13_pa),
            (1, 2, self.c13_pa),
            (2, 2, self.c33_pa),
            (3, 3, self.c44_pa),
            (4, 4, self.c44_pa),
            (5, 5, c66_pa),
        ];
        let coupling = [
            (8, 0, self.e31_c_m2),
            (8, 1, self.e31_c_m2),
            (8, 2, self.e33_c_m2),
            (7, 3, self.e15_c_m2),
            (6, 4, self.e15_c_m2),
        ];
        let permittivity = [
            (6, self.permittivity_11_f_m),
            (7, self.permittivity_11_f_m),
            (8, self.permittivity_33_f_m),
        ];
        let coupling = coupling.map(|(i, j, e)| (i, j, e * scale));
        let permittivity = permittivity.map(|(i, kappa)| (i, i, -kappa * scale * scale));
        for (i, j, value) in stiffness.into_iter().chain(coupling).chain(permittivity) {
            (l[(i, j)], l[(j, i)]) = (value, value);
        }
        l
    }

    pub(super) fn of_tensor(l: &Mat<f64>, scale: f64) -> Self {
        Self {
            c11_pa: l[(0, 0)],
            c12_pa: l[(0, 1)],
            c13_pa: l[(0, 2)],
            c33_pa: l[(2, 2)],
            c44_pa: l[(3, 3)],
            e31_c_m2: l[(8, 0)] / scale,
            e33_c_m2: l[(8, 2)] / scale,
            e15_c_m2: l[(7, 3)] / scale,
            permittivity_11_f_m: -l[(6, 6)] / (scale * scale),
            permittivity_33_f_m: -l[(8, 8)] / (scale * scale),
        }
    }
}

//! Porous piezoelectric composites: effective constants of a matrix with aligned pores.
//!
//! With `Z = (strain, -E)` and `S = (stress, D)` as vectors of nine components, `S = L Z`,
//! `L = [C e^T; e -kappa]`. For a pore in a matrix `L`
//!
//! ```text
//! P     = < B (B^T L B)^-1 B^T >      average over the unit sphere, B(z): gradient of (u, phi) along z, z_i = zeta_i / a_i
//! A     = [1 + P (L_pore - L)]^-1                                                     concentration in a single pore
//! L*    = L + f (L_pore - L) A [(1 - f) 1 + f A]^-1                                   Mori and Tanaka, pore fraction f
//! L*    = [(1 - f) L A_m + f L_pore A_p] [(1 - f) A_m + f A_p]^-1,  A from L* itself  self-consistent
//! ```
//!
//! The poling direction is axis 3. Pores are spheres, spheroids or cylinders along it, with zero
//! stiffness and the permittivity of vacuum.
//!
//! Source: Dunn and Taya, Int. J. Solids Struct. 30 (1993) 161; Martinez-Ayuso et al., Int. J.
//! Solids Struct. 113-114 (2017) 218. Validation: isotropic spheres, closed forms of Mori and
//! Tanaka; cylinders, `d31` and `d33` exactly equal to the matrix values.

use super::VACUUM_PERMITTIVITY_F_M;
pub use super::electroelastic::{Electroelastic, PZT_5A};
use super::hill::hill;
use jounce_linalg::{Mat, inverse};

/// Relative change at which the self-consistent iteration ends, and its largest number of steps.
const SCHEME_TOLERANCE: f64 = 1e-12;
const MAX_SCHEME_STEPS: usize = 500;

/// Shape of the pores.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PoreGeometry {
    /// Spheroids with the ratio of length along the poling direction to width; 1 for spheres.
    Spheroids(f64),
    /// Infinite cylinders along the poling direction.
    Cylinders,
}

/// Homogenisation scheme: the interaction of the pores.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PorosityScheme {
    /// `"mori-tanaka"`: each pore lies in the mean field of the matrix.
    #[default]
    MoriTanaka,
    /// `"self-consistent"`: each pore lies in the effective composite.
    SelfConsistent,
}

impl Electroelastic {
    /// Returns the composite with a pore fraction `porosity` (0 to below 1); `None` outside this
    /// range, or if the iteration does not converge (above the fraction of zero predicted
    /// stiffness).
    pub fn porous(
        &self,
        porosity: f64,
        pores: PoreGeometry,
        scheme: PorosityScheme,
    ) -> Option<Self> {
        if !(0.0..1.0).contains(&porosity) {
            return None;
        }
        let scale = self.field_scale();
        let matrix = self.tensor(scale);
        let mut pore = Mat::zeros(9, 9);
        (6..9).for_each(|i| pore[(i, i)] = -VACUUM_PERMITTIVITY_F_M * scale * scale);
        let one = Mat::<f64>::identity(9, 9);
        let effective = match scheme {
            PorosityScheme::MoriTanaka => {
                let difference = &pore - &matrix;
                let single = inverse(&(&one + hill(&matrix, pores) * &difference));
                let mean = inverse(&(&one * (1.0 - porosity) + &single * porosity));
                &matrix + &difference * &single * &mean * porosity
            }
            PorosityScheme::SelfConsistent => self_consistent(&matrix, &pore, porosity, pores)?,
        };
        Some(Self::of_tensor(&effective, scale))
    }
}

/// Computes the fixed point of the self-consistent equations, with half steps.
fn self_consistent(
    matrix: &Mat<f64>,
    pore: &Mat<f64>,
    porosity: f64,
    pores: PoreGeometry,
) -> Option<Mat<f64>> {
    let one = Mat::<f64>::identity(9, 9);
    let mut effective = matrix.clone();
    for _ in 0..MAX_SCHEME_STEPS {
        let hill = hill(&effective, pores);
        let concentration = |phase: &Mat<f64>| inverse(&(&one + &hill * (phase - &effective)));
        let (in_matrix, in_pore) = (
            concentration(matrix) * (1.0 - porosity),
            concentration(pore) * porosity,
        );
        let next = (matrix * &in_matrix + pore * &in_pore) * inverse(&(&in_matrix + &in_pore));
        let change = (&next - &effective).amax();
        effective = (&effective + &next) * 0.5;
        if !effective.amax().is_finite() || effective[(2, 2)] <= 1e-6 * matrix[(2, 2)] {
            return None;
        }
        if change <= SCHEME_TOLERANCE * effective.amax() {
            return Some(effective);
        }
    }
    None
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn isotropic(bulk_pa: f64, shear_pa: f64, relative_permittivity: f64) -> Electroelastic {
        let (c11_pa, c12_pa) = (
            bulk_pa + 4.0 / 3.0 * shear_pa,
            bulk_pa - 2.0 / 3.0 * shear_pa,
        );
        let permittivity = relative_permittivity * VACUUM_PERMITTIVITY_F_M;
        Electroelastic {
            c11_pa,
            c12_pa,
            c13_pa: c12_pa,
            c33_pa: c11_pa,
            c44_pa: shear_pa,
            e31_c_m2: 0.0,
            e33_c_m2: 0.0,
            e15_c_m2: 0.0,
            permittivity_11_f_m: permittivity,
            permittivity_33_f_m: permittivity,
        }
    }

    /// `K* = K (1 - f (3K + 4G) / (3K + 4G - 3 (1 - f) K))`, likewise `G*`; Maxwell-Garnett for the
    /// permittivity. Measured 4e-15.
    #[test]
    fn spherical_pores_in_an_isotropic_matrix_have_closed_forms() {
        let (k, g, f) = (100e9, 60e9, 0.2);
        let computed = isotropic(k, g, 10.0)
            .porous(f, PoreGeometry::Spheroids(1.0), PorosityScheme::MoriTanaka)
            .unwrap();
        let sum = 3.0 * k + 4.0 * g;
        let bulk = k - f * k * sum / (sum - 3.0 * (1.0 - f) * k);
        let shear =
            g - 5.0 * f * g * g * sum / (5.0 * g * sum - 6.0 * (1.0 - f) * g * (k + 2.0 * g));
        let permittivity = 10.0 + 3.0 * f * 10.0 * (1.0 - 10.0) / (1.0 + 20.0 - f * (1.0 - 10.0));
        let close = |value: f64, exact: f64| {
            assert!((value / exact - 1.0).abs() < 1e-12, "{value:e} {exact:e}")
        };
        close((computed.c11_pa + 2.0 * computed.c12_pa) / 3.0, bulk);
        close(computed.c44_pa, shear);
        close((computed.c11_pa - computed.c12_pa) / 2.0, shear);
        close(computed.c33_pa, computed.c11_pa);
        close(
            computed.permittivity_33_f_m / VACUUM_PERMITTIVITY_F_M,
            permittivity,
        );
        close(bulk, 64e9);
    }

    /// Pores along the poling direction do not change `d31` and `d33`, and the permittivity follows
    /// the law of mixtures, in both schemes.
    #[test]
    fn cylinders_along_the_pole_are_exact() {
        let [d31, d33, permittivity] = PZT_5A.free();
        for scheme in [PorosityScheme::MoriTanaka, PorosityScheme::SelfConsistent] {
            let computed = PZT_5A
                .porous(0.3, PoreGeometry::Cylinders, scheme)
                .unwrap()
                .free();
            let mixed = 0.7 * permittivity + 0.3 * VACUUM_PERMITTIVITY_F_M;
            for (value, exact) in computed.iter().zip([d31, d33, mixed]) {
                assert!(
                    (value / exact - 1.0).abs() < 1e-9,
                    "{scheme:?}: {value:e} {exact:e}"
                );
            }
        }
    }

    const SPHERES: PoreGeometry = PoreGeometry::Spheroids(1.0);
    /// PZT-5A with pores, second program: pores, scheme, porosity; C11, C13, C33, C44 (GPa), e31, e33
    /// (C/m^2), relative permittivities at constant strain and stress, d31, d33 (pC/N).
    const SECOND_PROGRAM: [(PoreGeometry, PorosityScheme, f64, [f64; 10]); 5] = [
        (
            SPHERES,
            PorosityScheme::MoriTanaka,
            0.1,
            [
                92.952, 53.369, 82.747, 17.796, -3.200, 14.148, 744.36, 1451.2, -155.76, 371.90,
            ],
        ),
        (
            SPHERES,
            PorosityScheme::MoriTanaka,
            0.3,
            [
                55.954, 28.100, 47.996, 12.273, -0.894, 10.393, 559.17, 1019.4, -130.75, 369.63,
            ],
        ),
        (
            SPHERES,
            PorosityScheme::SelfConsistent,
            0.1,
            [
                89.35, 50.58, 79.49, 17.46, -3.02, 13.98, 746.5, 1440.0, -154.51, 372.48,
            ],
        ),
        (
            SPHERES,
            PorosityScheme::SelfConsistent,
            0.3,
            [
                36.28, 15.66, 31.66, 9.37, -0.39, 8.20, 569.3, 928.5, -118.81, 376.50,
            ],
        ),
        (
            PoreGeometry::Cylinders,
            PorosityScheme::MoriTanaka,
            0.3,
            [
                41.079, 22.966, 54.976, 11.362, -1.649, 12.692, 594.53, 1193.0, -170.40, 373.23,
            ],
        ),
    ];

    /// Tolerance 0.1 % for Mori-Tanaka, 0.5 % for the self-consistent scheme.
    #[test]
    fn porous_pzt_5a_is_that_of_a_second_program() {
        for (pores, scheme, f, expected) in SECOND_PROGRAM {
            let c = PZT_5A.porous(f, pores, scheme).unwrap();
            let [d31, d33, permittivity] = c.free();
            let stiffness = [c.c11_pa, c.c13_pa, c.c33_pa, c.c44_pa].map(|pa| pa / 1e9);
            let relative =
                [c.permittivity_33_f_m, permittivity].map(|value| value / VACUUM_PERMITTIVITY_F_M);
            let computed = [
                &stiffness[..],
                &[c.e31_c_m2, c.e33_c_m2],
                &relative,
                &[d31 * 1e12, d33 * 1e12],
            ]
            .concat();
            let allowed = if scheme == PorosityScheme::MoriTanaka {
                1e-3
            } else {
                5e-3
            };
            for (value, expected) in computed.iter().zip(expected) {
                // The last printed digit of small constants is coarser than this tolerance.
                let digit = if scheme == PorosityScheme::MoriTanaka {
                    6e-4
                } else {
                    6e-3
                };
                assert!(
                    (value - expected).abs() <= allowed * expected.abs() + digit,
                    "{scheme:?} {f}: {value} {expected}"
                );
            }
        }
    }
}

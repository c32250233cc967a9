//! Stiffness of a layer in its plane.

/// A layer under plane stress whose principal directions are x and y.
///
/// ```text
/// Q11 = E1 / (1 - nu12 nu21),  Q22 = E2 / (1 - nu12 nu21),  Q12 = nu12 Q22,  Q66 = G12,  nu21 = nu12 E2 / E1
/// ```
///
/// Source: J. N. Reddy, Mechanics of Laminated Composite Plates and Shells (2004), ch. 2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lamina {
    /// `E1` along x and `E2` along y, Pa.
    pub youngs_modulus_pa: [f64; 2],
    /// `nu12`: contraction along y per strain along x under a stress along x.
    pub poisson_ratio: f64,
    /// `G12`, Pa.
    pub shear_modulus_pa: f64,
}

impl Lamina {
    /// Returns a layer that is isotropic in its plane.
    pub fn isotropic(youngs_modulus_pa: f64, poisson_ratio: f64) -> Self {
        Self {
            youngs_modulus_pa: [youngs_modulus_pa; 2],
            poisson_ratio,
            shear_modulus_pa: youngs_modulus_pa / (2.0 * (1.0 + poisson_ratio)),
        }
    }

    /// Returns `Q11`, `Q12` and `Q22`, Pa.
    pub fn normal_stiffness_pa(&self) -> [f64; 3] {
        let [along_pa, across_pa] = self.youngs_modulus_pa;
        let share = 1.0 - self.contraction_product();
        [
            along_pa / share,
            self.poisson_ratio * across_pa / share,
            across_pa / share,
        ]
    }

    /// Returns `nu12 nu21`; below 1 for every stable material.
    pub fn contraction_product(&self) -> f64 {
        let [along_pa, across_pa] = self.youngs_modulus_pa;
        self.poisson_ratio * self.poisson_ratio * across_pa / along_pa
    }
}

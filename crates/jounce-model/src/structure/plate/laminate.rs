//! Laminate of a plate: bending stiffness, mass per area and neutral planes.
//!
//! Layers `i` are isotropic in the plane, with modulus `E_i` (Pa), Poisson's ratio `nu_i`,
//! thickness `t_i` (m) and mid-height `z_i` (m, from the bottom of the plate). Their stiffness has
//! two parts: `Q+ = E / (1 - nu)` against equal strains in x and y, `Q- = E / (1 + nu)` against
//! opposite strains and shear. Each part bends about its own neutral plane, in which the in-plane
//! force vanishes; with one Poisson's ratio for all layers the two planes coincide:
//!
//! ```text
//! z+-  = sum Q+-_i t_i z_i / sum Q+-_i t_i                          neutral planes, m
//! D+-  = sum Q+-_i (t_i^3 / 12 + t_i (z_i - z+-)^2)                 N m
//! D11  = (D+ + D-) / 2,   D12 = (D+ - D-) / 2,   D66 = D- / 2
//! gamma = d31 E_p / (1 - nu_p) (z_p - z+)                           moment of the patch per volt and length, N/V
//! ```
//!
//! With `nu_i = 0` this is the laminate section of a beam (`beam::section`), per width. The charge
//! per strain `d31 E_p / (1 - nu_p)` equals `e31 - c13 e33 / c33` in plane stress.
//!
//! Limits: the in-plane force vanishes at every point, as in a beam; a stiff patch that covers a
//! small part of a plate also stretches its surroundings, which is neglected.
//!
//! Source: J. N. Reddy, Mechanics of Laminated Composite Plates and Shells (2004), ch. 3 (`D - B
//! A^-1 B`); A. Erturk, D. J. Inman, Piezoelectric Energy Harvesting (2011), appendix A.

use jounce_spec::{Face, Layer, Patch, Plate};

/// Bending properties of a cell of a plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Laminate {
    /// `D+` and `D-`, N m.
    stiffness_n_m: [f64; 2],
    /// Mass per area, kg/m^2.
    pub mass_kg_m2: f64,
    /// `z+` and `z-`, m.
    neutral_m: [f64; 2],
    /// Thickness of the passive layers on the bottom and on the top, m.
    coated_m: [f64; 2],
}

/// A layer of one material.
struct Ply {
    youngs_modulus_pa: f64,
    poisson_ratio: f64,
    density_kg_m3: f64,
    thickness_m: f64,
    middle_m: f64,
}

impl Ply {
    /// `Q+ t` and `Q- t`, N/m.
    fn extension_n_m(&self) -> [f64; 2] {
        [1.0 - self.poisson_ratio, 1.0 + self.poisson_ratio]
            .map(|factor| self.youngs_modulus_pa / factor * self.thickness_m)
    }
}

impl Laminate {
    /// Returns the laminate of a plate with these layers and these patches on top, at most one of
    /// each on each face.
    pub fn new<'a>(
        plate: &Plate,
        layers: impl Iterator<Item = &'a Layer>,
        patches: impl Iterator<Item = &'a Patch>,
    ) -> Self {
        let mut coated_m = [0.0; 2];
        let mut plies = vec![Ply {
            youngs_modulus_pa: plate.youngs_modulus_pa,
            poisson_ratio: plate.poisson_ratio,
            density_kg_m3: plate.density_kg_m3,
            thickness_m: plate.thickness_m,
            middle_m: plate.thickness_m / 2.0,
        }];
        for layer in layers {
            coated_m[side(layer.face)] += layer.thickness_m;
            plies.push(Ply {
                youngs_modulus_pa: layer.youngs_modulus_pa,
                poisson_ratio: layer.poisson_ratio().unwrap_or(f64::NAN),
                density_kg_m3: layer.density_kg_m3,
                thickness_m: layer.thickness_m,
                middle_m: above_m(plate, layer.face, layer.thickness_m / 2.0),
            });
        }
        for patch in patches {
            plies.push(Ply {
                youngs_modulus_pa: patch.youngs_modulus_pa,
                poisson_ratio: patch.poisson_ratio().unwrap_or(f64::NAN),
                density_kg_m3: patch.density_kg_m3,
                thickness_m: patch.thickness_m,
                middle_m: middle_m(plate, coated_m, patch),
            });
        }
        let neutral_m = [0, 1].map(|part| {
            let extension = |ply: &Ply| ply.extension_n_m()[part];
            plies
                .iter()
                .map(|ply| extension(ply) * ply.middle_m)
                .sum::<f64>()
                / plies.iter().map(extension).sum::<f64>()
        });
        let stiffness_n_m = [0, 1].map(|part| {
            let bending = |ply: &Ply| {
                let lever_m = ply.middle_m - neutral_m[part];
                ply.extension_n_m()[part]
                    * (ply.thickness_m * ply.thickness_m / 12.0 + lever_m * lever_m)
            };
            plies.iter().map(bending).sum()
        });
        Self {
            stiffness_n_m,
            mass_kg_m2: plies
                .iter()
                .map(|ply| ply.density_kg_m3 * ply.thickness_m)
                .sum(),
            neutral_m,
            coated_m,
        }
    }

    /// Returns `D11`, `D12` and `D66`, N m.
    pub fn stiffness_n_m(&self) -> [f64; 3] {
        let [plus, minus] = self.stiffness_n_m;
        [(plus + minus) / 2.0, (plus - minus) / 2.0, minus / 2.0]
    }

    /// Returns the moment of a patch per volt and length, N/V.
    pub fn patch_moment_n_v(&self, plate: &Plate, patch: &Patch) -> f64 {
        let lever_m = middle_m(plate, self.coated_m, patch) - self.neutral_m[0];
        charge_per_strain_c_m2(patch) * lever_m
    }

    /// Returns the strains in x and in y of the outer face of a patch for curvatures `w_xx` and
    /// `w_yy`, 1/m.
    pub fn outer_strain(&self, plate: &Plate, patch: &Patch, curvature: [f64; 2]) -> [f64; 2] {
        let coat_m = self.coated_m[side(patch.face)];
        let face_m = above_m(plate, patch.face, coat_m + patch.thickness_m);
        let [x, y] = curvature;
        let [sum, difference] = [(x + y, 0), (x - y, 1)]
            .map(|(part_curvature, part)| -(face_m - self.neutral_m[part]) * part_curvature);
        [(sum + difference) / 2.0, (sum - difference) / 2.0]
    }
}

/// Returns `e31bar`, the charge per strain of a patch in plane stress, C/m^2.
fn charge_per_strain_c_m2(patch: &Patch) -> f64 {
    let poisson_ratio = patch.poisson_ratio().unwrap_or(f64::NAN);
    patch.d31_m_per_v.unwrap_or(f64::NAN) * patch.youngs_modulus_pa / (1.0 - poisson_ratio)
}

fn side(face: Face) -> usize {
    usize::from(face == Face::Top)
}

/// Returns the mid-height of a patch above the bottom of the plate, m.
fn middle_m(plate: &Plate, coated_m: [f64; 2], patch: &Patch) -> f64 {
    above_m(
        plate,
        patch.face,
        coated_m[side(patch.face)] + patch.thickness_m / 2.0,
    )
}

/// Returns the height of a place at a distance from a face of the plate, above its bottom, m.
fn above_m(plate: &Plate, face: Face, distance_m: f64) -> f64 {
    match face {
        Face::Top => plate.thickness_m + distance_m,
        Face::Bottom => -distance_m,
    }
}

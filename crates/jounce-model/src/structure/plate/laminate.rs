//! Laminate of a plate: bending stiffness, mass per area and neutral planes.
//!
//! Layers `i` are laminas along x and y, with reduced stiffness `Q_i` (Pa, [`jounce_spec::Lamina`]),
//! thickness `t_i` (m) and mid-height `z_i` (m, from the middle of the plate):
//!
//! ```text
//! A = sum Q_i t_i,   B = sum Q_i t_i z_i,   C = sum Q_i t_i (t_i^2 / 12 + z_i^2)
//! N     = A^-1 B                                       heights at which a curvature leaves no in-plane force, m
//! D     = C - B N                                      bending stiffness, N m
//! strain(z) = -(z - N) (w_xx, w_yy),   gamma(z) = -2 (z - N66) w_xy
//! gamma_p = (z_p - N^T) e_p                            moments of the patch per volt and length, along x and y, N/V
//! ```
//!
//! Normal strains and shear do not couple. `e_p = Q_p a_p` is the force per length and voltage of
//! the patch at constant strain ([`jounce_spec::Patch::blocked_force_n_m_v`]). Layers that are
//! isotropic in the plane have one neutral plane for equal strains in x and y and another one for
//! opposite strains and shear. With all Poisson's ratios zero this is the laminate section of a beam
//! (`beam::section`), per width.
//!
//! Limits: the in-plane force vanishes at every point, as in a beam; a stiff patch that covers a
//! small part of a plate also stretches its surroundings, which is neglected.
//!
//! Source: J. N. Reddy, Mechanics of Laminated Composite Plates and Shells (2004), ch. 3 (`D - B
//! A^-1 B`); A. Erturk, D. J. Inman, Piezoelectric Energy Harvesting (2011), appendix A.

use super::ply::{Plane, Ply};
use jounce_spec::{Face, Layer, Patch, Plate};

/// Bending properties of a cell of a plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Laminate {
    /// `D`, N m.
    pub stiffness_n_m: Plane,
    /// Mass per area, kg/m^2.
    pub mass_kg_m2: f64,
    /// `N` of the normal strains, m.
    neutral_m: [[f64; 2]; 2],
    /// `N66` of the shear strain, m.
    shear_neutral_m: f64,
    /// Thickness of the passive layers on the bottom and on the top, m.
    coated_m: [f64; 2],
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
        let mut plies = vec![Ply::of_plate(plate)];
        for layer in layers {
            coated_m[side(layer.face)] += layer.thickness_m;
            plies.push(Ply::of_layer(plate, layer));
        }
        for patch in patches {
            let coat_m = coated_m[side(patch.face)];
            plies.push(Ply::of_patch(plate, patch, coat_m));
            plies.extend(Ply::of_foils(plate, patch, coat_m));
        }
        let sum = |factor: fn(&Ply) -> f64| {
            plies.iter().fold(Plane::default(), |sum, ply| {
                sum.plus(ply.extension_n_m().times(factor(ply)))
            })
        };
        let extension = sum(|_| 1.0);
        let coupling = sum(|ply| ply.middle_m);
        let bending =
            sum(|ply| ply.thickness_m * ply.thickness_m / 12.0 + ply.middle_m * ply.middle_m);
        let neutral_m = extension.solved(&coupling);
        let shear_neutral_m = coupling.shear / extension.shear;
        let shift = coupling.product(neutral_m);
        Self {
            stiffness_n_m: Plane {
                xx: bending.xx - shift[0][0],
                // The product is symmetric.
                xy: bending.xy - (shift[0][1] + shift[1][0]) / 2.0,
                yy: bending.yy - shift[1][1],
                shear: bending.shear - coupling.shear * shear_neutral_m,
            },
            mass_kg_m2: plies
                .iter()
                .map(|ply| ply.density_kg_m3 * ply.thickness_m)
                .sum(),
            neutral_m,
            shear_neutral_m,
            coated_m,
        }
    }

    /// Returns the moments of a patch along x and along y per volt and length, N/V.
    pub fn patch_moment_n_v(&self, plate: &Plate, patch: &Patch) -> [f64; 2] {
        let middle_m = Ply::of_patch(plate, patch, self.coat_m(patch.face)).middle_m;
        let [x, y] = patch.blocked_force_n_m_v();
        let neutral_m = self.neutral_m;
        [0, 1].map(|axis| {
            let along = [x, y][axis] * middle_m;
            along - (neutral_m[0][axis] * x + neutral_m[1][axis] * y)
        })
    }

    /// Returns the strains in x and in y and the shear strain of the outer face of the active layer
    /// of a patch for the curvatures `w_xx`, `w_yy` and `w_xy`, 1/m.
    pub fn outer_strain(&self, plate: &Plate, patch: &Patch, curvature: [f64; 3]) -> [f64; 3] {
        let ply = Ply::of_patch(plate, patch, self.coat_m(patch.face));
        let outwards = if patch.face == Face::Top { 0.5 } else { -0.5 };
        let face_m = ply.middle_m + outwards * ply.thickness_m;
        let [x, y, twist] = curvature;
        let [of_x, of_y] = self.neutral_m;
        [
            of_x[0] * x + of_x[1] * y - face_m * x,
            of_y[0] * x + of_y[1] * y - face_m * y,
            -2.0 * (face_m - self.shear_neutral_m) * twist,
        ]
    }

    /// Returns the thickness of the layer under a patch of a face, m.
    fn coat_m(&self, face: Face) -> f64 {
        self.coated_m[side(face)]
    }
}

fn side(face: Face) -> usize {
    usize::from(face == Face::Top)
}

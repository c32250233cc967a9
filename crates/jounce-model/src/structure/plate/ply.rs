//! A ply of a laminate: a layer of one material at a height.

use jounce_spec::{Face, Lamina, Layer, Patch, Plate};

/// Stiffness, density and position of a layer.
pub(super) struct Ply {
    lamina: Lamina,
    pub density_kg_m3: f64,
    pub thickness_m: f64,
    /// Height of its middle above that of the plate, m.
    pub middle_m: f64,
}

/// Symmetric stiffness against normal strains along x and y, and against shear.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Plane {
    pub xx: f64,
    pub xy: f64,
    pub yy: f64,
    pub shear: f64,
}

impl Ply {
    pub fn of_plate(plate: &Plate) -> Self {
        Self {
            lamina: Lamina::isotropic(plate.youngs_modulus_pa, plate.poisson_ratio),
            density_kg_m3: plate.density_kg_m3,
            thickness_m: plate.thickness_m,
            middle_m: 0.0,
        }
    }

    pub fn of_layer(plate: &Plate, layer: &Layer) -> Self {
        let poisson_ratio = layer.poisson_ratio().unwrap_or(f64::NAN);
        Self {
            lamina: Lamina::isotropic(layer.youngs_modulus_pa, poisson_ratio),
            density_kg_m3: layer.density_kg_m3,
            thickness_m: layer.thickness_m,
            middle_m: above_m(plate, layer.face, layer.thickness_m / 2.0),
        }
    }

    /// Returns the active layer, on a layer of the thickness `coat_m`.
    pub fn of_patch(plate: &Plate, patch: &Patch, coat_m: f64) -> Self {
        let under_m = coat_m + patch.foils.each_m();
        Self {
            lamina: patch.lamina(),
            density_kg_m3: patch.density_kg_m3,
            thickness_m: patch.thickness_m,
            middle_m: above_m(plate, patch.face, under_m + patch.thickness_m / 2.0),
        }
    }

    /// Returns the foils below and above the active layer; empty without foils.
    pub fn of_foils(plate: &Plate, patch: &Patch, coat_m: f64) -> impl Iterator<Item = Self> {
        let each_m = patch.foils.each_m();
        let under_m = [coat_m, coat_m + each_m + patch.thickness_m]
            .into_iter()
            .filter(move |_| each_m > 0.0);
        under_m.map(move |under_m| Self {
            lamina: Lamina::isotropic(patch.foils.modulus_pa(), patch.foils.contraction()),
            density_kg_m3: patch.foils.mass_per_volume_kg_m3(),
            thickness_m: each_m,
            middle_m: above_m(plate, patch.face, under_m + each_m / 2.0),
        })
    }

    /// Returns `Q t`, N/m.
    pub fn extension_n_m(&self) -> Plane {
        let [xx, xy, yy] = self.lamina.normal_stiffness_pa();
        let shear = self.lamina.shear_modulus_pa;
        Plane { xx, xy, yy, shear }.times(self.thickness_m)
    }
}

impl Plane {
    pub fn plus(self, other: Self) -> Self {
        Self {
            xx: self.xx + other.xx,
            xy: self.xy + other.xy,
            yy: self.yy + other.yy,
            shear: self.shear + other.shear,
        }
    }

    pub fn times(self, factor: f64) -> Self {
        Self {
            xx: self.xx * factor,
            xy: self.xy * factor,
            yy: self.yy * factor,
            shear: self.shear * factor,
        }
    }

    /// Returns the solution `N` of `self N = other` for the normal strains.
    pub fn solved(&self, other: &Self) -> [[f64; 2]; 2] {
        let determinant = self.xx * self.yy - self.xy * self.xy;
        let column = |[x, y]: [f64; 2]| {
            [
                (self.yy * x - self.xy * y) / determinant,
                (self.xx * y - self.xy * x) / determinant,
            ]
        };
        let (first, second) = (column([other.xx, other.xy]), column([other.xy, other.yy]));
        [[first[0], second[0]], [first[1], second[1]]]
    }

    /// Returns the product with a matrix, for the normal strains.
    pub fn product(&self, [x, y]: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
        let row = |[of_x, of_y]: [f64; 2]| [0, 1].map(|k| of_x * x[k] + of_y * y[k]);
        [row([self.xx, self.xy]), row([self.xy, self.yy])]
    }
}

/// Returns the height of a place at a distance from a face of the plate, above its middle, m.
fn above_m(plate: &Plate, face: Face, distance_m: f64) -> f64 {
    let height_m = plate.thickness_m / 2.0 + distance_m;
    if face == Face::Top {
        height_m
    } else {
        -height_m
    }
}

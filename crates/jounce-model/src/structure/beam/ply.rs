//! A ply of a cross-section: a rectangle of one material at a height.

use jounce_spec::{Beam, Face, Layer, Patch};

/// Modulus, density and position of a rectangle.
pub(super) struct Ply {
    pub youngs_modulus_pa: f64,
    pub density_kg_m3: f64,
    pub width_m: f64,
    pub thickness_m: f64,
    /// Height of its middle above the bottom of the beam, m.
    pub middle_m: f64,
}

impl Ply {
    pub fn of_beam(beam: &Beam) -> Self {
        Self {
            youngs_modulus_pa: beam.youngs_modulus_pa,
            density_kg_m3: beam.density_kg_m3,
            width_m: beam.width_m,
            thickness_m: beam.thickness_m,
            middle_m: beam.thickness_m / 2.0,
        }
    }

    pub fn of_layer(beam: &Beam, layer: &Layer) -> Self {
        Self {
            youngs_modulus_pa: layer.youngs_modulus_pa,
            density_kg_m3: layer.density_kg_m3,
            width_m: layer.width_m,
            thickness_m: layer.thickness_m,
            middle_m: above_m(beam, layer.face, 0.0, layer.thickness_m / 2.0),
        }
    }

    /// Returns the active layer, on a layer of the thickness `coat_m`.
    pub fn of_patch(beam: &Beam, patch: &Patch, coat_m: f64) -> Self {
        Self {
            youngs_modulus_pa: patch.youngs_modulus_pa,
            density_kg_m3: patch.density_kg_m3,
            width_m: patch.width_m,
            thickness_m: patch.thickness_m,
            middle_m: above_m(
                beam,
                patch.face,
                coat_m + patch.foils.each_m(),
                patch.thickness_m / 2.0,
            ),
        }
    }

    /// Returns the foils below and above the active layer; empty without foils.
    pub fn of_foils(beam: &Beam, patch: &Patch, coat_m: f64) -> impl Iterator<Item = Self> {
        let each_m = patch.foils.each_m();
        let under_m = [coat_m, coat_m + each_m + patch.thickness_m]
            .into_iter()
            .filter(move |_| each_m > 0.0);
        under_m.map(move |under_m| Self {
            youngs_modulus_pa: patch.foils.modulus_pa(),
            density_kg_m3: patch.foils.mass_per_volume_kg_m3(),
            width_m: patch.width_m,
            thickness_m: each_m,
            middle_m: above_m(beam, patch.face, under_m, each_m / 2.0),
        })
    }

    pub fn axial_stiffness_n(&self) -> f64 {
        self.youngs_modulus_pa * self.width_m * self.thickness_m
    }

    pub fn bending_stiffness_n_m2(&self, axis_m: f64) -> f64 {
        let lever_m = self.middle_m - axis_m;
        self.axial_stiffness_n() * (self.thickness_m * self.thickness_m / 12.0 + lever_m * lever_m)
    }
}

/// Returns the height above the bottom of the beam at the distance `coat_m` plus `more_m` from a
/// face.
pub(super) fn above_m(beam: &Beam, face: Face, coat_m: f64, more_m: f64) -> f64 {
    if face == Face::Top {
        beam.thickness_m + coat_m + more_m
    } else {
        -coat_m - more_m
    }
}

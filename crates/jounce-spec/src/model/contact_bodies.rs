//! `[stop.NAME]`: the two bodies of a contact, from which its stiffness follows.

use crate::hertz;

/// Two bodies in contact at a stop.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ContactBodies {
    /// `radius`, `shape`, `cross_radius`, `material`, `youngs_modulus`, `poisson_ratio`: the
    /// striking body.
    pub striking: ContactBody,
    /// The same keys with the prefix `stop_`: the body that it strikes; flat without a radius.
    pub stop: ContactBody,
    /// `crossing_angle`: angle between the planes of `radius` and of `stop_radius`, rad; 0 if omitted.
    pub crossing_angle_rad: Option<f64>,
}

/// Shape and material of a body at the point of contact.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ContactBody {
    /// `shape`; default `sphere`.
    pub shape: BodyShape,
    /// `radius` of curvature, m; negative for a concave body.
    pub radius_m: Option<f64>,
    /// `cross_radius` of curvature in the plane perpendicular to that of `radius`, m; for an
    /// ellipsoid.
    pub cross_radius_m: Option<f64>,
    /// `material`: library material that supplies the values omitted here; empty if omitted.
    pub material: String,
    /// `youngs_modulus`, Pa.
    pub youngs_modulus_pa: Option<f64>,
    /// `poisson_ratio`
    pub poisson_ratio: Option<f64>,
}

/// Shape of a body near the point of contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BodyShape {
    /// `"sphere"`: one radius in all directions.
    #[default]
    Sphere,
    /// `"cylinder"`: straight in the plane perpendicular to that of its radius.
    Cylinder,
    /// `"ellipsoid"`: two radii in perpendicular planes.
    Ellipsoid,
}

impl ContactBodies {
    /// Returns Hertz's stiffness, N/m^1.5; `None` while a value is missing, NaN where the bodies do
    /// not touch at a point.
    pub fn stiffness(&self) -> Option<f64> {
        self.striking.radius_m?;
        let bodies = [self.striking.elasticity()?, self.stop.elasticity()?];
        Some(hertz::stiffness(
            hertz::effective_modulus_pa(bodies),
            self.curvatures_per_m(),
        ))
    }

    /// Returns half the relative principal curvatures, 1/m, ascending.
    pub fn curvatures_per_m(&self) -> [f64; 2] {
        hertz::relative_curvatures_per_m(
            self.striking.curvatures_per_m(),
            self.stop.curvatures_per_m(),
            self.crossing_angle_rad.unwrap_or(0.0),
        )
    }
}

impl ContactBody {
    /// Returns Young's modulus (Pa) and Poisson's ratio, if both are known.
    fn elasticity(&self) -> Option<(f64, f64)> {
        self.youngs_modulus_pa.zip(self.poisson_ratio)
    }

    /// Returns the principal curvatures in the plane of `radius` and across it, 1/m; 0 for a flat
    /// body.
    fn curvatures_per_m(&self) -> [f64; 2] {
        let Some(radius_m) = self.radius_m else {
            return [0.0; 2];
        };
        let across = match self.shape {
            BodyShape::Sphere => radius_m.recip(),
            BodyShape::Cylinder => 0.0,
            BodyShape::Ellipsoid => self.cross_radius_m.map_or(f64::NAN, f64::recip),
        };
        [radius_m.recip(), across]
    }
}

//! Strain at a place of a patch, per modal coordinate.

/// Strain of the outer face of a patch at one place, per unit of each modal coordinate (kg^-1/2).
#[derive(Debug, Clone, PartialEq)]
pub enum PlaceStrain {
    /// Strain along a beam, or along the fibres of a composite on a plate.
    Along(Vec<f64>),
    /// Strains along x and y of a plate, and shear strain.
    InPlane([Vec<f64>; 3]),
}

impl PlaceStrain {
    /// Returns the strain for these modal coordinates, more of which may follow: that along the
    /// beam or the fibres, or in the plane of a plate the principal strain of the larger magnitude,
    /// `(x + y) / 2 +- sqrt((x - y)^2 + gamma^2) / 2`.
    pub fn at(&self, coordinates: &[f64]) -> f64 {
        let sum = |row: &Vec<f64>| -> f64 { row.iter().zip(coordinates).map(|(s, q)| s * q).sum() };
        match self {
            Self::Along(row) => sum(row),
            Self::InPlane(rows) => Self::of_values(&[0, 1, 2].map(|k| sum(&rows[k]))),
        }
    }

    /// Returns the strain for the values of [`PlaceStrain::rows`].
    pub fn of_values(values: &[f64]) -> f64 {
        match *values {
            [x, y, shear] => {
                let (mean, radius) = ((x + y) / 2.0, (x - y).hypot(shear) / 2.0);
                mean + radius.copysign(mean)
            }
            _ => values.iter().sum(),
        }
    }

    /// Returns its lists of modes: that along, or those in the plane.
    pub fn rows(&self) -> &[Vec<f64>] {
        match self {
            Self::Along(row) => std::slice::from_ref(row),
            Self::InPlane(rows) => rows,
        }
    }

    /// Returns the strain with each list of modes replaced.
    pub(super) fn mapped(&self, change: impl Fn(&Vec<f64>) -> Vec<f64>) -> Self {
        match self {
            Self::Along(row) => Self::Along(change(row)),
            Self::InPlane(rows) => Self::InPlane([0, 1, 2].map(|k| change(&rows[k]))),
        }
    }

    /// Returns its lists of modes.
    pub(super) fn rows_mut(&mut self) -> &mut [Vec<f64>] {
        match self {
            Self::Along(row) => std::slice::from_mut(row),
            Self::InPlane(rows) => rows,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pure shear of 100 ppm has the principal strains of 50 ppm, strains of equal sign the larger.
    #[test]
    fn principal_strains_are_those_of_the_circle_of_mohr() {
        let place = |strain: [f64; 3]| PlaceStrain::InPlane(strain.map(|value| vec![value, 0.0]));
        for (strain, expected) in [
            ([0.0, 0.0, 100.0], 50.0),
            ([60.0, 20.0, 0.0], 60.0),
            ([-60.0, 20.0, 0.0], -60.0),
            ([70.0, 10.0, 80.0], 90.0),
            ([-70.0, -10.0, 80.0], -90.0),
        ] {
            assert_eq!(place(strain).at(&[1.0]), expected, "{strain:?}");
        }
        assert_eq!(
            PlaceStrain::Along(vec![2.0, 3.0]).at(&[1.0, -1.0, 9.0]),
            -1.0
        );
    }
}

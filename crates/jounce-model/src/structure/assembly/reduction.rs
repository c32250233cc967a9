//! The eigenproblem, solved as an inverse problem in factored form.
//!
//! With `K = I` and `M = G^T G` in strain coordinates, `K s = w^2 M s` is the singular value
//! problem of `G`:
//!
//! ```text
//! G = U diag(1/w) V^T,      mass-normalised mode k:  s_k = w_k v_k,      x(point) of mode k = row(point) . s_k
//! ```
//!
//! Low modes have the greatest singular values, so roundoff is about 1e-16 `w_k / w_1` relative,
//! for any mesh. A plain solve with `K` and `M` is less accurate: its roundoff is 1e-16 times the
//! square of the highest frequency of the mesh over the required one. With a rigid-body coordinate
//! (column `g` of `G`, no strain energy) the other coordinates are first made mass-orthogonal to
//! it.

use crate::structure::assembly::{Assembly, Row};
use crate::structure::error::StructureError;
use jounce_linalg::{Mat, right_singular};

/// All modes of one assembly, in ascending frequency.
#[derive(Debug, Clone)]
pub(in crate::structure) struct AssemblyModes {
    pub frequency_rad_s: Vec<f64>,
    /// Strain coordinates of the mass-normalised modes, one column per mode.
    coordinates: Mat<f64>,
}

impl AssemblyModes {
    /// Solves the eigenproblem of an assembly.
    ///
    /// # Errors
    /// `NotRepresentable` if the numbers exceed the range of double precision.
    pub fn new(assembly: &Assembly) -> Result<Self, StructureError> {
        let factor = assembly.mass_factor()?;
        let reduced = if assembly.rigid {
            Self::free(factor)
        } else {
            Self::with_fixed_root(factor)
        };
        reduced.ok_or_else(|| StructureError::NotRepresentable {
            body: assembly.body.name().into(),
        })
    }

    /// Returns `row . s_k` for the first `modes` modes.
    pub fn modal(&self, row: &Row, modes: usize) -> Vec<f64> {
        let dot = |mode| {
            self.coordinates
                .column(mode)
                .iter()
                .zip(row)
                .map(|(s, value)| s * value)
                .sum()
        };
        (0..modes).map(dot).collect()
    }

    /// Sets the sign of each mode: the first free end (beams in the order of their names) that
    /// moves at least half as far as the furthest end moves in the positive direction. For a single
    /// beam, its free end is positive in every mode.
    pub fn orient(&mut self, free_ends: &[Row]) {
        let count = self.frequency_rad_s.len();
        let ends: Vec<Vec<f64>> = free_ends.iter().map(|row| self.modal(row, count)).collect();
        for mode in 0..count {
            let furthest = ends.iter().map(|end| end[mode].abs()).fold(0.0, f64::max);
            let leading = ends
                .iter()
                .map(|end| end[mode])
                .find(|end| end.abs() >= furthest / 2.0);
            if leading.is_some_and(|end| end < 0.0) {
                self.coordinates
                    .column_mut(mode)
                    .iter_mut()
                    .for_each(|s| *s = -*s);
            }
        }
    }

    fn with_fixed_root(factor: Mat<f64>) -> Option<Self> {
        let (singular, mut coordinates) = right_singular(factor)?;
        let frequency_rad_s: Vec<f64> = singular.iter().map(|value| 1.0 / value).collect();
        for (mode, frequency) in frequency_rad_s.iter().enumerate() {
            coordinates
                .column_mut(mode)
                .iter_mut()
                .for_each(|s| *s *= frequency);
        }
        frequency_rad_s
            .iter()
            .all(|frequency| !frequency.is_nan())
            .then_some(Self {
                frequency_rad_s,
                coordinates,
            })
    }

    fn free(mut factor: Mat<f64>) -> Option<Self> {
        let columns = factor.ncols();
        let root_mass = factor.column(0).norm();
        let rigid: Vec<f64> = factor
            .column(0)
            .iter()
            .map(|entry| entry / root_mass)
            .collect();
        let mut rigid_shares = vec![0.0; columns];
        for (column, rigid_share) in rigid_shares.iter_mut().enumerate().skip(1) {
            let share: f64 = factor
                .column(column)
                .iter()
                .zip(&rigid)
                .map(|(entry, unit)| entry * unit)
                .sum();
            factor
                .column_mut(column)
                .iter_mut()
                .zip(&rigid)
                .for_each(|(entry, unit)| *entry -= share * unit);
            *rigid_share = share / root_mass;
        }
        let flexible = if columns > 1 {
            Self::with_fixed_root(factor.remove_column(0))?
        } else {
            Self::none()
        };
        let mut coordinates = Mat::zeros(columns, columns);
        coordinates[(0, 0)] = 1.0 / root_mass;
        for mode in 1..columns {
            for column in 1..columns {
                coordinates[(column, mode)] = flexible.coordinates[(column - 1, mode - 1)];
                coordinates[(0, mode)] -= rigid_shares[column] * coordinates[(column, mode)];
            }
        }
        let frequency_rad_s = std::iter::once(0.0)
            .chain(flexible.frequency_rad_s)
            .collect();
        Some(Self {
            frequency_rad_s,
            coordinates,
        })
    }

    fn none() -> Self {
        Self {
            frequency_rad_s: Vec::new(),
            coordinates: Mat::zeros(0, 0),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::structure::assembly::body::bodies;
    use crate::structure::beam::element::Element;
    use crate::structure::beam::section::CrossSection;
    use jounce_spec::{Beam, Mass, Spec};

    fn spec(stiffness_n_m: Option<f64>) -> Spec {
        let on = if stiffness_n_m.is_some() {
            "ground"
        } else {
            "nothing"
        }
        .to_owned();
        let damping_ratio = stiffness_n_m.map(|_| 0.0);
        let mass = Mass {
            on,
            mass_kg: 0.5,
            rotary_inertia_kg_m2: 0.0,
            stiffness_n_m,
            damping_ratio,
            velocity_m_s: None,
            friction_n_s_m: None,
        };
        let beam = Beam {
            length_m: 0.3,
            root: "table".into(),
            ..crate::structure::beam::section::tests::paper_beam()
        };
        Spec {
            beam: [("beam".into(), beam)].into(),
            mass: [("table".into(), mass)].into(),
            ..Spec::default()
        }
    }

    fn assembly(spec: &Spec) -> Assembly<'_> {
        let section = CrossSection {
            bending_stiffness_n_m2: 0.15,
            mass_per_length_kg_m: 0.08,
            neutral_axis_m: 0.0,
            coated_m: [0.0; 2],
        };
        let element = |start_m| Element {
            start_m,
            length_m: 0.15,
            section,
            terms: 9,
        };
        Assembly::new(
            bodies(spec, &[]).unwrap().remove(0),
            vec![Vec::new(), vec![element(0.0), element(0.15)]],
        )
    }

    /// `S^T G^T G S = 1` and, without the rigid coordinate, `S^T S = diag(w^2)`; relative to `w_i
    /// w_j`, measured 2e-13.
    #[test]
    fn modes_are_orthogonal_in_mass_and_stiffness() {
        for stiffness_n_m in [None, Some(50.0)] {
            let spec = spec(stiffness_n_m);
            let assembly = assembly(&spec);
            let reduced = AssemblyModes::new(&assembly).unwrap();
            let weighted = assembly.mass_factor().unwrap() * &reduced.coordinates;
            let strained = reduced
                .coordinates
                .rows_range(usize::from(assembly.rigid)..);
            for (i, w_i) in reduced.frequency_rad_s.iter().enumerate() {
                for (j, w_j) in reduced.frequency_rad_s.iter().enumerate() {
                    let same = f64::from(u8::from(i == j));
                    let kinetic = weighted.column(i).dot(&weighted.column(j));
                    let strain = strained.column(i).dot(&strained.column(j));
                    let scale = (w_i * w_j / reduced.frequency_rad_s[1].powi(2)).max(1.0);
                    assert!((kinetic - same).abs() < 1e-12 * scale, "{i} {j}: {kinetic}");
                    assert!(
                        (strain - same * w_i * w_j).abs() <= 1e-12 * w_i * w_j,
                        "{i} {j}: {strain}"
                    );
                }
            }
        }
    }

    #[test]
    fn orientation_makes_the_free_end_positive() {
        let spec = spec(Some(50.0));
        let assembly = assembly(&spec);
        let mut reduced = AssemblyModes::new(&assembly).unwrap();
        reduced
            .coordinates
            .column_mut(2)
            .iter_mut()
            .for_each(|s| *s = -*s);
        reduced.orient(&assembly.free_ends());
        assert!(
            reduced
                .modal(&assembly.free_ends()[0], 6)
                .iter()
                .all(|end| *end > 0.0)
        );
    }
}

//! Unknowns of the fit to several references.

use jounce_linalg::{Mat, c64, complex_right_singular};

use super::fit_data::FitData;
use super::likelihood::residues;
use crate::modal::{Band, Pole};

/// Fitted unknowns: poles, and the participation of every reference in each mode.
#[derive(Clone)]
pub(super) struct ReferenceModel {
    pub poles: Vec<c64>,
    /// Mode, reference.
    pub participation: Vec<Vec<c64>>,
    /// Reference of each mode whose participation is fixed at 1.
    fixed: Vec<usize>,
}

impl ReferenceModel {
    /// Initial participations: the first right singular vector of unconstrained residues.
    pub fn initial(band: &Band, data: &FitData, start: &[Pole]) -> Option<Self> {
        let poles: Vec<c64> = start.iter().map(|pole| pole.complex()).collect();
        let residue = residues(data, &poles);
        let initial_participation = |r: usize| {
            let residues_of_mode = Mat::from_fn(band.outputs(), band.inputs, |o, i| {
                residue[o * band.inputs + i][r]
            });
            let right = complex_right_singular(residues_of_mode)?;
            let row: Vec<c64> = right.column(0).iter().map(c64::conj).collect();
            let fixed = (0..row.len()).max_by(|a, b| row[*a].norm().total_cmp(&row[*b].norm()))?;
            Some((row.iter().map(|b| b / row[fixed]).collect(), fixed))
        };
        let (participation, fixed) = (0..start.len())
            .map(initial_participation)
            .collect::<Option<Vec<_>>>()?
            .into_iter()
            .unzip();
        Some(Self {
            poles,
            participation,
            fixed,
        })
    }

    /// Mode and reference of each fitted participation.
    pub fn free(&self) -> Vec<(usize, usize)> {
        let free_of_mode = |(r, row): (usize, &Vec<c64>)| {
            (0..row.len())
                .filter(|i| *i != self.fixed[r])
                .map(|i| (r, i))
                .collect::<Vec<_>>()
        };
        self.participation
            .iter()
            .enumerate()
            .flat_map(free_of_mode)
            .collect()
    }

    pub fn with_step(&self, step: &Mat<f64>) -> Self {
        let mut trial = self.clone();
        let step_of = |k: usize| c64::new(step[(2 * k, 0)], step[(2 * k + 1, 0)]);
        trial
            .poles
            .iter_mut()
            .enumerate()
            .for_each(|(r, pole)| *pole += step_of(r));
        for (k, (r, i)) in self.free().into_iter().enumerate() {
            trial.participation[r][i] += step_of(self.poles.len() + k);
        }
        trial
    }
}

//! Displacements of modes without stiffness in a component with patches.
//!
//! Nothing depends on such a displacement `q_f`. With the eigenvectors of all other states,
//!
//! ```text
//! y_j' = l_j y_j,   q_f' = sum_j c_fj y_j
//! ```
//!
//! A state `q_f - sum_j c_fj y_j / l_j` of rate zero would lose all digits where a rate is small: a
//! patch on a small resistor slows a body down over hours. So one real `y_j` per body, that with the
//! largest `c_fj / l_j`, keeps its displacement as a state, `u_j' = y_j`
//! ([`FreeBody`](crate::plant::BlockPair::FreeBody)). All other blocks add `c_fj y_j / l_j` to it. A
//! body that swings on the charge of an open patch has no such `y_j`; its state of rate zero is that
//! charge.

use jounce_linalg::{Mat, c64};

/// Displacements of the free bodies of a component.
pub(super) struct FreeBodies {
    /// State of each displacement.
    states: Vec<usize>,
    /// `c_fj`.
    velocity: Mat<c64>,
    /// `l_j`, 1/s.
    rates: Vec<c64>,
    /// Bodies with the index `j` of their velocity.
    coasting: Vec<(usize, usize)>,
}

impl FreeBodies {
    /// Assigns bodies to eigenvectors, given `c_fj` and `l_j`.
    pub fn new(states: Vec<usize>, velocity: Mat<c64>, rates: Vec<c64>) -> Self {
        let roundoff = f64::EPSILON * rates.iter().fold(0.0, |max: f64, l| max.max(l.norm()));
        let (mut coasting, mut rest): (Vec<(usize, usize)>, _) = (Vec::new(), velocity.clone());
        // Gaussian elimination with complete pivoting.
        while coasting.len() < states.len() {
            let open = |(f, j): &(usize, usize)| coasting.iter().all(|(g, k)| g != f && k != j);
            let share =
                |(f, j): (usize, usize)| rest[(f, j)].norm() / rates[j].norm().max(roundoff);
            let pivots = (0..states.len()).flat_map(|f| (0..rates.len()).map(move |j| (f, j)));
            let largest = (pivots.filter(open))
                .max_by(|a, b| share(*a).total_cmp(&share(*b)))
                .filter(|(f, j)| rates[*j].im == 0.0 && rest[(*f, *j)].re != 0.0);
            let Some((f, j)) = largest else { break };
            coasting.push((f, j));
            for g in (0..states.len()).filter(|g| coasting.iter().all(|(f, _)| f != g)) {
                let factor = rest[(g, j)] / rest[(f, j)];
                for k in 0..rates.len() {
                    let by = factor * rest[(f, k)];
                    rest[(g, k)] -= by;
                }
            }
        }
        Self {
            states,
            velocity,
            rates,
            coasting,
        }
    }

    /// Returns `c_fj`, the velocity of each displacement, where `y_j` is the velocity of a body.
    pub fn coasting(&self, j: usize) -> Option<impl Iterator<Item = (usize, f64)>> {
        let is_velocity = self.coasting.iter().any(|(_, k)| *k == j);
        is_velocity.then(|| {
            (self.states.iter().copied())
                .zip((0..self.states.len()).map(move |f| self.velocity[(f, j)].re))
        })
    }

    /// Returns the displacements that belong to an eigenvector.
    pub fn displacements(&self, j: usize) -> impl Iterator<Item = (usize, c64)> {
        let moves = self.coasting(j).is_none();
        let of = move |(f, state): (usize, &usize)| (*state, self.velocity[(f, j)] / self.rates[j]);
        self.states
            .iter()
            .enumerate()
            .filter(move |_| moves)
            .map(of)
    }

    /// Returns the displacements with a rate of zero.
    pub fn constant(&self) -> impl Iterator<Item = usize> {
        let is_constant = |f: &usize| self.coasting.iter().all(|(g, _)| g != f);
        (0..self.states.len())
            .filter(is_constant)
            .map(|f| self.states[f])
    }
}

//! Diagonalisation of the coupled electromechanical system without drives and contacts.
//!
//! ```text
//! q_i'' + 2 zeta_i w_i q_i' + sum_jd c_d s_id s_jd q_j' + w_i^2 q_i = sum_k theta_ik V_k
//! C_k V_k' + V_k / R_k + i_k + sum_i theta_ik q_i' = 0,     L i' = V - r i
//! ```
//!
//! with the friction `c_d` (N s/m) of points of shape `s_d` (kg^-1/2). Coupled modes, nodes and
//! inductors form a component. A mode without a patch is a component with a closed form (including
//! free, critically damped and overdamped modes). A component with patches is solved as a real
//! eigenproblem in the coordinates `(w q, q', sqrt(C) V, sqrt(L) i)`, whose squares are energies.
//! Its matrix is therefore skew-symmetric except for the losses, and its eigenvectors are well
//! conditioned.
//!
//! An open node has constant charge, `C V + sum theta q`. In energy coordinates that row is also
//! the equilibrium due to the charge. It is split off as an exact eigenvector of rate 0, and the
//! remainder is solved orthogonally to it.
//!
//! The displacement of a mode without stiffness acts on nothing. It is left out of the eigenproblem
//! and added as the integral of its velocity ([`free_bodies`]).
//!
//! Validation: `crates/jounce-dynamics/tests/plant` checks the residual of `A T = T J` and the
//! eigenvalues against the secular equation.

pub(super) mod block_diagonal;
pub(super) mod block_pair;
mod component;
mod conduction_path;
mod coupled_rates;
mod eigen_refinement;
mod free_bodies;
mod near_defects;
pub(super) mod stiff;

use super::{BlockDiagonal, BlockPair, Electrical, PlantError, System};
use component::{ComponentBlock, CoupledMatrix, PieceBlock, components, coupled, single_mode};
pub(super) use coupled_rates::coupled_rates;
use jounce_linalg::Mat;

/// Largest accepted condition number of the eigenvectors (in energy coordinates).
const MAX_CONDITION: f64 = 1e7;

/// `x = T y` with `x = (q, q', V, i)`, and the blocks of `A` in `y`.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagonal {
    /// The blocks.
    pub block: BlockDiagonal,
    /// `T`, rows `q_0.., q'_0.., V_0.., i_0..`; columns as the states of the blocks.
    pub to_physical: Mat<f64>,
    /// `T^-1`.
    pub from_physical: Mat<f64>,
}

impl Diagonal {
    /// Diagonalises the linear part of a system.
    ///
    /// # Errors
    /// [`PlantError::Defective`], [`PlantError::NoEigenvalues`].
    pub fn of(system: &System, electrical: &Electrical) -> Result<Self, PlantError> {
        let assembly = CoupledMatrix::of(system, electrical);
        let mut pieces = Vec::new();
        for component in components(system, electrical) {
            match component.as_slice() {
                [mode] if *mode < assembly.modes => pieces.extend(
                    single_mode(system, *mode, &assembly)
                        .into_iter()
                        .map(|block| ComponentBlock { block, exact: true }),
                ),
                states => pieces.extend(coupled(states, &assembly)?),
            }
        }
        // Pairs precede reals, each in the order of its component, so the layout depends only on
        // the system.
        pieces.sort_by_key(|piece| matches!(piece.block, PieceBlock::Real(..)));
        Self::gather(pieces, &assembly)
    }

    fn gather(pieces: Vec<ComponentBlock>, assembly: &CoupledMatrix) -> Result<Self, PlantError> {
        let n = assembly.scale.len();
        let (mut block, mut columns) = (BlockDiagonal::default(), Vec::with_capacity(n));
        let exact: Vec<bool> = pieces.iter().map(|piece| piece.exact).collect();
        for piece in pieces {
            match piece.block {
                PieceBlock::Pair(pair, [u, v]) => {
                    block.pairs.push(pair);
                    columns.extend([u, v]);
                }
                PieceBlock::Real(rate, column) => {
                    block.reals.push(rate);
                    columns.push(column);
                }
            }
        }
        let vectors = Mat::from_fn(n, n, |i, j| columns[j][i]);
        let singular = jounce_linalg::singular_values(&vectors)
            .ok_or(PlantError::NoEigenvalues { states: n })?;
        let condition = singular[0] / singular[n - 1];
        if condition.is_nan() || condition > MAX_CONDITION {
            return Err(PlantError::Defective {
                condition,
                allowed: MAX_CONDITION,
            });
        }
        let inverse = jounce_linalg::inverse(&vectors);
        polish(
            &mut block,
            &exact,
            &(&inverse * &assembly.matrix * &vectors),
        );
        let (scale, mut columns, mut rows) = (&assembly.scale, vectors, inverse);
        assembly
            .paths
            .iter()
            .for_each(|path| path.leave(&mut columns));
        assembly
            .paths
            .iter()
            .for_each(|path| path.leave_columns(&mut rows));
        Ok(Self {
            block,
            to_physical: Mat::from_fn(n, n, |i, j| columns[(i, j)] / scale[i]),
            from_physical: Mat::from_fn(n, n, |i, j| rows[(i, j)] * scale[j]),
        })
    }
}

/// Replaces each computed eigenvalue by the diagonal of `T^-1 A T`, the Rayleigh correction. It
/// gives low frequencies their own relative roundoff, while the eigenvalue solver does so only for
/// the largest. Closed forms and the eigenvalues of nearly defective pairs are retained: near
/// critical damping the roundoff of the product would exceed the difference of their rates.
fn polish(block: &mut BlockDiagonal, exact: &[bool], transformed: &Mat<f64>) {
    for (k, pair) in block
        .pairs
        .iter_mut()
        .enumerate()
        .filter(|(k, _)| !exact[*k])
    {
        let (u, v) = (2 * k, 2 * k + 1);
        match pair {
            BlockPair::Oscillatory { decay, frequency } => {
                *decay = 0.5 * (transformed[(u, u)] + transformed[(v, v)]);
                *frequency = 0.5 * (transformed[(v, u)] - transformed[(u, v)]);
            }
            BlockPair::FreeBody { rate } => *rate = transformed[(v, v)],
            BlockPair::Jordan { .. } => {}
        }
    }
    let pairs = block.pairs.len();
    for (k, rate) in block
        .reals
        .iter_mut()
        .enumerate()
        .filter(|(k, _)| !exact[pairs + k])
    {
        *rate = transformed[(2 * pairs + k, 2 * pairs + k)];
    }
}

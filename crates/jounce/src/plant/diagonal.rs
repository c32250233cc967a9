//! Diagonalisation of the coupled electromechanical system without drive and contact.
//!
//! ```text
//! q_i'' + 2 zeta_i w_i q_i' + w_i^2 q_i = sum_k theta_ik V_k,     C_k V_k' + V_k / R_k + sum_i theta_ik q_i' = 0
//! ```
//!
//! Modes and patches that are coupled to each other form a component. A mode without a patch is its own component and is
//! solved in closed form (free, critically damped and overdamped modes included); a component with patches is solved as a
//! real eigenproblem in the coordinates `(w q, q', sqrt(C) V)`, whose squares are energies, so that its matrix is
//! skew-symmetric but for the losses and its eigenvectors are well conditioned.
//!
//! Validation: `tests/plant.rs` checks the residual of `A T = T J` and the eigenvalues against the secular equation.

use super::{Block, Pair, PlantError, System};
use faer::linalg::solvers::DenseSolveCore;
use faer::{Mat, c64};

/// Largest condition number of the eigenvectors (in energy coordinates) that is accepted.
const CONDITION_ALLOWED: f64 = 1e7;

/// `x = T y` with `x = (q, q', V)`, and the blocks of `A` in `y`.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagonal {
    /// The blocks.
    pub block: Block,
    /// `T`, rows `q_0.., q'_0.., V_0..`; columns as the states of the blocks.
    pub to_physical: Mat<f64>,
    /// `T^-1`.
    pub from_physical: Mat<f64>,
}

/// One block with its columns of `T`, and whether it is known in closed form.
struct Piece {
    block: PieceBlock,
    exact: bool,
}

enum PieceBlock {
    Pair(Pair, [Vec<f64>; 2]),
    Real(f64, Vec<f64>),
}

/// `A` on the physical states, with the scale of each state that makes its square an energy.
struct Assembly {
    matrix: Mat<f64>,
    scale: Vec<f64>,
    modes: usize,
}

impl Diagonal {
    /// Diagonalises the linear part of a system.
    ///
    /// # Errors
    /// [`PlantError::Defective`], [`PlantError::NoEigenvalues`].
    pub fn of(system: &System) -> Result<Self, PlantError> {
        let assembly = Assembly::of(system);
        let mut pieces = Vec::new();
        for component in components(system) {
            match component.as_slice() {
                [mode] if *mode < assembly.modes => {
                    pieces.extend(single_mode(system, *mode, &assembly).into_iter().map(|block| Piece { block, exact: true }))
                }
                states => pieces.extend(coupled(states, &assembly)?.into_iter().map(|block| Piece { block, exact: false })),
            }
        }
        // Pairs come before reals, each in order of its component, so that the layout depends on the system only.
        pieces.sort_by_key(|piece| matches!(piece.block, PieceBlock::Real(..)));
        Self::gather(pieces, &assembly)
    }

    fn gather(pieces: Vec<Piece>, assembly: &Assembly) -> Result<Self, PlantError> {
        let n = assembly.scale.len();
        let (mut block, mut columns) = (Block::default(), Vec::with_capacity(n));
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
        let singular = vectors.singular_values().map_err(|_| PlantError::NoEigenvalues { states: n })?;
        let condition = singular[0] / singular[n - 1];
        if condition.is_nan() || condition > CONDITION_ALLOWED {
            return Err(PlantError::Defective { condition, allowed: CONDITION_ALLOWED });
        }
        let inverse = vectors.partial_piv_lu().inverse();
        polish(&mut block, &exact, &(&inverse * &assembly.scaled() * &vectors));
        let scale = &assembly.scale;
        Ok(Self {
            block,
            to_physical: Mat::from_fn(n, n, |i, j| vectors[(i, j)] / scale[i]),
            from_physical: Mat::from_fn(n, n, |i, j| inverse[(i, j)] * scale[j]),
        })
    }
}

impl Assembly {
    fn of(system: &System) -> Self {
        let modes = &system.modes;
        let (n, patches) = (modes.len(), modes.patch.len());
        let mut matrix = Mat::zeros(2 * n + patches, 2 * n + patches);
        let mut scale = vec![1.0; 2 * n + patches];
        for i in 0..n {
            let (w, zeta) = (modes.frequency_rad_s[i], modes.damping_ratio[i]);
            matrix[(i, n + i)] = 1.0;
            matrix[(n + i, i)] = -w * w;
            matrix[(n + i, n + i)] = -2.0 * zeta * w;
            scale[i] = if w > 0.0 { w } else { 1.0 };
        }
        for (k, (name, patch)) in modes.patch.iter().enumerate() {
            let row = 2 * n + k;
            scale[row] = patch.capacitance_f.sqrt();
            if let Some(load) = system.loads.iter().find(|load| load.patch == *name) {
                matrix[(row, row)] = -1.0 / (load.resistance_ohm * patch.capacitance_f);
            }
            for (i, coupling) in patch.coupling_n_per_v.iter().enumerate() {
                matrix[(n + i, row)] = *coupling;
                matrix[(row, n + i)] = -coupling / patch.capacitance_f;
            }
        }
        Self { matrix, scale, modes: n }
    }

    /// `A` in energy coordinates.
    fn scaled(&self) -> Mat<f64> {
        Mat::from_fn(self.scale.len(), self.scale.len(), |i, j| self.matrix[(i, j)] * self.scale[i] / self.scale[j])
    }
}

/// Groups of states that are coupled: each a list of modes (below `n`) and voltages (from `2 n` on).
fn components(system: &System) -> Vec<Vec<usize>> {
    let n = system.modes.len();
    let mut groups: Vec<Vec<usize>> = (0..n).map(|mode| vec![mode]).collect();
    for (k, patch) in system.modes.patch.values().enumerate() {
        let touches = |group: &Vec<usize>| group.iter().any(|&state| state < n && patch.coupling_n_per_v[state] != 0.0);
        let (mut joined, apart): (Vec<_>, Vec<_>) = groups.into_iter().partition(touches);
        joined.push(vec![2 * n + k]);
        groups = apart;
        groups.push(joined.concat());
    }
    groups.iter_mut().for_each(|group| group.sort_unstable());
    groups.sort();
    groups
}

/// Closed form of a mode that drives no patch, in energy coordinates `(w q, q')`.
fn single_mode(system: &System, mode: usize, assembly: &Assembly) -> Vec<PieceBlock> {
    let (w, zeta) = (system.modes.frequency_rad_s[mode], system.modes.damping_ratio[mode]);
    let column = |displacement: f64, velocity: f64| {
        let mut column = vec![0.0; assembly.scale.len()];
        column[mode] = displacement;
        column[assembly.modes + mode] = velocity;
        column
    };
    if w == 0.0 {
        return vec![PieceBlock::Pair(Pair::Jordan { rate: 0.0 }, [column(1.0, 0.0), column(0.0, 1.0)])];
    }
    if zeta == 1.0 {
        return vec![PieceBlock::Pair(Pair::Jordan { rate: -w }, [column(1.0, -1.0), column(0.0, 1.0 / w)])];
    }
    let decay = -zeta * w;
    if zeta < 1.0 {
        let frequency = w * ((1.0 - zeta) * (1.0 + zeta)).sqrt();
        let pair = Pair::Oscillatory { decay, frequency };
        return vec![PieceBlock::Pair(pair, [column(1.0, decay / w), column(0.0, -frequency / w)])];
    }
    let fast = decay - w * ((zeta - 1.0) * (zeta + 1.0)).sqrt();
    // The product of the two rates is w^2: no cancellation in the slow one.
    [fast, w * w / fast]
        .into_iter()
        .map(|rate| PieceBlock::Real(rate, column(1.0_f64.min(w / rate.abs()), rate / w * 1.0_f64.min(w / rate.abs()))))
        .collect()
}

/// Eigenvectors of a component with patches, in energy coordinates.
fn coupled(states: &[usize], assembly: &Assembly) -> Result<Vec<PieceBlock>, PlantError> {
    let n = assembly.modes;
    let all: Vec<usize> = states.iter().flat_map(|&s| if s < n { vec![s, n + s] } else { vec![s] }).collect();
    let scaled = assembly.scaled();
    let local = Mat::from_fn(all.len(), all.len(), |i, j| scaled[(all[i], all[j])]);
    let eigen = local.eigen().map_err(|_| PlantError::NoEigenvalues { states: all.len() })?;
    let (values, vectors) = (eigen.S().column_vector(), eigen.U());
    let column = |j: usize, part: fn(c64) -> f64| {
        let mut column = vec![0.0; assembly.scale.len()];
        all.iter().enumerate().for_each(|(i, &state)| column[state] = part(vectors[(i, j)]));
        column
    };
    let mut order: Vec<usize> = (0..all.len()).filter(|&j| values[j].im >= 0.0).collect();
    order.sort_by(|&i, &j| values[i].im.total_cmp(&values[j].im).then(values[i].re.total_cmp(&values[j].re)));
    Ok(order
        .into_iter()
        .map(|j| match values[j] {
            c64 { re, im: 0.0 } => PieceBlock::Real(re, column(j, |x| x.re)),
            c64 { re, im } => PieceBlock::Pair(Pair::Oscillatory { decay: re, frequency: im }, [column(j, |x| x.re), column(j, |x| -x.im)]),
        })
        .collect())
}

/// Replaces each computed eigenvalue by the diagonal of `T^-1 A T`: the Rayleigh correction, which holds low frequencies to
/// their own relative roundoff where the eigenvalue solver only holds the largest. Closed forms stay: next to critical damping
/// their difference would drown in the roundoff of the product.
fn polish(block: &mut Block, exact: &[bool], transformed: &Mat<f64>) {
    for (k, pair) in block.pairs.iter_mut().enumerate().filter(|(k, _)| !exact[*k]) {
        let (u, v) = (2 * k, 2 * k + 1);
        if let Pair::Oscillatory { decay, frequency } = pair {
            *decay = 0.5 * (transformed[(u, u)] + transformed[(v, v)]);
            *frequency = 0.5 * (transformed[(v, u)] - transformed[(u, v)]);
        }
    }
    let pairs = block.pairs.len();
    for (k, rate) in block.reals.iter_mut().enumerate().filter(|(k, _)| !exact[pairs + k]) {
        *rate = transformed[(2 * pairs + k, 2 * pairs + k)];
    }
}

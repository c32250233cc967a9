//! Components of the coupled system: groups of coupled states and their eigenvectors.
//!
//! All matrices here are in energy coordinates, `(w q, q', sqrt(C) V, sqrt(L) i)`; coordinates of
//! conducting paths are rotated ([`super::conduction_path`]); see
//! [`crate::plant::diagonal`](crate::plant::Diagonal).

use super::conduction_path::ConductionPath;
use super::coupled_rates::coupled_rates;
use super::eigen_refinement::refined;
use super::free_bodies::FreeBodies;
use super::near_defects::nearly_defective;
use crate::plant::{BlockPair, Electrical, PlantError, System};
use jounce_linalg::{Eigen, Mat, c64, eigen};

/// One block with its columns of `T`, and a flag for eigenvalues that are not corrected: closed
/// forms, and those of a nearly defective pair.
pub(super) struct ComponentBlock {
    pub block: PieceBlock,
    pub exact: bool,
}

/// A block and its columns, in energy coordinates.
pub(super) enum PieceBlock {
    Pair(BlockPair, [Vec<f64>; 2]),
    Real(f64, Vec<f64>),
}

/// `A` in energy coordinates; coordinates of conducting paths are rotated (see [`ConductionPath`]).
pub(super) struct CoupledMatrix {
    pub matrix: Mat<f64>,
    /// Factor of each physical state that makes the square of the state an energy.
    pub scale: Vec<f64>,
    /// Conducting diodes.
    pub paths: Vec<ConductionPath>,
    /// Number of modes.
    pub modes: usize,
    /// Nodes of constant charge.
    open: Vec<usize>,
}

impl CoupledMatrix {
    pub fn of(system: &System, electrical: &Electrical) -> Self {
        let (n, nodes) = (system.modes.len(), electrical.nodes.len());
        let size = 2 * n + electrical.len();
        let rates = coupled_rates(system, electrical);
        let frequencies = system.modes.frequency_rad_s.iter();
        let mut scale: Vec<f64> = frequencies
            .map(|w| if *w > 0.0 { *w } else { 1.0 })
            .chain(std::iter::repeat_n(1.0, n))
            .collect();
        scale.extend(electrical.energy_scale());
        let open = (0..nodes)
            .filter(|node| electrical.is_open(*node))
            .map(|node| 2 * n + node)
            .collect();
        let mut matrix = Mat::from_fn(size, size, |i, j| rates[(i, j)] * scale[i] / scale[j]);
        let paths = ConductionPath::of_all(electrical, 2 * n);
        paths.iter().for_each(|path| path.enter(&mut matrix));
        Self {
            matrix,
            scale,
            paths,
            modes: n,
            open,
        }
    }
}

/// Returns the groups of coupled states, each a list of modes (below `n`) and electrical states
/// (from `2 n` on).
pub(super) fn components(system: &System, electrical: &Electrical) -> Vec<Vec<usize>> {
    let n = system.modes.len();
    let mut groups: Vec<Vec<usize>> = (0..n).map(|mode| vec![mode]).collect();
    for dashpot in &system.dashpots {
        let (joined, separate): (Vec<_>, Vec<_>) = groups
            .into_iter()
            .partition(|group: &Vec<usize>| group.iter().any(|&mode| dashpot.shape[mode] != 0.0));
        groups = separate;
        groups.extend(Some(joined.concat()).filter(|modes| !modes.is_empty()));
    }
    for (k, node) in electrical.nodes.iter().enumerate() {
        let touches = |group: &Vec<usize>| {
            group
                .iter()
                .any(|&state| state < n && node.coupling_n_per_v[state] != 0.0)
        };
        let (mut joined, separate): (Vec<_>, Vec<_>) = groups.into_iter().partition(touches);
        joined.push(vec![2 * n + k]);
        let inductors = electrical
            .inductors
            .iter()
            .enumerate()
            .filter(|(_, inductor)| inductor.node == k);
        joined.push(
            inductors
                .map(|(index, _)| 2 * n + electrical.nodes.len() + index)
                .collect(),
        );
        groups = separate;
        groups.push(joined.concat());
    }
    let linked = electrical
        .links
        .iter()
        .filter_map(|link| Some((link.node, link.to?.0)));
    for (node, other) in linked.chain(electrical.leaking_pairs()) {
        let (joined, separate) = groups.into_iter().partition(|group: &Vec<usize>| {
            group.contains(&(2 * n + node)) || group.contains(&(2 * n + other))
        });
        groups = separate;
        let joined: Vec<Vec<usize>> = joined;
        groups.push(joined.concat());
    }
    groups.iter_mut().for_each(|group| group.sort_unstable());
    groups.sort();
    groups
}

/// Closed form of a mode that drives no patch, in energy coordinates `(w q, q')`; in `(q, q')` for
/// a free body.
pub(super) fn single_mode(
    system: &System,
    mode: usize,
    assembly: &CoupledMatrix,
) -> Vec<PieceBlock> {
    let w = system.modes.frequency_rad_s[mode];
    let friction_per_s: f64 = system
        .dashpots
        .iter()
        .map(|dashpot| dashpot.damping_per_s(mode, mode))
        .sum();
    let column = |displacement: f64, velocity: f64| {
        let mut column = vec![0.0; assembly.scale.len()];
        column[mode] = displacement;
        column[assembly.modes + mode] = velocity;
        column
    };
    if w == 0.0 {
        let rate = 0.0 - friction_per_s;
        return vec![PieceBlock::Pair(
            BlockPair::FreeBody { rate },
            [column(1.0, 0.0), column(0.0, 1.0)],
        )];
    }
    let zeta = system.modes.damping_ratio[mode] + 0.5 * friction_per_s / w;
    if zeta == 1.0 {
        return vec![PieceBlock::Pair(
            BlockPair::Jordan { rate: -w },
            [column(1.0, -1.0), column(0.0, 1.0 / w)],
        )];
    }
    let decay = -zeta * w;
    if zeta < 1.0 {
        let frequency = w * ((1.0 - zeta) * (1.0 + zeta)).sqrt();
        let pair = BlockPair::Oscillatory { decay, frequency };
        return vec![PieceBlock::Pair(
            pair,
            [column(1.0, decay / w), column(0.0, -frequency / w)],
        )];
    }
    let fast = decay - w * ((zeta - 1.0) * (zeta + 1.0)).sqrt();
    // The product of the two rates is w^2, so the slow rate has no cancellation.
    [fast, w * w / fast]
        .into_iter()
        .map(|rate| {
            let displacement = 1.0_f64.min(w / rate.abs());
            PieceBlock::Real(rate, column(displacement, rate / w * displacement))
        })
        .collect()
}

/// Returns the eigenvectors of a component with patches, in energy coordinates.
pub(super) fn coupled(
    states: &[usize],
    assembly: &CoupledMatrix,
) -> Result<Vec<ComponentBlock>, PlantError> {
    let (n, matrix) = (assembly.modes, &assembly.matrix);
    let is_free = |state: &usize| *state < n && matrix[(n + state, *state)] == 0.0;
    let (free, all): (Vec<usize>, Vec<usize>) = states
        .iter()
        .flat_map(|&s| if s < n { vec![s, n + s] } else { vec![s] })
        .partition(is_free);
    let local = Mat::from_fn(all.len(), all.len(), |i, j| matrix[(all[i], all[j])]);
    // A free body has no unique equilibrium due to a charge.
    let charged = match free.is_empty() {
        true => conserved_charges(&all, &local, assembly),
        false => Vec::new(),
    };
    let spread = |value: &dyn Fn(usize) -> f64| {
        let mut column = vec![0.0; assembly.scale.len()];
        all.iter()
            .enumerate()
            .for_each(|(i, &state)| column[state] = value(i));
        column
    };
    let retained = charged
        .iter()
        .map(|state| PieceBlock::Real(0.0, spread(&|i: usize| state[i])));
    let retained: Vec<ComponentBlock> = retained
        .map(|block| ComponentBlock { block, exact: true })
        .collect();
    if retained.len() == all.len() {
        return Ok(retained);
    }
    let basis = complement(&charged, all.len());
    let within = basis.transpose() * &local * &basis;
    let (values, within) = eigenvectors(&within, !assembly.paths.is_empty())
        .ok_or(PlantError::NoEigenvalues { states: all.len() })?;
    let velocity = Mat::from_fn(free.len(), values.len(), |f, j| {
        let rows = all.iter().enumerate();
        rows.map(|(i, state)| within[(i, j)] * matrix[(free[f], *state)])
            .sum()
    });
    let bodies = FreeBodies::new(free, velocity, values.clone());
    let column = |j: usize, part: fn(c64) -> f64| {
        let entry = |i: usize| {
            (0..within.nrows())
                .map(|k| basis[(i, k)] * part(within[(k, j)]))
                .sum::<f64>()
        };
        let mut column = spread(&entry);
        bodies
            .displacements(j)
            .for_each(|(state, moved)| column[state] = part(moved));
        column
    };
    Ok(blocks(&values, &bodies, column, assembly.scale.len())
        .chain(retained)
        .collect())
}

/// Returns the blocks of eigenvalues with their columns.
fn blocks(
    values: &[c64],
    bodies: &FreeBodies,
    column: impl Fn(usize, fn(c64) -> f64) -> Vec<f64>,
    size: usize,
) -> impl Iterator<Item = ComponentBlock> {
    let displaced = |entries: &mut dyn Iterator<Item = (usize, f64)>| {
        let mut column = vec![0.0; size];
        entries.for_each(|(state, entry)| column[state] = entry);
        column
    };
    let block = |j: usize| match (values[j], bodies.coasting(j)) {
        (c64 { re, .. }, Some(mut velocities)) => PieceBlock::Pair(
            BlockPair::FreeBody { rate: re },
            [displaced(&mut velocities), column(j, |x| x.re)],
        ),
        (c64 { re, im: 0.0 }, None) => PieceBlock::Real(re, column(j, |x| x.re)),
        (c64 { re, im }, None) => PieceBlock::Pair(
            BlockPair::Oscillatory {
                decay: re,
                frequency: im,
            },
            [column(j, |x| x.re), column(j, |x| -x.im)],
        ),
    };
    let blocks: Vec<PieceBlock> = by_frequency(values).into_iter().map(block).collect();
    let retained = nearly_defective(&blocks);
    let computed = blocks
        .into_iter()
        .zip(retained)
        .map(|(block, exact)| ComponentBlock { block, exact });
    let constant = bodies.constant().map(|state| ComponentBlock {
        block: PieceBlock::Real(0.0, displaced(&mut std::iter::once((state, 1.0)))),
        exact: true,
    });
    computed.chain(constant).collect::<Vec<_>>().into_iter()
}

/// Returns all eigenvalues and the columns of their eigenvectors, refined where one state may be
/// far faster than the others.
fn eigenvectors(matrix: &Mat<f64>, refine: bool) -> Option<(Vec<c64>, Mat<c64>)> {
    let Eigen {
        values, vectors, ..
    } = eigen(matrix)?;
    Some(if refine {
        refined(matrix, values, vectors)
    } else {
        (values, vectors)
    })
}

/// Returns the indices of the eigenvalues with non-negative imaginary part, in ascending frequency
/// and then decay.
fn by_frequency(values: &[c64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..values.len()).filter(|&j| values[j].im >= 0.0).collect();
    order.sort_by(|&i, &j| {
        values[i]
            .im
            .total_cmp(&values[j].im)
            .then(values[i].re.total_cmp(&values[j].re))
    });
    order
}

/// Returns the equilibria due to the charges of open nodes, `sqrt(C) V = 1` and `w q = theta V /
/// w`, one per open node of a component without free bodies.
fn conserved_charges(all: &[usize], local: &Mat<f64>, assembly: &CoupledMatrix) -> Vec<Vec<f64>> {
    let n = assembly.modes;
    let open = all
        .iter()
        .enumerate()
        .filter(|(_, state)| assembly.open.contains(state));
    let at_rest = |(k, _): (usize, &usize)| {
        let mut state = vec![0.0; all.len()];
        state[k] = 1.0;
        for (i, mode) in all.iter().enumerate().filter(|(_, mode)| **mode < n) {
            if let Some(velocity) = all.iter().position(|state| *state == n + mode) {
                // local[(velocity, i)] = -w, local[(velocity, k)] = theta / sqrt(C)
                state[i] = -local[(velocity, k)] / local[(velocity, i)];
            }
        }
        state
    };
    open.map(at_rest).collect()
}

/// Returns orthonormal columns that span the complement of some states; the identity if there are
/// no such states.
fn complement(states: &[Vec<f64>], size: usize) -> Mat<f64> {
    if states.is_empty() {
        return Mat::identity(size, size);
    }
    let columns = Mat::from_fn(size, states.len(), |i, j| states[j][i]);
    let full = jounce_linalg::orthogonal_factor(&columns);
    Mat::from_fn(size, size - states.len(), |i, j| {
        full[(i, states.len() + j)]
    })
}

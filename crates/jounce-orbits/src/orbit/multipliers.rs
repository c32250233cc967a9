//! Floquet multipliers of a period map.
//!
//! Fast modes decay within a period and a contact hardly moves them. The map of a plant with many
//! modes then consists of the block of the slow modes and small blocks of the fast ones. A block
//! `D` of one or two states, with the rest `r` of its rows and `c` of its columns, moves an
//! eigenvalue `m` of the others by about
//!
//! ```text
//! |dm| = |c| |r| / |m - D|
//! ```
//!
//! Where the product is below a limit, the eigenvalues of the block are computed separately; the
//! remaining ones cost the cube of their number. The map is balanced first: row and column of each
//! state get equal lengths, and no eigenvalue changes.
//!
//! Source: B. N. Parlett and C. Reinsch, Numer. Math. 13 (1969) 293; G. W. Stewart and J. Sun, *Matrix Perturbation Theory* (1990), ch. V.

use super::decoupled_blocks::{balanced, blocks};
use jounce_linalg::{Eigen, Mat, c64, eigen};

/// Largest ratio of the couplings of two eigenvalues to their distance at which a change of the map
/// moves each separately. The terms of third order are at most this squared, relative to the
/// change.
const SEPARATE_COUPLING: f64 = 0.03;

/// Returns the eigenvalues of a period map, largest modulus first; `None` where they do not
/// converge.
pub fn multipliers(map: &Mat<f64>) -> Option<Vec<c64>> {
    let (balanced, _) = balanced(map);
    let (blocks, rest) = blocks(&balanced);
    let values = jounce_linalg::eigenvalues(&part(&balanced, &rest))?;
    Some(with_blocks(&balanced, &blocks, values))
}

/// Returns eigenvalues together with those of decoupled blocks, largest modulus first.
fn with_blocks(map: &Mat<f64>, blocks: &[[usize; 2]], mut values: Vec<c64>) -> Vec<c64> {
    values.extend(
        blocks
            .iter()
            .flat_map(|block| block_eigenvalues(map, *block)),
    );
    values.sort_by(|a, b| b.norm_sqr().total_cmp(&a.norm_sqr()));
    values
}

/// Eigenvalue of a diagonal block of a map, with a radius about zero that bounds every multiplier
/// of the block. The radius is the sum of the largest singular values of the block and of the other
/// blocks in its rows.
///
/// Source: D. G. Feingold and R. S. Varga, Pacific J. Math. 12 (1962) 1241 (Gershgorin's discs of blocks).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EigenvalueDisc {
    /// Eigenvalue.
    pub value: c64,
    /// Radius.
    pub radius: f64,
}

/// Returns one disc for each diagonal block of a map in block coordinates; the first `pairs` blocks
/// have two states.
pub fn discs(map: &Mat<f64>, pairs: usize) -> Vec<EigenvalueDisc> {
    let (map, n) = (balanced(map).0, map.nrows());
    let blocks = (0..pairs)
        .map(|k| [2 * k, 2 * k + 1])
        .chain((2 * pairs..n).map(|k| [k, k]));
    let of_block = |[i, j]: [usize; 2]| {
        let rows = if i == j { vec![i] } else { vec![i, j] };
        let couplings = (0..n).filter(|k| !rows.contains(k)).map(|k| {
            rows.iter()
                .map(|r| map[(*r, k)].powi(2))
                .sum::<f64>()
                .sqrt()
        });
        // The even part of a block rotates, its odd part scales.
        let (a, b, c, d) = (map[(i, i)], map[(i, j)], map[(j, i)], map[(j, j)]);
        let largest = if i == j {
            a.abs()
        } else {
            0.5 * ((a + d).hypot(c - b) + (a - d).hypot(b + c))
        };
        let radius = largest + couplings.sum::<f64>();
        block_eigenvalues(&map, [i, j])
            .into_iter()
            .map(move |value| EigenvalueDisc { value, radius })
            .collect::<Vec<_>>()
    };
    blocks.flat_map(of_block).collect()
}

/// Eigenvalues and eigenvectors of a period map. The eigenvectors leave out the decoupled fast
/// blocks.
#[derive(Debug, Clone)]
pub struct Eigenbasis {
    /// All eigenvalues, largest modulus first.
    pub multipliers: Vec<c64>,
    /// Scale of each state in the balanced map.
    scales: Vec<f64>,
    /// Indices of the states that the basis spans.
    states: Vec<usize>,
    /// Eigenvalues and eigenvectors of the basis.
    eigen: Eigen,
}

impl Eigenbasis {
    /// Computes the basis of a map; `None` where the eigenvalues do not converge.
    pub fn of(map: &Mat<f64>) -> Option<Self> {
        let (balanced, scales) = balanced(map);
        let (blocks, states) = blocks(&balanced);
        let eigen = eigen(&part(&balanced, &states))?;
        Some(Self {
            multipliers: with_blocks(&balanced, &blocks, eigen.values.clone()),
            scales,
            states,
            eigen,
        })
    }

    /// Returns the eigenvalues of a map that differs slightly, largest modulus first, by
    /// perturbation to second order. Where the difference does not move each eigenvalue separately,
    /// all are computed anew; `None` where they do not converge.
    ///
    /// ```text
    /// m_i = C_ii + sum_j C_ij C_ji / (C_ii - C_jj),   C = V^-1 B V
    /// ```
    ///
    /// Source: G. W. Stewart and J. Sun, *Matrix Perturbation Theory* (1990), ch. IV.
    pub fn multipliers_of(&self, nearby: &Mat<f64>) -> Option<Vec<c64>> {
        let all: Vec<usize> = (0..nearby.nrows()).collect();
        let scaled = self.part(nearby, &all);
        // A block that is decoupled in one map need not be decoupled in the other.
        let (blocks, states) = blocks(&scaled);
        let values = if states == self.states {
            self.perturbed(&part(&scaled, &states))
        } else {
            None
        };
        match values {
            Some(values) => Some(with_blocks(&scaled, &blocks, values)),
            None => multipliers(nearby),
        }
    }

    /// Returns the eigenvalues of a map over the states of the basis, in its scales, by perturbation
    /// to second order; `None` where they are not separate.
    fn perturbed(&self, map: &Mat<f64>) -> Option<Vec<c64>> {
        let transformed = self.eigen.transformed(map);
        let second_order = |i: usize| {
            let others = (0..self.states.len()).filter(|j| *j != i);
            let mut sum = c64::new(0.0, 0.0);
            for j in others {
                let distance = transformed[(i, i)] - transformed[(j, j)];
                let product = transformed[(i, j)] * transformed[(j, i)];
                let is_separate =
                    product.norm_sqr() < (SEPARATE_COUPLING.powi(2) * distance.norm_sqr()).powi(2);
                if !is_separate {
                    return None;
                }
                sum += product / distance;
            }
            Some(transformed[(i, i)] + sum)
        };
        (0..self.states.len()).map(second_order).collect()
    }

    /// Returns the basis of the same map over more states.
    fn extended(&self, map: &Mat<f64>, more: &[usize]) -> Option<Self> {
        let mut basis = self.clone();
        basis.states.extend(more);
        basis.eigen = eigen(&basis.part(map, &basis.states))?;
        Some(basis)
    }

    /// Returns the rows and columns of another map for some states, in the scales of the basis.
    fn part(&self, map: &Mat<f64>, states: &[usize]) -> Mat<f64> {
        let mut part = part(map, states);
        for (j, to) in states.iter().enumerate() {
            for (i, from) in states.iter().enumerate() {
                part[(i, j)] *= self.scales[*to] / self.scales[*from];
            }
        }
        part
    }

    /// Returns the couplings of the eigenvalues in another map `B`: `sqrt |C_ij C_ji|` with
    /// `C = V^-1 B V` and the eigenvectors `V`. Two equal eigenvalues split by their coupling.
    /// `other` is the basis of `B`, `map` the map of this basis. The rows follow the order of its
    /// eigenvalues.
    ///
    /// Source: G. W. Stewart and J. Sun, *Matrix Perturbation Theory* (1990), ch. V.
    pub fn couplings(
        &self,
        map: &Mat<f64>,
        (other, beyond): (&Self, &Mat<f64>),
    ) -> Option<(Vec<c64>, Mat<f64>)> {
        // A block that is decoupled in one map need not be decoupled in the other.
        let more: Vec<usize> = other
            .states
            .iter()
            .copied()
            .filter(|k| !self.states.contains(k))
            .collect();
        if !more.is_empty() {
            return self.extended(map, &more)?.couplings(map, (other, beyond));
        }
        let n = self.states.len();
        let transformed = self.eigen.transformed(&self.part(beyond, &self.states));
        Some((
            self.eigen.values.clone(),
            Mat::from_fn(n, n, |i, j| {
                let product = transformed[(i, j)] * transformed[(j, i)];
                product.norm_sqr().sqrt().sqrt()
            }),
        ))
    }
}

/// Returns the rows and columns of some states.
fn part(map: &Mat<f64>, states: &[usize]) -> Mat<f64> {
    Mat::from_fn(states.len(), states.len(), |i, j| {
        map[(states[i], states[j])]
    })
}

/// Returns the eigenvalues of a block.
fn block_eigenvalues(map: &Mat<f64>, [i, j]: [usize; 2]) -> Vec<c64> {
    if i == j {
        return vec![c64::new(map[(i, i)], 0.0)];
    }
    let (mean, half) = (
        0.5 * (map[(i, i)] + map[(j, j)]),
        0.5 * (map[(i, i)] - map[(j, j)]),
    );
    let root = c64::new(half * half + map[(i, j)] * map[(j, i)], 0.0).sqrt();
    vec![root + mean, -root + mean]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A slow pair and a fast decaying one, weakly coupled: the characteristic polynomial at each
    /// multiplier.
    #[test]
    fn fast_pair_is_decoupled() {
        let weak = 1e-7;
        let rows = [
            [0.6, -0.7, weak, 0.0],
            [0.7, 0.6, 0.0, weak],
            [weak, weak, 3e-4, -4e-4],
            [0.0, weak, 4e-4, 3e-4],
        ];
        let map = Mat::from_fn(4, 4, |i, j| rows[i][j]);
        let (decoupled_blocks, rest) = blocks(&balanced(&map).0);
        assert!(
            decoupled_blocks.contains(&[2, 3]) && !rest.contains(&2),
            "{decoupled_blocks:?} {rest:?}"
        );
        let values = multipliers(&map).unwrap_or_default();
        // To first order in the product of the couplings.
        let exact = [
            c64::new(0.6, 0.7),
            c64::new(0.6, -0.7),
            c64::new(3e-4, 4e-4),
            c64::new(3e-4, -4e-4),
        ];
        for exact in exact {
            let difference = values
                .iter()
                .map(|value| (value - exact).norm())
                .fold(f64::INFINITY, f64::min);
            assert!(difference < 1e-13, "{exact}: {difference:e} {values:?}");
        }
    }

    /// Map of a slow and a fast pair and a real multiplier, coupled.
    fn two_pairs_and_a_real_one() -> Mat<f64> {
        let rows = [
            [0.6, -0.7, 0.02, 0.0, 0.1],
            [0.7, 0.6, 0.0, 0.03, 0.0],
            [0.02, 0.01, 0.3, -0.4, 0.0],
            [0.0, 0.03, 0.4, 0.3, 0.0],
            [0.0, 0.1, 0.0, 0.0, 0.5],
        ];
        Mat::from_fn(5, 5, |i, j| rows[i][j])
    }

    /// The multipliers of a nearby map by perturbation against those computed anew: a difference of
    /// 1e-3 leaves terms of third order; where two multipliers are equal, both are computed anew.
    #[test]
    fn multipliers_of_a_nearby_map_follow_from_the_eigenvectors() {
        let map = two_pairs_and_a_real_one();
        let double = Mat::from_fn(2, 2, |i, j| [[0.5, 1.0], [0.0, 0.5]][i][j]);
        for (map, limit) in [(map, 1e-8), (double, 1e-14)] {
            let n = map.nrows();
            let change = |i: usize, j: usize| 1e-3 * ((3 * i + 5 * j) as f64).sin();
            let nearby = Mat::from_fn(n, n, |i, j| map[(i, j)] + change(i, j));
            let values = Eigenbasis::of(&map)
                .and_then(|basis| basis.multipliers_of(&nearby))
                .unwrap_or_default();
            for exact in multipliers(&nearby).unwrap_or_default() {
                let distances = values.iter().map(|value| (value - exact).norm());
                let difference = distances.fold(f64::INFINITY, f64::min);
                assert!(difference < limit, "{exact}: {difference:e} {values:?}");
            }
        }
    }

    /// Every multiplier lies in the union of the discs, and the fast pair in its own disc.
    #[test]
    fn discs_hold_the_multipliers() {
        let map = two_pairs_and_a_real_one();
        let discs = discs(&map, 2);
        assert_eq!(discs.len(), 5);
        let (fast, widest) = (
            discs[2].radius,
            discs.iter().map(|disc| disc.radius).fold(0.0, f64::max),
        );
        assert!(
            fast < 0.6 && (discs[2].value.norm() - 0.5).abs() < 1e-12,
            "{discs:?}"
        );
        let values = multipliers(&map).unwrap_or_default();
        assert_eq!(
            values.iter().filter(|value| value.norm() <= fast).count(),
            3
        );
        assert!(values.iter().all(|value| value.norm() <= widest));
    }

    /// Scales of very different size have no effect: the companion matrix of
    /// `(s - 1)(s - 2)(s - 3)`.
    #[test]
    fn a_badly_scaled_map_keeps_its_multipliers() {
        let rows = [[6.0, -11.0, 6.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let scale = [1.0, 1e6, 1e-5];
        let map = Mat::from_fn(3, 3, |i, j| rows[i][j] * scale[i] / scale[j]);
        let values = multipliers(&map).unwrap_or_default();
        for (value, exact) in values.iter().zip([3.0, 2.0, 1.0]) {
            assert!((value - exact).norm() < 1e-12, "{values:?}");
        }
    }
}

//! Block Lanczos iteration with complete reorthogonalisation and thick restarts.
//!
//! The operator `A = (K - sigma M)^-1 M` is symmetric in the inner product `x^T M y`. The iteration
//! builds blocks `Q_1, Q_2, ...`, orthonormal in this product, with
//!
//! ```text
//! A Q_j = sum_(i <= j) Q_i T_ij + Q_(j+1) R_j
//! ```
//!
//! Eigenpairs `(theta, s)` of `T` give approximate eigenpairs `(theta, Q s)` of `A`, with the residual
//! `|R_j s_j|`, where `s_j` is the part of `s` in the last block. A restart retains some of them as
//! the first blocks (K. Wu, H. Simon, SIAM J. Matrix Anal. Appl. 22 (2000) 602).

use crate::SymmetricMatrix;
use crate::block::{Block, LANES, Small, add_product, gram, random};
use crate::factor::Factor;
use jounce_linalg::{Mat, symmetric_eigen};

/// Part of a vector that remains after projection, relative to it, below which it is roundoff.
const DEPENDENT: f64 = 1e-12;

/// Square of the part of a vector outside the basis and the others of its block, relative to it, above
/// which one orthonormalisation leaves it orthogonal to roundoff.
const WELL_CONDITIONED: f64 = 0.1;

/// Approximate eigenpairs of the operator, `theta` descending.
#[derive(Debug)]
pub(crate) struct Ritz {
    pub(crate) theta: Vec<f64>,
    /// Residuals `|A x - theta x|` in the norm of the mass.
    pub(crate) residual: Vec<f64>,
    /// Coefficients of the basis, one column per pair.
    coefficients: Mat<f64>,
}

/// The Krylov space of one shift.
#[derive(Debug)]
pub(crate) struct Krylov<'a> {
    factor: &'a Factor<'a>,
    mass: &'a SymmetricMatrix,
    /// Orthonormal blocks; the operator has not been applied to the last one.
    basis: Vec<Block>,
    /// `T_ij` for `i <= j`, by columns `j`.
    projection: Vec<Vec<Small>>,
    /// `R_j` of the last application.
    coupling: Small,
    /// Number of vectors other than zero in the basis.
    dimension: usize,
    /// Number of blocks solved.
    pub(crate) solves: usize,
    seed: u64,
}

impl<'a> Krylov<'a> {
    pub(crate) fn new(factor: &'a Factor<'a>, mass: &'a SymmetricMatrix) -> Self {
        let mut space = Self {
            factor,
            mass,
            basis: Vec::new(),
            projection: Vec::new(),
            coupling: [[0.0; LANES]; LANES],
            dimension: 0,
            solves: 0,
            seed: 0,
        };
        space.append_random();
        space
    }

    /// Number of blocks to which the operator was applied.
    pub(crate) fn blocks(&self) -> usize {
        self.projection.len()
    }

    /// The number of all finite eigenvalues, if the basis spans all of them.
    pub(crate) fn exhausted(&self) -> Option<usize> {
        let next = &self.basis[self.blocks()];
        let is_zero = next.iter().all(|row| row.iter().all(|value| *value == 0.0));
        is_zero.then_some(self.dimension)
    }

    /// Returns `A X`.
    pub(crate) fn apply(&mut self, x: &Block) -> Block {
        self.solves += 1;
        self.factor.solve_block(&self.mass.block_product(x))
    }

    /// Applies the operator to the last block and appends the next one.
    pub(crate) fn extend(&mut self) {
        let last = self.basis[self.blocks()].clone();
        let mut image = self.apply(&last);
        let size = self.norms(&image);
        let column = self.project_out(&mut image);
        self.projection.push(column);
        let next = self.orthonormalised(image.clone(), size);
        self.coupling = gram(&next, &self.mass.block_product(&image));
        self.append(next);
    }

    /// Appends a block of random directions, for what the present ones cannot reach.
    fn append_random(&mut self) {
        let (start, size) = self.random_directions();
        let block = self.orthonormalised(start, size);
        self.append(block);
    }

    fn append(&mut self, block: Block) {
        let norms = gram(&block, &self.mass.block_product(&block));
        self.dimension += (0..LANES).filter(|lane| norms[*lane][*lane] > 0.5).count();
        self.basis.push(block);
    }

    /// Random vectors without massless parts, orthogonal to the basis; with their norms before.
    fn random_directions(&mut self) -> (Block, [f64; LANES]) {
        self.seed += 1;
        let start = random(self.mass.size(), self.seed);
        let mut block = self.apply(&start);
        let size = self.norms(&block);
        self.project_out(&mut block);
        (block, size)
    }

    /// Norms of the vectors of a block in the inner product of the mass.
    fn norms(&self, block: &Block) -> [f64; LANES] {
        let squares = gram(block, &self.mass.block_product(block));
        std::array::from_fn(|lane| squares[lane][lane].max(0.0).sqrt())
    }

    /// Makes a block orthogonal to the basis, and returns the coefficients that were removed.
    fn project_out(&self, block: &mut Block) -> Vec<Small> {
        let mut removed = vec![[[0.0; LANES]; LANES]; self.basis.len()];
        // The second pass removes what roundoff of the first one leaves.
        for _ in 0..2 {
            let momentum = self.mass.block_product(block);
            for (q, removed) in self.basis.iter().zip(&mut removed) {
                let coefficients = gram(q, &momentum);
                add_product(block, -1.0, q, &coefficients);
                for (sum, row) in removed.iter_mut().zip(coefficients) {
                    sum.iter_mut()
                        .zip(row)
                        .for_each(|(sum, entry)| *sum += entry);
                }
            }
        }
        removed
    }

    /// Makes the vectors of a block, which is orthogonal to the basis, orthonormal. Random vectors
    /// replace dependent ones; zeros do where the basis is complete. `size` holds the norms before
    /// the projection.
    fn orthonormalised(&mut self, mut block: Block, mut size: [f64; LANES]) -> Block {
        let mut attempts = [0; LANES];
        loop {
            let products = gram(&block, &self.mass.block_product(&block));
            let (factor, smallest, dependent) = inverse_factor(&products, &size);
            let replaced = (0..LANES).filter(|lane| dependent[*lane] && attempts[*lane] < 2);
            let replaced: Vec<usize> = replaced.collect();
            if !replaced.is_empty() {
                let (fresh, fresh_size) = self.random_directions();
                for lane in replaced {
                    attempts[lane] += 1;
                    size[lane] = fresh_size[lane];
                    block
                        .iter_mut()
                        .zip(&fresh)
                        .for_each(|(row, new)| row[lane] = new[lane]);
                }
                continue;
            }
            let mut orthonormal = vec![[0.0; LANES]; block.len()];
            add_product(&mut orthonormal, 1.0, &block, &factor);
            block = orthonormal;
            if smallest > WELL_CONDITIONED {
                return block;
            }
            self.project_out(&mut block);
            size = [1.0; LANES];
        }
    }

    /// Returns the approximate eigenpairs of the present basis; `None` without convergence of the
    /// small eigenproblem.
    pub(crate) fn ritz(&self) -> Option<Ritz> {
        let n = LANES * self.blocks();
        let lower = Mat::from_fn(n, n, |i, j| {
            let (row, column) = (i.min(j), i.max(j));
            self.projection[column / LANES][row / LANES][row % LANES][column % LANES]
        });
        let (values, vectors) = symmetric_eigen(&lower)?;
        let coefficients = Mat::from_fn(n, n, |i, k| vectors[(i, n - 1 - k)]);
        let residual = |k: usize| {
            let last = |lane: usize| coefficients[(n - LANES + lane, k)];
            let row = |row: &[f64; LANES]| -> f64 {
                row.iter()
                    .enumerate()
                    .map(|(lane, entry)| entry * last(lane))
                    .sum()
            };
            self.coupling
                .iter()
                .map(|r| row(r).powi(2))
                .sum::<f64>()
                .sqrt()
        };
        Some(Ritz {
            theta: values.into_iter().rev().collect(),
            residual: (0..n).map(residual).collect(),
            coefficients,
        })
    }

    /// Returns the vectors of four pairs from `first`; zeros beyond the last pair.
    pub(crate) fn vectors(&self, ritz: &Ritz, first: usize) -> Block {
        let mut block = vec![[0.0; LANES]; self.mass.size()];
        for (index, q) in self.basis[..self.blocks()].iter().enumerate() {
            let entry = |i: usize, k: usize| {
                ritz.coefficients
                    .get((LANES * index + i, first + k))
                    .copied()
                    .unwrap_or(0.0)
            };
            let small = std::array::from_fn(|i| std::array::from_fn(|k| entry(i, k)));
            add_product(&mut block, 1.0, q, &small);
        }
        block
    }

    /// Restarts with the first `pairs` pairs, and with the next block or, for directions that the
    /// space does not contain, with random vectors.
    pub(crate) fn restart(&mut self, ritz: &Ritz, pairs: usize, with_random: bool) {
        let blocks = pairs.div_ceil(LANES);
        let retained: Vec<Block> = (0..blocks)
            .map(|block| self.vectors(ritz, LANES * block))
            .collect();
        let next = self.basis.pop();
        self.projection = (0..blocks)
            .map(|column| diagonal_column(ritz, column))
            .collect();
        self.basis = Vec::new();
        self.dimension = 0;
        retained.into_iter().for_each(|block| self.append(block));
        match next {
            Some(next) if !with_random => self.append(next),
            _ => self.append_random(),
        }
    }
}

/// Column `column` of blocks of the diagonal matrix of `theta`, down to the diagonal.
fn diagonal_column(ritz: &Ritz, column: usize) -> Vec<Small> {
    let theta = |lane: usize| {
        ritz.theta
            .get(LANES * column + lane)
            .copied()
            .unwrap_or(0.0)
    };
    let entry = |i: usize, j: usize| if i == j { theta(i) } else { 0.0 };
    let diagonal = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
    let zeros = std::iter::repeat_n([[0.0; LANES]; LANES], column);
    zeros.chain([diagonal]).collect()
}

/// For the products `G = W^T M W`: the upper triangular `S` with `S^T G S = 1`; the square of the
/// smallest part of a vector outside the basis or outside those before it, relative to the vector; and
/// the vectors that depend on others, whose columns of `S` are zero.
fn inverse_factor(products: &Small, size: &[f64; LANES]) -> (Small, f64, [bool; LANES]) {
    let product = |a: &[f64; LANES], b: &[f64; LANES]| -> f64 {
        let row = |i: usize| a[i] * (0..LANES).map(|j| products[i][j] * b[j]).sum::<f64>();
        (0..LANES).map(row).sum()
    };
    let mut columns = [[0.0; LANES]; LANES];
    let mut dependent = [false; LANES];
    let mut smallest: f64 = 1.0;
    for lane in 0..LANES {
        // Gram-Schmidt on coefficients: a unit vector minus its parts along the columns before.
        let unit: [f64; LANES] = std::array::from_fn(|i| f64::from(u8::from(i == lane)));
        let mut rest = unit;
        for before in &columns[..lane] {
            let along = product(before, &unit);
            rest.iter_mut()
                .zip(before)
                .for_each(|(rest, entry)| *rest -= along * entry);
        }
        let (complete, square) = (products[lane][lane], product(&rest, &rest));
        let roundoff = (DEPENDENT * size[lane]).powi(2);
        dependent[lane] =
            complete.is_nan() || complete <= roundoff || square <= DEPENDENT * complete;
        if !dependent[lane] {
            let remaining = complete / size[lane].powi(2);
            smallest = smallest.min(square / complete).min(remaining);
            columns[lane] = rest.map(|entry| entry / square.sqrt());
        }
    }
    let inverse = std::array::from_fn(|i| columns.map(|column| column[i]));
    (inverse, smallest, dependent)
}

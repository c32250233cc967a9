//! Numeric factorisation and solution.

use super::front::{eliminate, leading_columns};
use super::symbolic::{Supernode, Symbolic};
use super::tree::ROOT;
use crate::block::{Block, LANES, add_scaled};
use crate::{SparseError, SymmetricMatrix};
use jounce_linalg::{Mat, column};

/// `L` and `D` of `P A P^T = L D L^T`.
#[derive(Debug)]
pub struct Factor<'a> {
    symbolic: &'a Symbolic,
    /// Columns of `L` of each supernode, from its diagonal block down.
    columns: Vec<Mat<f64>>,
    /// Diagonal of `D`, in the order of the factor.
    pivots: Vec<f64>,
}

impl Symbolic {
    /// Factors a matrix with the pattern of this structure, or a part of it.
    ///
    /// # Errors
    /// `Singular` if a pivot vanishes to roundoff.
    ///
    /// # Limits
    /// Rows are not exchanged for size: exact for definite matrices; for indefinite ones accuracy is
    /// lost if a leading block is nearly singular.
    pub fn factor(&self, matrix: &SymmetricMatrix) -> Result<Factor<'_>, SparseError> {
        let size = matrix.size();
        let mut factor = Factor {
            symbolic: self,
            columns: Vec::with_capacity(self.supernodes.len()),
            pivots: Vec::with_capacity(size),
        };
        // What each child adds to its parent, until the parent takes it.
        let mut children: Vec<Vec<(usize, Mat<f64>)>> = vec![Vec::new(); self.supernodes.len()];
        let mut position = vec![ROOT; size];
        for (index, node) in self.supernodes.iter().enumerate() {
            let mut front = self.assembled(matrix, node, &mut position);
            for (child, update) in std::mem::take(&mut children[index]) {
                add_update(
                    &mut front,
                    &self.supernodes[child].below,
                    &update,
                    &position,
                );
            }
            let scale = |k: usize| {
                let row = self.ordering.order[k];
                matrix.entry(row, row).abs()
            };
            let scales: Vec<f64> = (node.first..node.first + node.columns).map(scale).collect();
            let pivots = eliminate(&mut front, node.columns, &scales).map_err(|column| {
                SparseError::Singular {
                    row: self.ordering.order[node.first + column],
                }
            })?;
            factor.pivots.extend(pivots);
            factor.columns.push(leading_columns(&front, node.columns));
            if node.parent != ROOT {
                let left = front
                    .remove_rows(0, node.columns)
                    .remove_columns(0, node.columns);
                children[node.parent].push((index, left));
            }
        }
        Ok(factor)
    }

    /// The front of a supernode with the entries of the matrix; `position` then holds the row of the
    /// front of each row of the factor.
    fn assembled(
        &self,
        matrix: &SymmetricMatrix,
        node: &Supernode,
        position: &mut [usize],
    ) -> Mat<f64> {
        let mut front = Mat::zeros(node.rows(), node.rows());
        for (row, k) in (node.first..)
            .take(node.columns)
            .chain(node.below.iter().copied())
            .enumerate()
        {
            position[k] = row;
        }
        for j in 0..node.columns {
            let k = node.first + j;
            for (column, value) in matrix.row(self.ordering.order[k]) {
                let i = self.ordering.place[column];
                if i >= k {
                    front[(position[i], j)] = value;
                }
            }
        }
        front
    }
}

/// Adds the Schur complement of a child, on the rows `rows`, to the lower triangle of a front.
fn add_update(front: &mut Mat<f64>, rows: &[usize], update: &Mat<f64>, position: &[usize]) {
    let height = front.nrows();
    let places: Vec<usize> = rows.iter().map(|row| position[*row]).collect();
    for (b, target) in places.iter().enumerate() {
        let target = &mut front.as_mut_slice()[target * height..(target + 1) * height];
        for (place, value) in places[b..].iter().zip(&column(update, b)[b..]) {
            target[*place] += value;
        }
    }
}

impl Factor<'_> {
    /// Returns the number of negative pivots: that of the negative eigenvalues of the matrix.
    pub fn negative(&self) -> usize {
        self.pivots.iter().filter(|pivot| **pivot < 0.0).count()
    }

    /// Solves `A x = b`.
    pub fn solve(&self, right: &[f64]) -> Vec<f64> {
        let block = right.iter().map(|value| [*value, 0.0, 0.0, 0.0]).collect();
        self.solve_block(&block).iter().map(|row| row[0]).collect()
    }

    /// Solves `A X = B` for a block of vectors.
    pub(crate) fn solve_block(&self, right: &Block) -> Block {
        let order = &self.symbolic.ordering.order;
        let mut x: Block = order.iter().map(|row| right[*row]).collect();
        for (node, lower) in self.symbolic.supernodes.iter().zip(&self.columns) {
            solve_lower(node, lower, &mut x);
        }
        for (row, pivot) in x.iter_mut().zip(&self.pivots) {
            row.iter_mut().for_each(|value| *value /= pivot);
        }
        for (node, lower) in self.symbolic.supernodes.iter().zip(&self.columns).rev() {
            solve_transposed(node, lower, &mut x);
        }
        let mut solution = vec![[0.0; LANES]; x.len()];
        for (row, value) in order.iter().zip(x) {
            solution[*row] = value;
        }
        solution
    }
}

/// Solves the columns of one supernode in `L X = B` and subtracts their products from the rows below.
fn solve_lower(node: &Supernode, lower: &Mat<f64>, x: &mut Block) {
    let own = node.first..node.first + node.columns;
    let mut below = vec![[0.0; LANES]; node.below.len()];
    for j in 0..node.columns {
        let (diagonal, rest) = column(lower, j).split_at(node.columns);
        let solved = x[node.first + j];
        let rows = x[own.clone()].iter_mut().zip(diagonal).skip(j + 1);
        rows.for_each(|(row, entry)| add_scaled(row, -entry, &solved));
        below
            .iter_mut()
            .zip(rest)
            .for_each(|(sum, entry)| add_scaled(sum, *entry, &solved));
    }
    for (row, sum) in node.below.iter().zip(&below) {
        add_scaled(&mut x[*row], -1.0, sum);
    }
}

/// Solves the columns of one supernode in `L^T X = B`, whose rows below are solved.
fn solve_transposed(node: &Supernode, lower: &Mat<f64>, x: &mut Block) {
    let below: Block = node.below.iter().map(|row| x[*row]).collect();
    for j in (0..node.columns).rev() {
        let (diagonal, rest) = column(lower, j).split_at(node.columns);
        let mut sum = [0.0; LANES];
        let own = &x[node.first..node.first + node.columns];
        let above = own.iter().zip(diagonal).skip(j + 1);
        above.for_each(|(row, entry)| add_scaled(&mut sum, *entry, row));
        below
            .iter()
            .zip(rest)
            .for_each(|(row, entry)| add_scaled(&mut sum, *entry, row));
        add_scaled(&mut x[node.first + j], -1.0, &sum);
    }
}

//! Blocks of a period map that couple so weakly that their eigenvalues are their own (see
//! [`super::multipliers`]).

use jounce_linalg::{Mat, column, column_mut};

/// `|c| |r|` below which a block is decoupled: it moves a multiplier of modulus one by at most
/// this, less than the integration error.
const DECOUPLED_BLOCK: f64 = 1e-10;

/// Iterations of balancing.
const BALANCING_ROUNDS: usize = 4;

/// Returns the map with each state scaled by a power of two, so that its row and its column have
/// about equal lengths (without the diagonal), and the scales `d`: `m_ij d_j / d_i`.
pub fn balanced(map: &Mat<f64>) -> (Mat<f64>, Vec<f64>) {
    let n = map.nrows();
    let (mut balanced, mut scales) = (map.clone(), vec![1.0; n]);
    for _ in 0..BALANCING_ROUNDS {
        let mut is_even = true;
        for i in 0..n {
            let (row, column) = lengths(&balanced, i);
            let factor = (0.5 * (row / column).log2()).round().exp2();
            if !factor.is_normal() || factor == 1.0 {
                continue;
            }
            is_even = false;
            scales[i] *= factor;
            column_mut(&mut balanced, i)
                .iter_mut()
                .for_each(|entry| *entry *= factor);
            (0..n).for_each(|j| balanced[(i, j)] /= factor);
        }
        if is_even {
            break;
        }
    }
    (balanced, scales)
}

/// Returns the sums of the magnitudes in a row and in a column, without the diagonal.
fn lengths(map: &Mat<f64>, i: usize) -> (f64, f64) {
    let (diagonal, n) = (map[(i, i)].abs(), map.nrows());
    let row = (0..n).map(|j| map[(i, j)].abs()).sum::<f64>() - diagonal;
    (
        row,
        column(map, i).iter().map(|entry| entry.abs()).sum::<f64>() - diagonal,
    )
}

/// Returns the decoupled blocks of one or two states (a repeated index means one), and the
/// remaining states.
pub fn blocks(map: &Mat<f64>) -> (Vec<[usize; 2]>, Vec<usize>) {
    let square = |i: usize, j: usize| coupling_squared(map, i, j);
    let mut rest: Vec<usize> = (0..map.nrows()).collect();
    let mut squares = squared_lengths(map);
    let partners = strongest_partners(map);
    let is_decoupled = |row: f64, column: f64| row * column < DECOUPLED_BLOCK * DECOUPLED_BLOCK;
    let mut decoupled_blocks = Vec::new();
    loop {
        let decoupled = |i: &usize| {
            let (i, j) = (*i, partners[*i]);
            let [row, column] = squares[i];
            if is_decoupled(row, column) {
                return Some([i, i]);
            }
            let couplings = square(i, j) + square(j, i);
            let is_pair = i < j && partners[j] == i && rest.contains(&j);
            (is_pair
                && is_decoupled(
                    row + squares[j][0] - couplings,
                    column + squares[j][1] - couplings,
                ))
            .then_some([i, j])
        };
        let Some([i, j]) = rest.iter().find_map(decoupled) else {
            return (decoupled_blocks, rest);
        };
        decoupled_blocks.push([i, j]);
        rest.retain(|k| *k != i && *k != j);
        for k in &rest {
            for removed in &[i, j][usize::from(i == j)..] {
                let [row, column] = squares[*k];
                squares[*k] = [
                    (row - square(*k, *removed)).max(0.0),
                    (column - square(*removed, *k)).max(0.0),
                ];
            }
        }
    }
}

/// Returns the square of an entry outside the diagonal, else 0.
fn coupling_squared(map: &Mat<f64>, i: usize, j: usize) -> f64 {
    if i == j {
        0.0
    } else {
        map[(i, j)] * map[(i, j)]
    }
}

/// Returns the squared lengths of each row and each column, without the diagonal.
fn squared_lengths(map: &Mat<f64>) -> Vec<[f64; 2]> {
    let n = map.nrows();
    let mut squares = vec![[0.0; 2]; n];
    for j in 0..n {
        for i in 0..n {
            squares[i][0] += coupling_squared(map, i, j);
            squares[j][1] += coupling_squared(map, i, j);
        }
    }
    squares
}

/// Returns the most strongly coupled partner of each state.
fn strongest_partners(map: &Mat<f64>) -> Vec<usize> {
    let n = map.nrows();
    let (mut partners, mut ties): (Vec<usize>, Vec<f64>) = ((0..n).collect(), vec![0.0; n]);
    for j in 0..n {
        for i in 0..j {
            let tie = (map[(i, j)] * map[(j, i)]).abs();
            if tie > ties[i] {
                (partners[i], ties[i]) = (j, tie);
            }
            if tie > ties[j] {
                (partners[j], ties[j]) = (i, tie);
            }
        }
    }
    partners
}

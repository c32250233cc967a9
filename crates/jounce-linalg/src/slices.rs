//! Columns as slices, and the norm of a slice.

use crate::Mat;
use nalgebra::DVectorView;
use std::ops::Range;

/// Returns a column of a matrix.
pub fn column<T>(matrix: &Mat<T>, j: usize) -> &[T] {
    let rows = matrix.nrows();
    &matrix.data.as_slice()[j * rows..(j + 1) * rows]
}

/// Returns a column of a matrix, to be changed.
pub fn column_mut<T>(matrix: &mut Mat<T>, j: usize) -> &mut [T] {
    let rows = matrix.nrows();
    &mut matrix.data.as_mut_slice()[j * rows..(j + 1) * rows]
}

/// Returns the Euclidean norm.
pub fn norm(vector: &[f64]) -> f64 {
    DVectorView::from_slice(vector, vector.len()).norm()
}

/// Returns the Euclidean distance of two vectors.
pub fn distance(from: &[f64], to: &[f64]) -> f64 {
    let [from, to] = [from, to].map(|slice| DVectorView::from_slice(slice, slice.len()));
    (to - from).norm()
}

/// Adds `A^T A` of the first `rows` rows to the lower triangle of a square matrix.
pub fn add_gram(sum: &mut Mat<f64>, matrix: &Mat<f64>, rows: usize) {
    for j in 0..matrix.ncols() {
        for i in j..matrix.ncols() {
            sum[(i, j)] += dot(&column(matrix, i)[..rows], &column(matrix, j)[..rows]);
        }
    }
}

/// Returns the product of a range of rows with a vector.
pub fn row_product(matrix: &Mat<f64>, rows: Range<usize>, vector: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; rows.len()];
    for (j, factor) in vector.iter().enumerate() {
        for (sum, entry) in product.iter_mut().zip(&column(matrix, j)[rows.clone()]) {
            *sum += factor * entry;
        }
    }
    product
}

/// Adds the product of the transpose of a range of rows with a vector.
pub fn add_transposed_product(
    sum: &mut [f64],
    matrix: &Mat<f64>,
    rows: Range<usize>,
    vector: &[f64],
) {
    for (j, sum) in sum.iter_mut().enumerate() {
        *sum += dot(&column(matrix, j)[rows.clone()], vector);
    }
}

/// Columns per product of [`subtract_lower_product`], so that little is computed above the diagonal.
const STRIP: usize = 64;

/// Subtracts `A B` from the lower triangle of the block of a square matrix that begins at row and
/// column `start`; entries above the diagonal of the block lose their meaning.
pub fn subtract_lower_product(matrix: &mut Mat<f64>, start: usize, a: &Mat<f64>, b: &Mat<f64>) {
    let rows = a.nrows();
    for j in (0..rows).step_by(STRIP) {
        let columns = STRIP.min(rows - j);
        let mut strip = matrix.view_mut((start + j, start + j), (rows - j, columns));
        strip.gemm(-1.0, &a.rows(j, rows - j), &b.columns(j, columns), 1.0);
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    let [a, b] = [a, b].map(|slice| DVectorView::from_slice(slice, slice.len()));
    a.dot(&b)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Several strips, compared with the product of the complete matrices.
    #[test]
    fn lower_triangles_of_products() {
        let a = Mat::from_fn(150, 7, |i, j| ((i * 7 + j * 3) % 11) as f64 - 5.0);
        let b = a.transpose();
        let mut matrix = Mat::from_element(152, 152, 1.0);
        subtract_lower_product(&mut matrix, 2, &a, &b);
        let product = &a * &b;
        let differs = |i: usize, j: usize| matrix[(i + 2, j + 2)] != 1.0 - product[(i, j)];
        assert!(!(0..150).any(|i| (0..=i).any(|j| differs(i, j))));
        assert_eq!(matrix[(151, 1)], 1.0);
    }

    /// Compares with products of whole matrices.
    #[test]
    fn products_of_blocks_of_rows() {
        let matrix = Mat::from_fn(7, 3, |i, j| (i * i + 2 * j) as f64 % 5.0 - 1.0);
        let (top, bottom) = (matrix.rows(0, 4), matrix.rows(4, 3));
        let mut gram = Mat::zeros(3, 3);
        add_gram(&mut gram, &matrix, 4);
        let expected = (top.transpose() * top).lower_triangle();
        assert_eq!(gram, expected);
        let product = row_product(&matrix, 4..7, &[1.0, -2.0, 0.5]);
        let unknown = Mat::from_column_slice(3, 1, &[1.0, -2.0, 0.5]);
        assert_eq!(product, (bottom * unknown).data.as_vec().clone());
        let mut sum = vec![1.0; 3];
        add_transposed_product(&mut sum, &matrix, 4..7, &[1.0, 2.0, 3.0]);
        let vector = Mat::from_column_slice(3, 1, &[1.0, 2.0, 3.0]);
        let expected = bottom.transpose() * vector;
        assert!(sum.iter().zip(&expected).all(|(a, b)| *a == b + 1.0));
    }
}

//! Elimination tree of a symmetric pattern, its postorder, and the entries per column of the factor.
//!
//! Source: T. A. Davis, Direct Methods for Sparse Linear Systems (SIAM, 2006), sections 4.1 to 4.4.

use crate::SymmetricMatrix;

/// Mark of a row without a parent.
pub(super) const ROOT: usize = usize::MAX;

/// A permutation of the rows and columns of a pattern: `order[k]` is row `k` of the factor.
#[derive(Debug, Clone)]
pub(super) struct Ordering {
    /// Row of the matrix at each place of the factor.
    pub(super) order: Vec<usize>,
    /// Place in the factor of each row of the matrix.
    pub(super) place: Vec<usize>,
}

impl Ordering {
    pub(super) fn new(order: Vec<usize>) -> Self {
        let mut place = vec![0; order.len()];
        for (k, row) in order.iter().enumerate() {
            place[*row] = k;
        }
        Self { order, place }
    }

    /// Places in the factor of the entries of a row, in no order.
    pub(super) fn row<'a>(
        &'a self,
        matrix: &'a SymmetricMatrix,
        k: usize,
    ) -> impl Iterator<Item = usize> + 'a {
        let (starts, columns) = matrix.pattern();
        let row = self.order[k];
        columns[starts[row]..starts[row + 1]]
            .iter()
            .map(|column| self.place[*column])
    }
}

/// Returns the parent of each column: the row of the first entry below the diagonal of the factor.
pub(super) fn parents(matrix: &SymmetricMatrix, ordering: &Ordering) -> Vec<usize> {
    let size = matrix.size();
    let mut parent = vec![ROOT; size];
    // A known ancestor of each column, so that long paths are climbed once.
    let mut ancestor = vec![ROOT; size];
    for k in 0..size {
        for entry in ordering.row(matrix, k) {
            let mut i = entry;
            while i < k {
                let next = std::mem::replace(&mut ancestor[i], k);
                if next == ROOT {
                    parent[i] = k;
                    break;
                }
                i = next;
            }
        }
    }
    parent
}

/// Returns the columns in an order in which each follows all its descendants without a gap.
pub(super) fn postorder(parent: &[usize]) -> Vec<usize> {
    let size = parent.len();
    let mut first_child = vec![ROOT; size];
    let mut next_sibling = vec![ROOT; size];
    for k in (0..size).rev() {
        if parent[k] != ROOT {
            next_sibling[k] = std::mem::replace(&mut first_child[parent[k]], k);
        }
    }
    let mut order = Vec::with_capacity(size);
    let mut stack = Vec::new();
    for root in (0..size).filter(|k| parent[*k] == ROOT) {
        stack.push(root);
        while let Some(top) = stack.last().copied() {
            let child = first_child[top];
            if child == ROOT {
                order.push(top);
                stack.pop();
            } else {
                first_child[top] = next_sibling[child];
                stack.push(child);
            }
        }
    }
    order
}

/// Returns the number of entries in each column of the factor, with the diagonal.
pub(super) fn column_counts(
    matrix: &SymmetricMatrix,
    ordering: &Ordering,
    parent: &[usize],
) -> Vec<usize> {
    let size = matrix.size();
    let mut count = vec![1; size];
    let mut last_row = vec![ROOT; size];
    for k in 0..size {
        last_row[k] = k;
        for entry in ordering.row(matrix, k).filter(|entry| *entry < k) {
            let mut i = entry;
            while last_row[i] != k {
                last_row[i] = k;
                count[i] += 1;
                i = parent[i];
            }
        }
    }
    count
}

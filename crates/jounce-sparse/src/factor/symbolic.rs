//! Order of elimination and structure of the factor, from the pattern alone.

use super::tree::{Ordering, ROOT, column_counts, parents, postorder};
use crate::SymmetricMatrix;

/// Most columns of a merged supernode, and the largest share of zeros that the merger may store.
///
/// Wider blocks take fewer and longer loops. Source: Y. Chen, T. A. Davis, W. W. Hager, S.
/// Rajamanickam, Algorithm 887: CHOLMOD, ACM Trans. Math. Softw. 35 (2008) 22.
const MERGERS: [(usize, f64); 4] = [(4, 1.0), (16, 0.8), (48, 0.1), (usize::MAX, 0.05)];

/// Columns `first..first + columns` of the factor, which share the rows below them.
#[derive(Debug, Clone)]
pub(super) struct Supernode {
    pub(super) first: usize,
    pub(super) columns: usize,
    /// Rows below the columns, ascending.
    pub(super) below: Vec<usize>,
    /// Index of the supernode that holds the first row below; `ROOT` without rows below.
    pub(super) parent: usize,
}

impl Supernode {
    /// Number of rows, those of the columns included.
    pub(super) fn rows(&self) -> usize {
        self.columns + self.below.len()
    }
}

/// The structure of `L D L^T` of all matrices with one pattern.
#[derive(Debug, Clone)]
pub struct Symbolic {
    pub(super) ordering: Ordering,
    pub(super) supernodes: Vec<Supernode>,
}

impl Symbolic {
    /// Orders a pattern by approximate minimum degree and finds the structure of its factor.
    pub fn new(matrix: &SymmetricMatrix) -> Self {
        let size = matrix.size();
        let (starts, columns) = matrix.pattern();
        let first_order = match amd::order(size, starts, columns, &amd::Control::default()) {
            Ok((order, _, _)) => Ordering::new(order),
            // Only an invalid pattern has no order, and those of this crate are valid.
            Err(_) => Ordering::new((0..size).collect()),
        };
        let post = postorder(&parents(matrix, &first_order));
        let ordering = Ordering::new(post.iter().map(|k| first_order.order[*k]).collect());
        let parent = parents(matrix, &ordering);
        let count = column_counts(matrix, &ordering, &parent);
        let firsts = merged(fundamental(&parent, &count), &parent, &count, size);
        let supernodes = with_rows(&firsts, matrix, &ordering);
        Self {
            ordering,
            supernodes,
        }
    }

    /// Number of stored entries of `L`, zeros of merged supernodes included.
    pub fn stored(&self) -> usize {
        self.supernodes
            .iter()
            .map(|node| node.rows() * node.columns)
            .sum()
    }
}

/// First columns of the supernodes without stored zeros.
fn fundamental(parent: &[usize], count: &[usize]) -> Vec<usize> {
    let starts = |k: &usize| *k == 0 || parent[k - 1] != *k || count[k - 1] != count[*k] + 1;
    (0..parent.len()).filter(starts).collect()
}

/// First columns after mergers of a supernode with the next one, where that is its parent.
fn merged(firsts: Vec<usize>, parent: &[usize], count: &[usize], size: usize) -> Vec<usize> {
    let mut kept = Vec::with_capacity(firsts.len());
    // The supernode to the right: columns, rows, and the zeros stored in it.
    let (mut columns, mut rows, mut zeros) = (0, 0, 0);
    let mut end = size;
    for first in firsts.into_iter().rev() {
        let (own_columns, own_rows) = (end - first, count[first]);
        let merged_columns = own_columns + columns;
        let merged_zeros = zeros + own_columns * (own_columns + rows).saturating_sub(own_rows);
        let entries = merged_columns * (own_columns + rows);
        let share = merged_zeros as f64 / entries as f64;
        let allowed = MERGERS.iter().find(|(most, _)| merged_columns <= *most);
        let is_child = end < size && parent[end - 1] == end;
        if is_child && allowed.is_some_and(|(_, most)| share <= *most) {
            (columns, rows, zeros) = (merged_columns, own_columns + rows, merged_zeros);
            kept.pop();
        } else {
            (columns, rows, zeros) = (own_columns, own_rows, 0);
        }
        kept.push(first);
        end = first;
    }
    kept.reverse();
    kept
}

/// The rows of each supernode: those of the matrix and those of its children.
fn with_rows(firsts: &[usize], matrix: &SymmetricMatrix, ordering: &Ordering) -> Vec<Supernode> {
    let size = matrix.size();
    let mut node_of = vec![0; size];
    let ends = firsts.iter().skip(1).copied().chain([size]);
    let ranges: Vec<_> = firsts
        .iter()
        .copied()
        .zip(ends)
        .map(|(a, b)| a..b)
        .collect();
    for (node, range) in ranges.iter().enumerate() {
        node_of[range.clone()].fill(node);
    }
    let mut children = vec![Vec::new(); ranges.len()];
    let mut last_node = vec![ROOT; size];
    let mut supernodes: Vec<Supernode> = Vec::with_capacity(ranges.len());
    for (node, range) in ranges.into_iter().enumerate() {
        let mut below = Vec::new();
        let mut add = |row: usize| {
            if row >= range.end && last_node[row] != node {
                last_node[row] = node;
                below.push(row);
            }
        };
        range
            .clone()
            .for_each(|k| ordering.row(matrix, k).for_each(&mut add));
        for child in &children[node] {
            let child: &Supernode = &supernodes[*child];
            child.below.iter().copied().for_each(&mut add);
        }
        below.sort_unstable();
        let parent = below.first().map_or(ROOT, |row| node_of[*row]);
        if parent != ROOT {
            children[parent].push(node);
        }
        supernodes.push(Supernode {
            first: range.start,
            columns: range.len(),
            below,
            parent,
        });
    }
    supernodes
}

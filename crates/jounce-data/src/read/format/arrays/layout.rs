//! Splits an array of any number of dimensions into series along its longest side.

use crate::read::column::numbers::ColumnNumbers;
use crate::read::column::samples::SampleStore;
use crate::read::error::Damage;

/// Maximum number of series in an array; an array with more is an image or another kind of table.
const MAX_SERIES: u64 = 4096;

/// Position of each number of an array. With the first dimension the fastest, number `n` is sample
/// `n / s % l` of series `n % s + n / (s l) s`, for the longest side `l` and the product `s` of the
/// dimensions before it.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::read) struct ArrayLayout {
    /// Sizes, the fastest dimension first.
    dimensions: Vec<u64>,
    /// True where names list the last dimension first.
    row_major: bool,
    /// Index of the longest dimension.
    axis: usize,
    stride: u64,
    length: u64,
    count: u64,
}

impl ArrayLayout {
    /// Returns the layout of an array whose first dimension is the fastest (MATLAB), or the last
    /// one (`row_major`: C). Returns `None` for more series than could be channels, or more numbers
    /// than can be counted.
    pub fn new(dimensions: &[u64], row_major: bool) -> Option<Self> {
        let fastest_first: Vec<u64> = if row_major {
            dimensions.iter().rev().copied().collect()
        } else {
            dimensions.to_vec()
        };
        let longest = fastest_first.iter().copied().max().unwrap_or(1);
        let axis = fastest_first
            .iter()
            .position(|size| *size == longest)
            .unwrap_or(0);
        let product = |sizes: &[u64]| {
            sizes
                .iter()
                .try_fold(1_u64, |product, size| product.checked_mul(*size))
        };
        let total = product(&fastest_first)?;
        let count = total.checked_div(longest).unwrap_or(0);
        let stride = product(fastest_first.get(..axis).unwrap_or_default())?.max(1);
        (count <= MAX_SERIES).then_some(Self {
            dimensions: fastest_first,
            row_major,
            axis,
            stride,
            length: longest,
            count,
        })
    }

    /// Total count of numbers.
    pub fn total(&self) -> u64 {
        self.length * self.count
    }

    /// Returns empty series for [`Self::push`].
    ///
    /// # Errors
    /// Not enough memory.
    pub fn series(&self, store: &SampleStore) -> Result<Vec<ColumnNumbers>, Damage> {
        let mut series: Vec<ColumnNumbers> = (0..self.count).map(|_| store.column()).collect();
        let has_room = series
            .iter_mut()
            .all(|numbers| usize::try_from(self.length).is_ok_and(|length| numbers.expect(length)));
        if has_room {
            Ok(series)
        } else {
            Err(Damage::new(format!(
                "{} numbers do not fit into memory",
                self.total()
            )))
        }
    }

    /// Appends a number to its series; `number` counts from 0 in file order.
    pub fn push(&self, series: &mut [ColumnNumbers], number: u64, x: f64) -> std::io::Result<()> {
        let index = number % self.stride + number / (self.stride * self.length) * self.stride;
        series
            .get_mut(index as usize)
            .map_or(Ok(()), |numbers| numbers.push(x))
    }

    /// Indices of the series in the array, from 1: `(2)`, `(2,1)`; empty for a single series.
    pub fn labels(&self) -> Vec<String> {
        if self.count < 2 {
            return Vec::new();
        }
        let other_lengths: Vec<u64> = self
            .dimensions
            .iter()
            .enumerate()
            .filter(|(k, size)| *k != self.axis && **size > 1)
            .map(|(_, size)| *size)
            .collect();
        let label = |series: u64| {
            let mut remaining = series;
            let mut indices: Vec<String> = Vec::new();
            for length in &other_lengths {
                indices.push((remaining % length + 1).to_string());
                remaining /= length;
            }
            if self.row_major {
                indices.reverse();
            }
            format!("({})", indices.join(","))
        };
        (0..self.count).map(label).collect()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::recording::Series as _;

    /// The array `a[i, j, k] = 100 i + 10 j + k` in both orders, with its longest side anywhere.
    #[test]
    fn series_run_along_the_longest_side() {
        for dimensions in [[5, 2, 3], [2, 5, 3], [2, 3, 5], [5, 1, 1], [1, 1, 5]] {
            for row_major in [false, true] {
                let layout = ArrayLayout::new(&dimensions, row_major).unwrap();
                let mut series = layout.series(&SampleStore::Memory).unwrap();
                let sizes: Vec<u64> = if row_major {
                    dimensions.iter().rev().copied().collect()
                } else {
                    dimensions.to_vec()
                };
                for n in 0..layout.total() {
                    let mut at = [
                        n % sizes[0],
                        n / sizes[0] % sizes[1],
                        n / sizes[0] / sizes[1],
                    ];
                    if row_major {
                        at.reverse();
                    }
                    layout
                        .push(&mut series, n, (100 * at[0] + 10 * at[1] + at[2]) as f64)
                        .unwrap();
                }
                let axis = dimensions.iter().position(|size| *size == 5).unwrap();
                let step = [100.0, 10.0, 1.0][axis];
                for (series, label) in series.iter().zip(layout.labels()) {
                    let values = series.piece(0).unwrap();
                    let rest: Vec<String> = [100.0, 10.0, 1.0]
                        .iter()
                        .enumerate()
                        .filter(|(k, _)| *k != axis && dimensions[*k] > 1)
                        .map(|(_, step)| ((values[0] / step).floor() % 10.0 + 1.0).to_string())
                        .collect();
                    assert_eq!(
                        label,
                        format!("({})", rest.join(",")),
                        "{dimensions:?} {row_major}"
                    );
                    assert!(
                        values.windows(2).all(|pair| pair[1] - pair[0] == step)
                            && values.len() == 5,
                        "{dimensions:?} {values:?}"
                    );
                }
            }
        }
        assert_eq!(ArrayLayout::new(&[1 << 20, 1 << 20], false), None);
        assert_eq!(ArrayLayout::new(&[u64::MAX, 3], true), None);
        assert_eq!(ArrayLayout::new(&[0, 3], true).unwrap().total(), 0);
        assert_eq!(ArrayLayout::new(&[], true).unwrap().total(), 1);
    }
}

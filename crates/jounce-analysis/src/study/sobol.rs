//! The Sobol sequence.
//!
//! The Gray code of the number of a point selects direction numbers `v_k` of each dimension by its
//! bits `k`. The selected numbers are added without carry. A digital shift drawn from the seed
//! moves the complete sequence.
//!
//! Source: S. Joe, F. Kuo, SIAM J. Sci. Comput. 30 (2008) 2635, the direction numbers of `new-joe-kuo-6`.

/// Degree, coefficients of the primitive polynomial and first direction numbers of each dimension
/// after the first.
const DIRECTION_NUMBERS: [(usize, u32, [u32; 5]); 9] = [
    (1, 0, [1, 0, 0, 0, 0]),
    (2, 1, [1, 3, 0, 0, 0]),
    (3, 1, [1, 3, 1, 0, 0]),
    (3, 2, [1, 1, 1, 0, 0]),
    (4, 1, [1, 1, 3, 3, 0]),
    (4, 4, [1, 3, 5, 13, 0]),
    (5, 2, [1, 1, 5, 5, 17]),
    (5, 4, [1, 1, 5, 5, 5]),
    (5, 7, [1, 1, 7, 11, 19]),
];

/// Largest number of dimensions.
pub const MAX_DIMENSIONS: usize = DIRECTION_NUMBERS.len() + 1;

const BITS: usize = 32;

/// Returns the position of point `index` along a dimension, in [0, 1), with its digits shifted.
pub(super) fn sobol(dimension: usize, index: u32, shift: u32) -> f64 {
    let gray = index ^ (index >> 1);
    let directions = directions(dimension);
    let digits = (0..BITS)
        .filter(|k| gray >> k & 1 == 1)
        .fold(shift, |digits, k| digits ^ directions[k]);
    f64::from(digits) / 2.0_f64.powi(BITS as i32)
}

fn directions(dimension: usize) -> [u32; BITS] {
    let mut v = [0; BITS];
    let Some(&(degree, coefficients, first)) = dimension
        .checked_sub(1)
        .and_then(|index| DIRECTION_NUMBERS.get(index))
    else {
        return std::array::from_fn(|k| 1 << (BITS - 1 - k));
    };
    for k in 0..BITS {
        v[k] = if k < degree {
            first[k] << (BITS - 1 - k)
        } else {
            let switched = (1..degree).filter(|j| coefficients >> (degree - 1 - j) & 1 == 1);
            switched.fold(v[k - degree] ^ (v[k - degree] >> degree), |sum, j| {
                sum ^ v[k - j]
            })
        };
    }
    v
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares points 1 to 5 and 1000 with SciPy 1.17,
    /// `scipy.stats.qmc.Sobol(10, scramble=False)`.
    #[test]
    fn points_are_those_of_scipy() {
        let expected: [(u32, [f64; 10]); 6] = [
            (1, [0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5]),
            (
                2,
                [0.75, 0.25, 0.25, 0.25, 0.75, 0.75, 0.25, 0.75, 0.75, 0.75],
            ),
            (
                3,
                [0.25, 0.75, 0.75, 0.75, 0.25, 0.25, 0.75, 0.25, 0.25, 0.25],
            ),
            (
                4,
                [
                    0.375, 0.375, 0.625, 0.875, 0.375, 0.125, 0.375, 0.875, 0.875, 0.625,
                ],
            ),
            (
                5,
                [
                    0.875, 0.875, 0.125, 0.375, 0.875, 0.625, 0.875, 0.375, 0.375, 0.125,
                ],
            ),
            (
                1000,
                [
                    0.2197265625,
                    0.0966796875,
                    0.5185546875,
                    0.6767578125,
                    0.2802734375,
                    0.9072265625,
                    0.0458984375,
                    0.8994140625,
                    0.5009765625,
                    0.0693359375,
                ],
            ),
        ];
        for (index, point) in expected {
            for (dimension, x) in point.into_iter().enumerate() {
                assert_eq!(
                    sobol(dimension, index, 0),
                    x,
                    "point {index}, dimension {dimension}"
                );
            }
        }
    }

    /// Each of 64 equal cells holds one of the first 64 points, along every dimension and for any
    /// shift.
    #[test]
    fn every_cell_holds_one_point() {
        for dimension in 0..MAX_DIMENSIONS {
            let mut cells: Vec<u32> = (0..64)
                .map(|index| (64.0 * sobol(dimension, index, 0x1234_5678)) as u32)
                .collect();
            cells.sort_unstable();
            assert!(cells.iter().copied().eq(0..64), "{dimension}: {cells:?}");
        }
    }
}

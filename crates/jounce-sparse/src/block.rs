//! Blocks of four vectors, stored row by row: a matrix is read once for four vectors.

/// Vectors per block.
pub(crate) const LANES: usize = 4;

/// Four vectors, one array per row.
pub(crate) type Block = Vec<[f64; LANES]>;

/// A small square matrix of one block's size.
pub(crate) type Small = [[f64; LANES]; LANES];

/// Adds `factor x` to `sum`.
#[inline(always)]
pub(crate) fn add_scaled(sum: &mut [f64; LANES], factor: f64, x: &[f64; LANES]) {
    for lane in 0..LANES {
        sum[lane] += factor * x[lane];
    }
}

/// Returns `A^T B`.
pub(crate) fn gram(a: &Block, b: &Block) -> Small {
    let mut sum = [[0.0; LANES]; LANES];
    for (a, b) in a.iter().zip(b) {
        for i in 0..LANES {
            add_scaled(&mut sum[i], a[i], b);
        }
    }
    sum
}

/// Adds `factor B C` to `sum`.
pub(crate) fn add_product(sum: &mut Block, factor: f64, b: &Block, c: &Small) {
    let c = c.map(|row| row.map(|entry| factor * entry));
    for (sum, b) in sum.iter_mut().zip(b) {
        for i in 0..LANES {
            add_scaled(sum, b[i], &c[i]);
        }
    }
}

/// Returns a block of pseudorandom numbers between -1 and 1, the same for the same seed.
///
/// Source: G. L. Steele, D. Lea, C. H. Flood, Fast splittable pseudorandom number generators, OOPSLA
/// 2014 (SplitMix64).
pub(crate) fn random(rows: usize, seed: u64) -> Block {
    let number = |index: u64| {
        let mut z = (seed << 32 | 1).wrapping_add(index.wrapping_mul(0x9E37_79B9_7F4A_7C15));
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ (z >> 31)) as f64 / 2f64.powi(63) - 1.0
    };
    let row = |i: usize| std::array::from_fn(|lane| number((i * LANES + lane) as u64));
    (0..rows).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_of_small_blocks() {
        let a: Block = vec![[1.0, 2.0, 0.0, 0.0], [0.0, -1.0, 3.0, 0.0]];
        let b: Block = vec![[2.0, 0.0, 1.0, 0.0], [1.0, 1.0, 0.0, 4.0]];
        let product = gram(&a, &b);
        assert_eq!(product[1], [3.0, -1.0, 2.0, -4.0]);
        let mut sum = b.clone();
        add_product(&mut sum, -1.0, &a, &product);
        // Row 0 of A times A^T B is [2, 0, 1, 0] + 2 [3, -1, 2, -4].
        assert_eq!(sum[0], [2.0 - 8.0, 2.0, 1.0 - 5.0, 8.0]);
    }

    #[test]
    fn random_blocks_have_no_mean_and_the_variance_of_a_uniform_density() {
        let block = random(20_000, 7);
        let moments = gram(&block, &block);
        assert!((moments[2][2] / 20_000.0 - 1.0 / 3.0).abs() < 0.01);
        assert!(moments[0][3].abs() / 20_000.0 < 0.01);
        assert_ne!(random(1, 1), random(1, 2));
    }
}

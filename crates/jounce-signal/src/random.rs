//! Seeded random numbers.
//!
//! Source: G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators" (OOPSLA
//! 2014), SplitMix64; G. Box, M. Muller, Ann. Math. Stat. 29 (1958) 610.

use std::f64::consts::TAU;

/// Stream of random numbers, one for each seed and index.
#[derive(Debug, Clone)]
pub struct RandomStream(u64);

impl RandomStream {
    /// Creates stream number `index` of a seed, independent of all other draws.
    pub fn new(seed: u64, index: u64) -> Self {
        Self(mixed(seed) ^ mixed(index.wrapping_add(1)))
    }

    /// Returns a uniform number in [-1, 1).
    pub fn symmetric(&mut self) -> f64 {
        self.uniform() * 2.0 - 1.0
    }

    /// Returns two independent normal numbers of mean 0 and variance 1.
    pub fn normal_pair(&mut self) -> [f64; 2] {
        // In (0, 1], so the logarithm is finite.
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        let (sin, cos) = (TAU * self.uniform()).sin_cos();
        [radius * cos, radius * sin]
    }

    /// Returns an integer of 53 bits, a seed that a spec can hold.
    pub fn seed(&mut self) -> u64 {
        self.next() >> 11
    }

    /// Returns a uniform number in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        mixed(self.0)
    }
}

fn mixed(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fill_their_range_evenly() {
        let mut stream = RandomStream::new(7, 0);
        let values: Vec<f64> = (0..20_000).map(|_| stream.symmetric()).collect();
        let mean = values.iter().sum::<f64>() / 2e4;
        let square = values.iter().map(|v| v * v).sum::<f64>() / 2e4;
        assert!(
            mean.abs() < 0.015 && (square - 1.0 / 3.0).abs() < 0.01,
            "{mean} {square}"
        );
        assert!(values.iter().all(|v| (-1.0..1.0).contains(v)));
    }

    /// Moments 1 to 4 of a normal distribution are 0, 1, 0, 3; their errors over 40000 numbers are
    /// below 0.005, 0.007, 0.02, 0.05.
    #[test]
    fn normal_numbers_have_the_moments_of_their_distribution() {
        let mut stream = RandomStream::new(3, 5);
        let values: Vec<f64> = (0..20_000).flat_map(|_| stream.normal_pair()).collect();
        let moment =
            |power: i32| values.iter().map(|v| v.powi(power)).sum::<f64>() / values.len() as f64;
        let moments = [1, 2, 3, 4].map(moment);
        assert!(
            moments
                .iter()
                .zip([0.0, 1.0, 0.0, 3.0])
                .zip([0.02, 0.03, 0.06, 0.2])
                .all(|((a, b), e)| (a - b).abs() < e),
            "{moments:?}"
        );
    }
}

//! Eight numbers in memory.

/// Numbers per vector.
pub const LANES: usize = 8;

/// Eight numbers on one cache line.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(align(64))]
pub struct F64x8(pub [f64; LANES]);

impl F64x8 {
    /// All zero.
    pub const ZERO: F64x8 = F64x8([0.0; LANES]);

    /// Returns `self + factor * other`.
    #[inline(always)]
    pub fn add_scaled(mut self, factor: f64, other: &F64x8) -> F64x8 {
        self.0
            .iter_mut()
            .zip(&other.0)
            .for_each(|(a, b)| *a += factor * b);
        self
    }
}

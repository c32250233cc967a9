//! Eight numbers in memory.

/// Numbers per lane: seven collocation nodes and the end of the step.
pub const WIDTH: usize = 8;

/// Eight numbers on one cache line.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(align(64))]
pub struct Lane(pub [f64; WIDTH]);

impl Lane {
    /// All zero.
    pub const ZERO: Lane = Lane([0.0; WIDTH]);

    /// `self + factor * other`.
    pub fn add_scaled(mut self, factor: f64, other: &Lane) -> Lane {
        self.0.iter_mut().zip(&other.0).for_each(|(a, b)| *a += factor * b);
        self
    }
}

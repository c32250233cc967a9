//! Energy coordinates `(w q, q', sqrt(C) V)`: the square of their norm is twice the energy without
//! the stops.

/// Factors from a physical state to energy coordinates; zero for the energy meter.
#[derive(Debug, Clone, Copy)]
pub struct Weights<const D: usize>(pub [f64; D]);

impl<const D: usize> Weights<D> {
    /// Square of the norm.
    #[inline(always)]
    pub fn square(&self, y: &[f64; D]) -> f64 {
        (0..D).map(|i| (self.0[i] * y[i]).powi(2)).sum()
    }

    /// Returns the state in energy coordinates.
    pub fn scaled(&self, y: &[f64; D]) -> [f64; D] {
        std::array::from_fn(|i| self.0[i] * y[i])
    }
}

//! Variance of what a fit finds, from leaving out one part of the blocks after the other (the jackknife).
//!
//! To first order leaving out part `g` moves the poles by `N^-1 J^T P (H_g - H)`, over all lines and responses together: noise of the force is
//! common to the responses, and windows make neighbouring lines alike.
//!
//! The noise of hits has no preferred phase: turned by 90 degrees, what is left out tells as much again, which a few hits need. Under a force that
//! goes on, what leaks out of a block leaks into the next, so that parts that follow each other vary against each other; their product counts
//! too (L. Hansen, Econometrica 50 (1982) 1029).

use faer::Mat;

use super::band::LeftOut;
use crate::spectral::Sight;

/// From so many parts on their scatter is known well enough as it is.
const MANY: usize = 8;
/// The least variance where neighbours count, over that without them.
const LEAST: f64 = 0.2;

/// What each part of the blocks does to the poles.
pub(super) struct Scatter {
    /// Changes of the poles' numbers, scaled so that their squares add to the variance: part, then number and turn.
    change: Vec<Mat<f64>>,
    neighbours: bool,
}

impl Scatter {
    /// How often what parts leave out is turned.
    pub fn turns(parts: usize, sight: Sight) -> usize {
        if parts < MANY && matches!(sight, Sight::Cut { .. }) { 2 } else { 1 }
    }

    /// `change` is what each part that is left out does to the poles' numbers, by turns.
    pub fn new(change: Vec<Mat<f64>>, left_out: &[LeftOut], sight: Sight) -> Self {
        let scaled = |(change, left): (Mat<f64>, &LeftOut)| {
            let scale = ((1.0 - left.share) / change.ncols() as f64).sqrt();
            change * scale
        };
        let neighbours = matches!(sight, Sight::Hann { .. }) && left_out.len() >= MANY;
        Self { change: change.into_iter().zip(left_out).map(scaled).collect(), neighbours }
    }

    /// Degrees of freedom of a variance.
    pub fn freedom(&self) -> f64 {
        let parts = self.change.len() as f64;
        match self.neighbours {
            true => parts / 3.0,
            false => (parts - 1.0) * self.change.first().map_or(1, Mat::ncols) as f64,
        }
    }

    /// Variance of a number that changes by `slope` with the real and the imaginary part of pole `r`.
    pub fn variance(&self, r: usize, slope: [f64; 2]) -> f64 {
        let moved = |change: &Mat<f64>, turn: usize| slope[0] * change[(2 * r, turn)] + slope[1] * change[(2 * r + 1, turn)];
        let own: f64 = self.change.iter().flat_map(|change| (0..change.ncols()).map(move |turn| moved(change, turn).powi(2))).sum();
        if !self.neighbours {
            return own;
        }
        let pairs = self.change.windows(2).map(|pair| moved(&pair[0], 0) * moved(&pair[1], 0)).sum::<f64>();
        // The mean was taken from the same parts, three times in each of these sums.
        let parts = self.change.len() as f64;
        f64::max(own + 2.0 * pairs, LEAST * own) * (parts - 1.0) / (parts - 3.0)
    }
}

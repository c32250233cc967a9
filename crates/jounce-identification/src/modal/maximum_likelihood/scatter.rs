//! Variance of the fit results, from the effect of parts of the data.
//!
//! Parts of blocks (jackknife): to first order, leaving out part `g` moves the poles by `N^-1 J^T P
//! (H_g - H)`, over all lines and responses together. This includes noise of the force, common to
//! the responses, and correlation of neighbouring lines by windows. Noise of hits has no preferred
//! phase: the left-out data turned by 90 degrees give a second estimate, which a few hits need.
//! Under a continuing force, the leakage out of a block enters the next one, so consecutive parts
//! are correlated and their products are included (L. Hansen, Econometrica 50 (1982) 1029). Hits at
//! different locations are independent: the parts of each location are treated separately.
//!
//! Lines, with unknown noise: the residual of line `k` moves the poles by `N^-1 J^T P e_k`, over
//! all responses together. The squares add up to the variance for any noise of the lines (H. White,
//! Econometrica 48 (1980) 817); each residual is enlarged to correct for its leverage. A few lines
//! carry most information on a sharp peak, and the degrees of freedom are those of the lines that
//! contribute (F. Satterthwaite, Biometrics Bull. 2 (1946) 110).

use jounce_linalg::Mat;

use crate::modal::band_lines::LeaveOneOutChange;
use jounce_signal::spectral::WindowBias;

/// Number of parts above which their scatter needs no turned copies.
const ENOUGH_PARTS: usize = 8;
/// Lower bound on the variance with neighbours, relative to that without.
const MIN_VARIANCE_RATIO: f64 = 0.2;

/// Effect of each part of the data on the unknowns.
pub(super) struct Scatter {
    /// Changes of the unknowns, scaled so that their squares add up to the variance: force
    /// location, part, then unknown and turn.
    positions: Vec<Vec<Mat<f64>>>,
    kind: ScatterKind,
}

enum ScatterKind {
    /// Independent parts.
    Parts,
    /// Parts with leakage into the next one.
    Neighbours,
    Lines,
}

impl Scatter {
    /// Number of turns applied to left-out data.
    pub fn rotations(parts: usize, window_bias: WindowBias) -> usize {
        if parts < ENOUGH_PARTS && matches!(window_bias, WindowBias::Cut { .. }) {
            2
        } else {
            1
        }
    }

    /// Builds the scatter from `change`, the effect on the unknowns of each left-out part, by
    /// turns.
    pub fn from_parts(
        change: Vec<Mat<f64>>,
        left_out: &[LeaveOneOutChange],
        window_bias: WindowBias,
    ) -> Self {
        let mut positions: Vec<Vec<Mat<f64>>> = Vec::new();
        for (change, left_out_part) in change.into_iter().zip(left_out) {
            let scale = ((1.0 - left_out_part.share) / change.ncols() as f64).sqrt();
            positions.resize_with(positions.len().max(left_out_part.position + 1), Vec::new);
            positions[left_out_part.position].push(change * scale);
        }
        let neighbours = matches!(window_bias, WindowBias::Hann { .. })
            && positions.iter().all(|parts| parts.len() >= ENOUGH_PARTS);
        Self {
            positions,
            kind: if neighbours {
                ScatterKind::Neighbours
            } else {
                ScatterKind::Parts
            },
        }
    }

    /// Builds the scatter from `change`, the effect on the unknowns of the residual of each line,
    /// in two turns.
    pub fn from_lines(change: Vec<Mat<f64>>) -> Self {
        Self {
            positions: vec![change],
            kind: ScatterKind::Lines,
        }
    }

    /// Degrees of freedom of the variances of a pole.
    pub fn freedom(&self, r: usize) -> f64 {
        let part_count = |part_count: &Vec<Mat<f64>>| part_count.len() as f64;
        match self.kind {
            ScatterKind::Neighbours => self.positions.iter().map(part_count).sum::<f64>() / 3.0,
            ScatterKind::Parts => {
                let rotations = self.positions.iter().flatten().next().map_or(1, Mat::ncols) as f64;
                self.positions
                    .iter()
                    .map(|position| part_count(position) - 1.0)
                    .sum::<f64>()
                    * rotations
            }
            ScatterKind::Lines => [[1.0, 0.0], [0.0, 1.0]]
                .map(|slope| self.freedom_of_lines(r, slope))
                .into_iter()
                .fold(f64::INFINITY, f64::min),
        }
    }

    /// Each line adds the mean of two squares, whose scatter is of its own size: the fourth powers
    /// give the scatter of the sum.
    fn freedom_of_lines(&self, r: usize, slope: [f64; 2]) -> f64 {
        let (mut sum, mut square_sum) = (0.0, 0.0);
        for change in self.positions.iter().flatten() {
            let variance_at: f64 = (0..change.ncols())
                .map(|rotation| weighted_change(change, rotation, r, slope).powi(2))
                .sum();
            sum += variance_at;
            square_sum += variance_at * variance_at;
        }
        (4.0 * sum * sum / square_sum.max(f64::MIN_POSITIVE)).max(1.0)
    }

    /// Variance of a quantity with derivatives `slope` by the real and the imaginary part of pole
    /// `r`.
    pub fn variance(&self, r: usize, slope: [f64; 2]) -> f64 {
        self.positions
            .iter()
            .map(|parts| self.position_variance(parts, r, slope))
            .sum()
    }

    fn position_variance(&self, parts: &[Mat<f64>], r: usize, slope: [f64; 2]) -> f64 {
        let variance: f64 = parts
            .iter()
            .flat_map(|change| {
                (0..change.ncols())
                    .map(move |rotation| weighted_change(change, rotation, r, slope).powi(2))
            })
            .sum();
        if !matches!(self.kind, ScatterKind::Neighbours) {
            return variance;
        }
        let pairs = parts
            .windows(2)
            .map(|pair| {
                weighted_change(&pair[0], 0, r, slope) * weighted_change(&pair[1], 0, r, slope)
            })
            .sum::<f64>();
        // The mean is from the same parts, and enters each of these sums three times.
        let part_count = parts.len() as f64;
        f64::max(variance + 2.0 * pairs, MIN_VARIANCE_RATIO * variance) * (part_count - 1.0)
            / (part_count - 3.0)
    }
}

/// Change of a quantity with derivatives `slope` by the real and the imaginary part of pole `r`.
fn weighted_change(change: &Mat<f64>, rotation: usize, r: usize, slope: [f64; 2]) -> f64 {
    slope[0] * change[(2 * r, rotation)] + slope[1] * change[(2 * r + 1, rotation)]
}

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

use faer::Mat;

use super::band::LeaveOneOutChange;
use crate::spectral::WindowBias;

/// Number of parts above which their scatter needs no turned copies.
const ENOUGH_PARTS: usize = 8;
/// Lower bound on the variance with neighbours, relative to that without.
const MIN_VARIANCE_RATIO: f64 = 0.2;

/// Effect of each part of the data on the unknowns.
pub(super) struct Scatter {
    /// Changes of the unknowns, scaled so that their squares add up to the variance: force
    /// location, part, then unknown and turn.
    places: Vec<Vec<Mat<f64>>>,
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
    pub fn turns(parts: usize, sight: WindowBias) -> usize {
        if parts < ENOUGH_PARTS && matches!(sight, WindowBias::Cut { .. }) {
            2
        } else {
            1
        }
    }

    /// Builds the scatter from `change`, the effect on the unknowns of each left-out part, by
    /// turns.
    pub fn of_parts(
        change: Vec<Mat<f64>>,
        left_out: &[LeaveOneOutChange],
        sight: WindowBias,
    ) -> Self {
        let mut places: Vec<Vec<Mat<f64>>> = Vec::new();
        for (change, left) in change.into_iter().zip(left_out) {
            let scale = ((1.0 - left.share) / change.ncols() as f64).sqrt();
            places.resize_with(places.len().max(left.place + 1), Vec::new);
            places[left.place].push(change * scale);
        }
        let neighbours = matches!(sight, WindowBias::Hann { .. })
            && places.iter().all(|parts| parts.len() >= ENOUGH_PARTS);
        Self {
            places,
            kind: if neighbours {
                ScatterKind::Neighbours
            } else {
                ScatterKind::Parts
            },
        }
    }

    /// Builds the scatter from `change`, the effect on the unknowns of the residual of each line,
    /// in two turns.
    pub fn of_lines(change: Vec<Mat<f64>>) -> Self {
        Self {
            places: vec![change],
            kind: ScatterKind::Lines,
        }
    }

    /// Degrees of freedom of the variances of a pole.
    pub fn freedom(&self, r: usize) -> f64 {
        let parts = |parts: &Vec<Mat<f64>>| parts.len() as f64;
        match self.kind {
            ScatterKind::Neighbours => self.places.iter().map(parts).sum::<f64>() / 3.0,
            ScatterKind::Parts => {
                let turns = self.places.iter().flatten().next().map_or(1, Mat::ncols) as f64;
                self.places.iter().map(|of| parts(of) - 1.0).sum::<f64>() * turns
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
        let (mut sum, mut squares) = (0.0, 0.0);
        for change in self.places.iter().flatten() {
            let own: f64 = (0..change.ncols())
                .map(|turn| moved(change, turn, r, slope).powi(2))
                .sum();
            sum += own;
            squares += own * own;
        }
        (4.0 * sum * sum / squares.max(f64::MIN_POSITIVE)).max(1.0)
    }

    /// Variance of a quantity with derivatives `slope` by the real and the imaginary part of pole
    /// `r`.
    pub fn variance(&self, r: usize, slope: [f64; 2]) -> f64 {
        self.places
            .iter()
            .map(|parts| self.of_place(parts, r, slope))
            .sum()
    }

    fn of_place(&self, parts: &[Mat<f64>], r: usize, slope: [f64; 2]) -> f64 {
        let own: f64 = parts
            .iter()
            .flat_map(|change| {
                (0..change.ncols()).map(move |turn| moved(change, turn, r, slope).powi(2))
            })
            .sum();
        if !matches!(self.kind, ScatterKind::Neighbours) {
            return own;
        }
        let pairs = parts
            .windows(2)
            .map(|pair| moved(&pair[0], 0, r, slope) * moved(&pair[1], 0, r, slope))
            .sum::<f64>();
        // The mean is from the same parts, and enters each of these sums three times.
        let parts = parts.len() as f64;
        f64::max(own + 2.0 * pairs, MIN_VARIANCE_RATIO * own) * (parts - 1.0) / (parts - 3.0)
    }
}

/// Change of a quantity with derivatives `slope` by the real and the imaginary part of pole `r`.
fn moved(change: &Mat<f64>, turn: usize, r: usize, slope: [f64; 2]) -> f64 {
    slope[0] * change[(2 * r, turn)] + slope[1] * change[(2 * r + 1, turn)]
}

//! Variance of what a fit finds, from what parts of the data do to it.
//!
//! Parts of blocks: to first order leaving out part `g` moves the poles by `N^-1 J^T P (H_g - H)`, over all lines and responses together (the
//! jackknife): noise of the force is common to the responses, and windows make neighbouring lines alike. The noise of hits has no preferred phase:
//! turned by 90 degrees, what is left out tells as much again, which a few hits need. Under a force that goes on, what leaks out of a block leaks
//! into the next, so that parts that follow each other vary against each other; their product counts too (L. Hansen, Econometrica 50 (1982) 1029).
//! Hits at different places know nothing of each other: the parts of each place count for themselves.
//!
//! Lines, where nothing tells their noise: what the fit leaves of line `k` moved the poles by `N^-1 J^T P e_k`, over all responses together, and
//! the squares add to the variance whatever the noise of a line (H. White, Econometrica 48 (1980) 817); each rest is widened by what the fit took up
//! of it. Few lines tell most of a sharp peak, and the degrees of freedom are those of the lines that count (F. Satterthwaite, Biometrics
//! Bull. 2 (1946) 110).

use faer::Mat;

use super::band::LeaveOneOutChange;
use crate::spectral::WindowBias;

/// From so many parts on their scatter is known well enough as it is.
const ENOUGH_PARTS: usize = 8;
/// The least variance where neighbours count, over that without them.
const MIN_VARIANCE_RATIO: f64 = 0.2;

/// What each part of the data does to the unknowns.
pub(super) struct Scatter {
    /// Changes of the unknowns, scaled so that their squares add to the variance: place of the force, part, then unknown and turn.
    places: Vec<Vec<Mat<f64>>>,
    kind: ScatterKind,
}

enum ScatterKind {
    /// Parts that know nothing of each other.
    Parts,
    /// Parts that leak into the next.
    Neighbours,
    Lines,
}

impl Scatter {
    /// How often what parts leave out is turned.
    pub fn turns(parts: usize, sight: WindowBias) -> usize {
        if parts < ENOUGH_PARTS && matches!(sight, WindowBias::Cut { .. }) {
            2
        } else {
            1
        }
    }

    /// `change` is what each part that is left out does to the unknowns, by turns.
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

    /// `change` is what the rest of each line did to the unknowns, in two turns.
    pub fn of_lines(change: Vec<Mat<f64>>) -> Self {
        Self {
            places: vec![change],
            kind: ScatterKind::Lines,
        }
    }

    /// Degrees of freedom of the variances of a pole's numbers.
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

    /// Each line adds the mean of two squares, which varies by its own size: the fourth powers tell by how much the sum does.
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

    /// Variance of a number that changes by `slope` with the real and the imaginary part of pole `r`.
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
        // The mean was taken from the same parts, three times in each of these sums.
        let parts = parts.len() as f64;
        f64::max(own + 2.0 * pairs, MIN_VARIANCE_RATIO * own) * (parts - 1.0) / (parts - 3.0)
    }
}

/// Change of a number that changes by `slope` with the real and the imaginary part of pole `r`.
fn moved(change: &Mat<f64>, turn: usize, r: usize, slope: [f64; 2]) -> f64 {
    slope[0] * change[(2 * r, turn)] + slope[1] * change[(2 * r + 1, turn)]
}

//! The lowest modes of a structure.

use crate::block::{Block, LANES, gram};
use crate::factor::{Factor, Symbolic};
use crate::lanczos::{Krylov, Ritz};
use crate::uncoupled::uncoupled_modes;
use crate::{SparseError, SymmetricMatrix};
use jounce_linalg::Mat;

/// Magnitude of the first shift relative to the smallest ratio of a diagonal entry of the stiffness
/// to that of the mass, an upper bound of the lowest eigenvalue.
const FIRST_SHIFT: f64 = 1e-10;

/// Least magnitude of the first shift relative to the largest such ratio: roundoff of the
/// stiffness does not exceed it.
const LEAST_FIRST_SHIFT: f64 = 1e-12;

/// Blocks, and one more for every four modes, after which the space shows whether a shift is near the
/// lowest eigenvalues.
const PILOT_BLOCKS: usize = 5;

/// Shifts that are tried.
const MAX_SHIFTS: usize = 4;

/// Eigenvalues below this share of the magnitude of the shift are zero in the choice of the next.
const RIGID_SHARE: f64 = 0.1;

/// Restarts after which the iteration ends.
const MAX_RESTARTS: usize = 60;

/// Distances of the counting shift below the last eigenvalue, relative to its distance from the shift:
/// the next one is used where a pivot vanishes.
const COUNT_MARGINS: [f64; 3] = [1e-5, 2.3e-5, 6.1e-5];

/// Diagonal added to the mass, relative to its own, before its negative eigenvalues are counted.
const MASS_ROUNDOFF: f64 = 1e-10;

/// Modes of `K x = lambda M x`, the lowest first.
#[derive(Debug, Clone, PartialEq)]
pub struct LowestModes {
    /// Eigenvalues `lambda`, the squares of angular frequencies; near 0, of either sign, for
    /// rigid-body motions.
    pub eigenvalue: Vec<f64>,
    /// Shapes, one column per mode, with `x^T M x = 1`; the entry of largest magnitude is positive.
    pub shape: Mat<f64>,
    /// Bound of the error of each eigenvalue without that of roundoff in the solution: an eigenvalue
    /// lies within it.
    pub error_bound: Vec<f64>,
    /// Shift of the iteration, negative; 0 for diagonal matrices, which need none.
    pub shift: f64,
    /// Number of systems of equations solved.
    pub solves: usize,
}

/// Returns the `count` lowest modes.
///
/// The iteration ends when the error bound of each is at most `tolerance` times the distance of the
/// eigenvalue from the shift, and the number of negative pivots proves that the matrices have no other
/// eigenvalue below the last. Vectors of a repeated eigenvalue are orthogonal; their directions
/// within its space are arbitrary.
///
/// # Errors
/// `SizeMismatch`, `IndefiniteMass`, `IndefiniteStiffness`, `TooManyModes`, `Singular`, `NotConverged`.
///
/// # Limits
/// A stiffness with entries of relative roundoff `e` has lowest eigenvalues with errors of about `e`
/// times the largest eigenvalue, by any method.
pub fn lowest_modes(
    stiffness: &SymmetricMatrix,
    mass: &SymmetricMatrix,
    count: usize,
    tolerance: f64,
) -> Result<LowestModes, SparseError> {
    let problem = Problem::new(stiffness, mass)?;
    if let Some(modes) = uncoupled_modes(stiffness, mass, count) {
        return modes;
    }
    if count == 0 {
        return Ok(LowestModes {
            eigenvalue: Vec::new(),
            shape: Mat::zeros(mass.size(), 0),
            error_bound: Vec::new(),
            shift: 0.0,
            solves: 0,
        });
    }
    problem.check_mass()?;
    let mut shift = problem.first_shift().ok_or(SparseError::TooManyModes {
        count,
        available: 0,
    })?;
    let mut solves = 0;
    for attempt in 1..=MAX_SHIFTS {
        let factor = problem.factor(shift)?;
        if factor.negative() > 0 {
            return Err(SparseError::IndefiniteStiffness {
                negative: factor.negative(),
            });
        }
        let mut space = Krylov::new(&factor, mass);
        // Enough blocks to hold more vectors than there may be rigid-body motions.
        let pilot_blocks = PILOT_BLOCKS + count / LANES;
        while space.blocks() < pilot_blocks && space.exhausted().is_none() {
            space.extend();
        }
        let pilot = space.ritz().and_then(|ritz| better_shift(&ritz, shift));
        match pilot {
            Some(better) if attempt < MAX_SHIFTS => {
                solves += space.solves;
                shift = better;
            }
            _ => {
                let mut search = Search {
                    problem: &problem,
                    space,
                    shift,
                    count,
                    tolerance,
                };
                return search.modes(solves);
            }
        }
    }
    Err(SparseError::NotConverged {
        converged: 0,
        count,
        solves,
    })
}

/// A shift nearer to the lowest eigenvalues, if they are not far above the present one.
fn better_shift(ritz: &Ritz, shift: f64) -> Option<f64> {
    let finite = ritz.theta.iter().filter(|theta| **theta > 0.0);
    let values: Vec<f64> = finite.map(|theta| shift + 1.0 / theta).collect();
    let lowest = *values.first()?;
    let elastic = *values
        .iter()
        .find(|value| **value > RIGID_SHARE * shift.abs())?;
    // Without rigid-body motions any small shift will do; with them, one of the order of the first
    // elastic eigenvalue, so that both are accurate.
    let is_good = lowest >= -shift || elastic <= 10.0 * -shift;
    (!is_good).then_some(-elastic)
}

struct Problem<'a> {
    stiffness: &'a SymmetricMatrix,
    mass: &'a SymmetricMatrix,
    symbolic: Symbolic,
}

impl<'a> Problem<'a> {
    fn new(stiffness: &'a SymmetricMatrix, mass: &'a SymmetricMatrix) -> Result<Self, SparseError> {
        let symbolic = Symbolic::new(&stiffness.plus(1.0, mass)?);
        Ok(Self {
            stiffness,
            mass,
            symbolic,
        })
    }

    /// Factors `K - shift M`.
    fn factor(&self, shift: f64) -> Result<Factor<'_>, SparseError> {
        self.symbolic
            .factor(&self.stiffness.plus(-shift, self.mass)?)
    }

    fn check_mass(&self) -> Result<(), SparseError> {
        let size = self.mass.size();
        let diagonal: Vec<f64> = (0..size).map(|i| self.mass.entry(i, i)).collect();
        let largest = diagonal
            .iter()
            .fold(0.0, |max: f64, entry| max.max(entry.abs()));
        if largest == 0.0 {
            return Ok(());
        }
        let entry = |(i, own): (usize, &f64)| {
            let scale = if *own == 0.0 { largest } else { own.abs() };
            (i, i, MASS_ROUNDOFF * scale)
        };
        let roundoff = SymmetricMatrix::from_entries(size, diagonal.iter().enumerate().map(entry))?;
        let factor = self.symbolic.factor(&self.mass.plus(1.0, &roundoff)?)?;
        match factor.negative() {
            0 => Ok(()),
            negative => Err(SparseError::IndefiniteMass { negative }),
        }
    }

    /// A shift far below the lowest elastic eigenvalue; `None` without mass.
    fn first_shift(&self) -> Option<f64> {
        let ratio = |i: usize| {
            let (stiffness, mass) = (self.stiffness.entry(i, i), self.mass.entry(i, i));
            (mass > 0.0).then_some(stiffness / mass)
        };
        let ratios: Vec<f64> = (0..self.mass.size()).filter_map(ratio).collect();
        ratios.first()?;
        let positive = ratios.iter().copied().filter(|ratio| *ratio > 0.0);
        let smallest = positive.fold(f64::INFINITY, f64::min);
        let largest = ratios.iter().copied().fold(0.0, f64::max);
        // Without stiffness all modes are rigid, and any shift will do.
        let magnitude = (FIRST_SHIFT * smallest).max(LEAST_FIRST_SHIFT * largest);
        Some(if magnitude.is_finite() {
            -magnitude
        } else {
            -1.0
        })
    }
}

struct Search<'a> {
    problem: &'a Problem<'a>,
    space: Krylov<'a>,
    shift: f64,
    count: usize,
    tolerance: f64,
}

impl Search<'_> {
    /// Iterates until the wanted modes are accurate and proved to be the lowest.
    fn modes(&mut self, mut solves: usize) -> Result<LowestModes, SparseError> {
        let max_blocks = (2 * self.count).div_ceil(LANES) + 12;
        let mut restarts = 0;
        loop {
            let failed = |converged, solves| SparseError::NotConverged {
                converged,
                count: self.count,
                solves,
            };
            let Some(ritz) = self.space.ritz() else {
                return Err(failed(0, LANES * (solves + self.space.solves)));
            };
            if let Some(available) = self.space.exhausted().filter(|found| *found < self.count) {
                return Err(SparseError::TooManyModes {
                    count: self.count,
                    available,
                });
            }
            let converged = self.converged(&ritz);
            let is_complete = converged == self.count && self.none_missed(&ritz)?;
            if is_complete {
                solves += self.space.solves;
                return Ok(self.refined(&ritz, solves));
            }
            let is_full = self.space.blocks() >= max_blocks;
            if is_full || converged == self.count || self.space.exhausted().is_some() {
                restarts += 1;
                if restarts > MAX_RESTARTS {
                    return Err(failed(converged, LANES * (solves + self.space.solves)));
                }
                let with_random = converged == self.count || self.space.exhausted().is_some();
                self.space.restart(&ritz, self.count + LANES, with_random);
            }
            self.space.extend();
        }
    }

    /// Number of the first pairs that are accurate.
    fn converged(&self, ritz: &Ritz) -> usize {
        if self.space.exhausted().is_some() {
            return self.count;
        }
        let is_accurate = |(theta, residual): &(&f64, &f64)| **residual <= self.tolerance * **theta;
        let pairs = ritz.theta.iter().zip(&ritz.residual);
        pairs.take(self.count).take_while(is_accurate).count()
    }

    fn eigenvalue(&self, theta: f64) -> f64 {
        self.shift + 1.0 / theta
    }

    /// Whether the matrices have no more eigenvalues than found just below the last one.
    fn none_missed(&self, ritz: &Ritz) -> Result<bool, SparseError> {
        let theta = &ritz.theta[..self.count];
        let last = self.eigenvalue(theta[self.count - 1]);
        let mut outcome = Ok(false);
        for margin in COUNT_MARGINS {
            let mut below = last - margin * (last - self.shift);
            let found = theta
                .iter()
                .filter(|theta| self.eigenvalue(**theta) < below)
                .count();
            if found == 0 {
                // Rigid-body motions: the count is not nearer to them than roundoff of the stiffness.
                // At the shift there are no eigenvalues below.
                below = below.min(last + self.problem.first_shift().unwrap_or(0.0));
                if below <= self.shift {
                    return Ok(true);
                }
            }
            outcome = self
                .problem
                .factor(below)
                .map(|factor| factor.negative() == found);
            if outcome.is_ok() {
                break;
            }
        }
        outcome
    }

    /// Applies the operator once more, which also bounds the errors.
    fn refined(&mut self, ritz: &Ritz, solves: usize) -> LowestModes {
        let mass = self.problem.mass;
        let mut shape = Mat::zeros(mass.size(), self.count);
        let mut error_bound = Vec::with_capacity(self.count);
        for first in (0..self.count).step_by(LANES) {
            let vectors = self.space.vectors(ritz, first);
            let image = self.space.apply(&vectors);
            let norms = gram(&image, &mass.block_product(&image));
            let theta = |lane: usize| ritz.theta.get(first + lane).copied().unwrap_or(0.0);
            let rows = image.iter().zip(&vectors);
            let difference: Block = rows
                .map(|(image, x)| std::array::from_fn(|lane| image[lane] - theta(lane) * x[lane]))
                .collect();
            let residuals = gram(&difference, &mass.block_product(&difference));
            for lane in 0..LANES.min(self.count - first) {
                let residual = residuals[lane][lane].max(0.0).sqrt();
                error_bound.push(bound(theta(lane), residual));
                let entries = || image.iter().map(|row| row[lane]);
                let largest =
                    entries().fold(0.0, |max: f64, x| if x.abs() > max.abs() { x } else { max });
                let scale = norms[lane][lane].sqrt().recip().copysign(largest);
                let column = entries().map(|x| scale * x).enumerate();
                column.for_each(|(row, x)| shape[(row, first + lane)] = x);
            }
        }
        LowestModes {
            eigenvalue: ritz.theta[..self.count]
                .iter()
                .map(|theta| self.eigenvalue(*theta))
                .collect(),
            shape,
            error_bound,
            shift: self.shift,
            solves: LANES * (solves + self.count.div_ceil(LANES)),
        }
    }
}

/// Largest difference of the eigenvalue from one whose `theta` differs by at most the residual.
fn bound(theta: f64, residual: f64) -> f64 {
    if residual < theta {
        residual / (theta * (theta - residual))
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests;

//! Shapes of modes that are given with the matrices, in place of those of the eigenproblem.
//!
//! ```text
//! m = x^T M x,   x := x / sqrt(m),   w_R^2 = x^T K x        Rayleigh's quotient of each shape
//! |x^T M y|,   |x^T K y| / sqrt(x^T K x  y^T K y)           0 for two modes of the matrices
//! ```
//!
//! The structure has the terms `x^T M x = 1` and `w^2` of each mode alone. A motion `a x + b y` has
//! the kinetic energy `(a'^2 + b'^2) / 2 + a' b' x^T M y`: the term that is left out is at most the
//! share `|x^T M y|` of it. The same holds for the stiffness and the potential energy.
//!
//! Source of the orthogonality of modes: D. J. Ewins, Modal Testing (2nd edition, 2000), chapter 2.

use super::reduced::{Product, RIGID_SHARE, Reduced};
use crate::exchange::ExchangeFaults;
use jounce_linalg::{Mat, column};
use jounce_sparse::SymmetricMatrix;
use std::f64::consts::TAU;

/// Two shapes whose product is closer to 1 than this have no two motions within roundoff.
const SAME_SHAPE: f64 = 1e-12;

/// Shapes and perhaps their frequencies.
pub(super) struct GivenShapes {
    /// Degree of freedom x mode.
    shapes: Mat<f64>,
    frequency_hz: Option<Vec<f64>>,
}

impl GivenShapes {
    /// Returns the shapes of a set of matrices; `None` without them. Adds all faults of sizes and
    /// frequencies.
    pub(super) fn new(
        shapes: Option<Mat<f64>>,
        frequency_hz: Option<Mat<f64>>,
        size: usize,
        faults: &mut Vec<String>,
    ) -> Option<Self> {
        let modes = shapes.as_ref().map(Mat::ncols);
        if let Some(shapes) = &shapes {
            if shapes.nrows() != size {
                faults.push(format!(
                    "shapes has {} rows, one per degree of freedom, but must have {size}",
                    shapes.nrows()
                ));
            }
            if shapes.ncols() == 0 || shapes.ncols() > size {
                faults.push(format!(
                    "shapes has {} columns, one per mode, but must have 1 to {size}",
                    shapes.ncols()
                ));
            }
        }
        if let Some(frequency_hz) = &frequency_hz {
            faults.extend(frequency_faults(frequency_hz, modes));
        }
        let frequency_hz = frequency_hz
            .filter(|of| of.ncols() == 1)
            .map(|of| column(&of, 0).to_vec());
        shapes.map(|shapes| Self {
            shapes,
            frequency_hz,
        })
    }

    /// Returns the modes of the shapes in ascending frequency.
    ///
    /// # Errors
    /// All shapes without mass or with negative stiffness, and all pairs of equal shapes.
    pub(super) fn reduced(
        self,
        stiffness: &SymmetricMatrix,
        mass: &SymmetricMatrix,
    ) -> Result<Reduced, ExchangeFaults> {
        let mut faults = Vec::new();
        let mut modes = Vec::new();
        for mode in 0..self.shapes.ncols() {
            let shape = column(&self.shapes, mode);
            match normalised(shape, stiffness, mass) {
                Ok((shape, square)) => modes.push((mode, shape, square)),
                Err(message) => faults.push(format!("shapes: column {} {message}", mode + 1)),
            }
        }
        faults.extend(equal_shapes(&modes, mass));
        if !faults.is_empty() {
            return Err(ExchangeFaults(faults));
        }
        if let Some(frequency_hz) = &self.frequency_hz {
            modes.sort_by(|a, b| frequency_hz[a.0].total_cmp(&frequency_hz[b.0]));
        } else {
            modes.sort_by(|a, b| a.2.total_cmp(&b.2));
        }
        let frequency_hz = match &self.frequency_hz {
            Some(given) => modes.iter().map(|mode| given[mode.0]).collect(),
            None => rayleigh_hz(modes.iter().map(|mode| mode.2).collect()),
        };
        let columns = modes.into_iter().map(|mode| mode.1).collect();
        Ok(Reduced::of_shapes(columns, frequency_hz, stiffness, mass))
    }
}

/// Faults of the size and of the values of the frequencies.
fn frequency_faults(frequency_hz: &Mat<f64>, modes: Option<usize>) -> Vec<String> {
    let (rows, columns) = (frequency_hz.nrows(), frequency_hz.ncols());
    let Some(modes) = modes else {
        return vec!["frequency_hz belongs to shapes, which are missing".to_owned()];
    };
    if (rows, columns) != (modes, 1) {
        return vec![format!(
            "frequency_hz is {rows} x {columns}, but must be {modes} x 1: one value per column of shapes"
        )];
    }
    let values = column(frequency_hz, 0).iter().enumerate();
    values
        .filter(|(_, value)| **value < 0.0)
        .map(|(row, value)| {
            format!(
                "frequency_hz: entry ({}, 1) is {value}; it must be at least 0",
                row + 1
            )
        })
        .collect()
}

/// Returns a shape of unit modal mass, and its Rayleigh quotient.
fn normalised(
    shape: &[f64],
    stiffness: &SymmetricMatrix,
    mass: &SymmetricMatrix,
) -> Result<(Vec<f64>, f64), String> {
    let modal_mass = Product::new(mass, shape).dot(shape);
    if modal_mass <= 0.0 || !modal_mass.is_finite() {
        return Err(format!(
            "has the modal mass {modal_mass}; it must be above 0: check the degrees of freedom of the shapes"
        ));
    }
    let scale = modal_mass.sqrt().recip();
    let shape: Vec<f64> = shape.iter().map(|value| scale * value).collect();
    match Product::new(stiffness, &shape).dot(&shape) {
        square if square < 0.0 => Err(format!(
            "has the negative stiffness {square} per modal mass; the stiffness must be positive definite or zero"
        )),
        square => Ok((shape, square)),
    }
}

/// Faults of all pairs of shapes that are one motion.
fn equal_shapes(modes: &[(usize, Vec<f64>, f64)], mass: &SymmetricMatrix) -> Vec<String> {
    let mut faults = Vec::new();
    for (k, (second, shape, _)) in modes.iter().enumerate() {
        let momentum = mass.product(shape);
        for (first, other, _) in &modes[..k] {
            let product: f64 = other.iter().zip(&momentum).map(|(x, y)| x * y).sum();
            if product.abs() > 1.0 - SAME_SHAPE {
                faults.push(format!(
                    "shapes: columns {} and {} are the same shape but for a factor; remove one",
                    first + 1,
                    second + 1
                ));
            }
        }
    }
    faults
}

/// Frequencies of ascending Rayleigh quotients, 0 for rigid-body motions.
fn rayleigh_hz(square: Vec<f64>) -> Vec<f64> {
    let pairs = square.windows(2);
    let rigid = pairs
        .enumerate()
        .filter(|(_, pair)| pair[0] <= RIGID_SHARE * pair[1])
        .map(|(mode, _)| mode + 1)
        .next_back()
        .unwrap_or(0);
    let frequency = |(mode, square): (usize, f64)| match mode < rigid {
        true => 0.0,
        false => square.sqrt() / TAU,
    };
    square.into_iter().enumerate().map(frequency).collect()
}

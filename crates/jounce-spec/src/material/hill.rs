//! Electroelastic Hill operator of a pore.
//!
//! ```text
//! P = < B (B^T L B)^-1 B^T >      average over the unit sphere, B(z): gradient of (u, phi) along z, z_i = zeta_i / a_i
//! ```
//!
//! Source: Dunn and Taya, Int. J. Solids Struct. 30 (1993) 161.

use super::porous::PoreGeometry;
use jounce_linalg::{Mat, inverse};
use std::f64::consts::{PI, TAU};

/// Quadrature points along the polar axis. Few points suffice around the axis, because the
/// integrand has degree four in the angle.
const POLAR_PLACES: usize = 48;
const AROUND_PLACES: usize = 12;

/// Computes `P` of a medium: an average over directions scaled by the shape of the pore.
pub(super) fn hill(medium: &Mat<f64>, pores: PoreGeometry) -> Mat<f64> {
    let mut sum = Mat::zeros(9, 9);
    let polar = match pores {
        PoreGeometry::Spheroids(_) => gauss_legendre(POLAR_PLACES),
        PoreGeometry::Cylinders => vec![(0.0, 2.0)],
    };
    for (cos, weight) in polar {
        for k in 0..AROUND_PLACES {
            let around = TAU * k as f64 / AROUND_PLACES as f64;
            let sin = (1.0 - cos * cos).sqrt();
            let along = if let PoreGeometry::Spheroids(ratio) = pores {
                cos / ratio
            } else {
                0.0
            };
            let b = gradient([sin * around.cos(), sin * around.sin(), along]);
            let acoustic = inverse(&(b.transpose() * medium * &b));
            sum += &b * acoustic * b.transpose() * (weight / (2.0 * AROUND_PLACES as f64));
        }
    }
    sum
}

/// Returns `B`: `(strain, -E)` of a field `(u, phi)` that varies along `z`.
fn gradient(z: [f64; 3]) -> Mat<f64> {
    let mut b = Mat::zeros(9, 4);
    for i in 0..3 {
        b[(i, i)] = z[i];
        b[(6 + i, 3)] = z[i];
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        (b[(3 + i, j)], b[(3 + i, k)]) = (z[k], z[j]);
    }
    b
}

/// Computes Gauss-Legendre points and weights on (-1, 1), by Newton's method from Tricomi's initial
/// guess.
fn gauss_legendre(count: usize) -> Vec<(f64, f64)> {
    let legendre = |x: f64| {
        let (mut before, mut now) = (1.0, x);
        for j in 1..count {
            let n = j as f64;
            (before, now) = (now, ((2.0 * n + 1.0) * x * now - n * before) / (n + 1.0));
        }
        (now, count as f64 * (before - x * now) / (1.0 - x * x))
    };
    (0..count)
        .map(|k| {
            let mut x = (PI * (k as f64 + 0.75) / (count as f64 + 0.5)).cos();
            for _ in 0..8 {
                let (value, slope) = legendre(x);
                x -= value / slope;
            }
            let slope = legendre(x).1;
            (x, 2.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

//! Fourier transforms of real signals.
//!
//! The transforms of `realfft` are generic: each crate that plans one compiles all of them anew. This
//! crate plans them for doubles, so they are compiled once.
//!
//! ```
//! let plan = jounce_fft::forward(4);
//! let (mut samples, mut lines) = (vec![1.0, 0.0, -1.0, 0.0], plan.make_output_vec());
//! plan.process(&mut samples, &mut lines)?;
//! assert_eq!(lines.iter().map(|line| line.re).collect::<Vec<_>>(), [0.0, 2.0, 0.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use realfft::num_complex::Complex;
pub use realfft::{ComplexToReal, RealToComplex};

use realfft::RealFftPlanner;
use std::sync::Arc;

/// Plans the transform of `samples` real values to `samples / 2 + 1` lines, without a factor.
pub fn forward(samples: usize) -> Arc<dyn RealToComplex<f64>> {
    RealFftPlanner::new().plan_fft_forward(samples)
}

/// Plans the transform of `samples / 2 + 1` lines to `samples` real values, without a factor.
pub fn inverse(samples: usize) -> Arc<dyn ComplexToReal<f64>> {
    RealFftPlanner::new().plan_fft_inverse(samples)
}

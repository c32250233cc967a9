//! Fraction of the starts with its 95 % interval.
//!
//! Source: E. B. Wilson, J. Am. Stat. Assoc. 22 (1927) 209.

use jounce_signal::NORMAL_95;
use serde::Serialize;

/// A fraction and its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BasinFraction {
    /// Fraction found.
    pub fraction: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

/// Returns Wilson's interval of `hits` out of `of`.
pub fn wilson(hits: usize, of: usize) -> BasinFraction {
    if of == 0 {
        return BasinFraction {
            fraction: 0.0,
            low: 0.0,
            high: 1.0,
        };
    }
    let (n, z) = (of as f64, NORMAL_95);
    let p = hits as f64 / n;
    let middle = (p + z * z / (2.0 * n)) / (1.0 + z * z / n);
    let half = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt() / (1.0 + z * z / n);
    // The interval contains the fraction, which roundoff would violate for zero or `of` hits.
    BasinFraction {
        fraction: p,
        low: (middle - half).clamp(0.0, p),
        high: (middle + half).clamp(p, 1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both ends solve `(p - x)^2 = z^2 x (1 - x) / n`, the definition of the interval.
    #[test]
    fn ends_solve_the_equation_of_the_score_test() {
        for (hits, of) in [(0, 10), (3, 10), (120, 200), (200, 200)] {
            let share = wilson(hits, of);
            for end in [share.low, share.high] {
                let gap = (share.fraction - end).powi(2)
                    - NORMAL_95.powi(2) * end * (1.0 - end) / of as f64;
                assert!(gap.abs() < 1e-14, "{hits} of {of}: {share:?}");
            }
        }
    }

    #[test]
    fn the_interval_holds_the_fraction() {
        for (hits, of) in (1..500).flat_map(|of| [0, of / 3, of].map(|hits| (hits, of))) {
            let share = wilson(hits, of);
            assert!(
                0.0 <= share.low && share.low <= share.fraction,
                "{hits} of {of}: {share:?}"
            );
            assert!(
                share.fraction <= share.high && share.high <= 1.0,
                "{hits} of {of}: {share:?}"
            );
        }
    }
}

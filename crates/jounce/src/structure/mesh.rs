//! How finely a beam is divided: polynomials as high as the wanted modes need, or plain cubic elements of a given length.
//!
//! A mode of angular frequency `w` turns through the phase `w^(1/2) l (m/EI)^(1/4)` on a segment of length `l`, and `N` modes of a
//! set of beams turn through about `pi N` on all of them together (Weyl's count). On a segment of phase `2a` the Legendre
//! coefficients of `cos`, `sin`, `cosh`, `sinh` fall like `a^j / (2j + 1)!!`: the number of terms is the first at which this
//! bound, times `2j + 1`, has passed the tolerance. Segments that would need more than `MOST_TERMS` are divided equally.

use super::element::Element;
use super::layout::Segment;
use std::f64::consts::PI;

/// Highest number of curvature terms of an element (degree 23 of the displacement).
const MOST_TERMS: usize = 22;
/// Terms added to every element by each refinement.
const TERMS_PER_LEVEL: usize = 2;

/// A rule that divides segments into elements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Mesh {
    /// As many terms as the modes need.
    Spectral {
        /// Wave phase to be resolved per unit of `Segment::phase_per_root_frequency`.
        root_frequency: f64,
        /// Wanted relative error of the mode shapes.
        tolerance: f64,
        /// 0 for the first mesh, one more for each refinement.
        level: usize,
    },
    /// Cubic elements, equal within a segment.
    Cubic {
        /// Greatest length of an element, m.
        longest_m: f64,
    },
}

impl Mesh {
    /// The mesh of refinement `level` for the first `modes` modes of beams made of these segments.
    pub fn spectral<'a>(modes: usize, tolerance: f64, level: usize, segments: impl Iterator<Item = &'a Segment>) -> Self {
        let phase: f64 = segments.map(Segment::phase_per_root_frequency).sum();
        Self::Spectral { root_frequency: PI * modes as f64 / phase, tolerance, level }
    }

    /// The elements of a segment, from its start on.
    pub fn elements(&self, segment: &Segment) -> Vec<Element> {
        let (pieces, terms) = self.division(segment);
        let length_m = segment.length_m / pieces as f64;
        let element = |piece| Element { start_m: segment.start_m + piece as f64 * length_m, length_m, section: segment.section, terms };
        (0..pieces).map(element).collect()
    }

    /// Number of pieces of a segment and of terms of each.
    fn division(&self, segment: &Segment) -> (usize, usize) {
        match *self {
            Self::Cubic { longest_m } => (((segment.length_m / longest_m - 1e-9).ceil() as usize).max(1), 2),
            Self::Spectral { root_frequency, tolerance, level } => {
                let half_phase = root_frequency * segment.phase_per_root_frequency() / 2.0;
                let (pieces, terms) = (1..)
                    .map(|pieces| (pieces, terms_needed(half_phase / pieces as f64, tolerance)))
                    .find(|(_, terms)| *terms <= MOST_TERMS)
                    .unwrap_or((1, MOST_TERMS));
                (pieces, terms + level * TERMS_PER_LEVEL)
            }
        }
    }
}

/// Number of Legendre terms that bring waves of half phase `a` below `tolerance`.
fn terms_needed(a: f64, tolerance: f64) -> usize {
    let mut terms = 0;
    let mut coefficient = 1.0;
    while coefficient > tolerance || terms < 2 {
        terms += 1;
        coefficient *= a / (2 * terms - 1) as f64;
    }
    terms
}

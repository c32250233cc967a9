//! Mesh of a beam: polynomials of the degree that the required modes need, or plain cubic elements
//! of a given length.
//!
//! A mode of angular frequency `w` has the phase `w^(1/2) l (m/EI)^(1/4)` on a segment of length
//! `l`. Mode `N` of a set of beams has a phase of about `pi N` on all of them together (Weyl's
//! count). On a segment of phase `2a` the Legendre coefficients of `cos`, `sin`, `cosh`, `sinh`
//! decrease like `a^j / (2j + 1)!!`. The number of terms is the first at which this bound, times
//! `2j + 1`, is below the tolerance. Segments that would need more than `MAX_CURVATURE_TERMS` are
//! divided equally.

use super::element::Element;
use super::layout::BeamSegment;
use std::f64::consts::PI;

/// Largest number of curvature terms of an element (degree 23 of the displacement).
const MAX_CURVATURE_TERMS: usize = 22;

/// Rule that divides segments into elements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::structure) enum Mesh {
    /// As many terms as the modes need.
    Spectral {
        /// Wave phase to resolve per unit of `BeamSegment::phase_per_root_frequency`.
        root_frequency: f64,
        /// Required relative error of the mode shapes.
        tolerance: f64,
    },
    /// Cubic elements, equal within a segment.
    Cubic {
        /// Largest length of an element, m.
        longest_m: f64,
    },
}

impl Mesh {
    /// Returns the mesh for the first `modes` modes of beams with these segments.
    pub fn spectral<'a>(
        modes: usize,
        tolerance: f64,
        segments: impl Iterator<Item = &'a BeamSegment>,
    ) -> Self {
        let phase: f64 = segments.map(BeamSegment::phase_per_root_frequency).sum();
        Self::Spectral {
            root_frequency: PI * modes as f64 / phase,
            tolerance,
        }
    }

    /// Returns the elements of a segment, from its start.
    pub fn elements(&self, segment: &BeamSegment) -> Vec<Element> {
        let (pieces, terms) = self.division(segment);
        let length_m = segment.length_m / pieces as f64;
        let element = |piece| Element {
            start_m: segment.start_m + piece as f64 * length_m,
            length_m,
            section: segment.section,
            terms,
        };
        (0..pieces).map(element).collect()
    }

    /// Returns the number of pieces of a segment and of terms of each.
    fn division(&self, segment: &BeamSegment) -> (usize, usize) {
        match *self {
            Self::Cubic { longest_m } => (
                ((segment.length_m / longest_m - 1e-9).ceil() as usize).max(1),
                2,
            ),
            Self::Spectral {
                root_frequency,
                tolerance,
            } => {
                let half_phase = root_frequency * segment.phase_per_root_frequency() / 2.0;
                let divided =
                    |pieces| (pieces, terms_needed(half_phase / pieces as f64, tolerance));
                (1..)
                    .map(divided)
                    .find(|(_, terms)| *terms <= MAX_CURVATURE_TERMS)
                    .unwrap_or((1, MAX_CURVATURE_TERMS))
            }
        }
    }
}

/// Returns the number of Legendre terms that resolve waves of half phase `a` to `tolerance`.
fn terms_needed(a: f64, tolerance: f64) -> usize {
    let mut terms = 0;
    let mut coefficient = 1.0;
    while coefficient > tolerance || terms < 2 {
        terms += 1;
        coefficient *= a / (2 * terms - 1) as f64;
    }
    terms
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::beam::section::CrossSection;

    fn segment(length_m: f64) -> BeamSegment {
        let section = CrossSection {
            bending_stiffness_n_m2: 1.0,
            mass_per_length_kg_m: 1.0,
            neutral_axis_m: 0.0,
            coated_m: [0.0; 2],
        };
        BeamSegment {
            start_m: 0.1,
            length_m,
            section,
        }
    }

    #[test]
    fn terms_follow_the_wave_phase() {
        let segments = [segment(0.1), segment(0.9)];
        let mesh = Mesh::spectral(8, 1e-9, segments.iter());
        let [short, long] = segments.map(|beam_segment| mesh.elements(&beam_segment));
        assert_eq!((short.len(), short[0].terms), (1, 11));
        assert_eq!((long.len(), long[0].terms), (2, 21));
        assert!((long[1].start_m - 0.55).abs() < 1e-15 && long[0].terms <= MAX_CURVATURE_TERMS);
    }

    #[test]
    fn waves_resolved_by_the_terms_are_below_the_tolerance() {
        for a in [0.1, 1.0, 5.0] {
            let terms = terms_needed(a, 1e-9);
            let bound = |count: usize| (0..count).map(|j| a / (2 * j + 1) as f64).product::<f64>();
            assert!(
                bound(terms) <= 1e-9 && bound(terms - 1) > 1e-9,
                "{a}: {terms}"
            );
        }
    }

    #[test]
    fn cubic_elements_are_as_long_as_allowed() {
        let mesh = Mesh::Cubic { longest_m: 0.1 };
        assert_eq!(
            [0.04, 0.1, 0.3, 0.31].map(|length_m| mesh.elements(&segment(length_m)).len()),
            [1, 1, 3, 4]
        );
    }
}

//! Placement of the parts of a body: motion of the start of each element, and its rows of the mass
//! factor.

use super::body::Support;
use crate::structure::assembly::Row;
use crate::structure::beam::element::Element;
use jounce_linalg::Mat;
use jounce_spec::{Beam, Mass};

/// A part with its coordinates.
#[derive(Debug, Clone)]
pub(super) enum BodyPart {
    Mass {
        motion: PlaceMotion,
        mass_kg: f64,
        rotary_inertia_kg_m2: f64,
    },
    Beam(Vec<PlacedElement>),
}

/// Motion of a place.
#[derive(Debug, Clone)]
pub(super) struct PlaceMotion {
    pub displacement: Row,
    pub slope: Row,
}

/// An element, its coordinates, and the motion of its start.
#[derive(Debug, Clone)]
pub(super) struct PlacedElement {
    pub element: Element,
    first_column: usize,
    pub start: PlaceMotion,
}

impl BodyPart {
    /// Number of rows of `G`.
    pub fn mass_rows(&self) -> usize {
        match self {
            Self::Mass {
                rotary_inertia_kg_m2,
                ..
            } => 1 + usize::from(*rotary_inertia_kg_m2 > 0.0),
            Self::Beam(chain) => chain.iter().map(PlacedElement::mass_rows).sum(),
        }
    }

    /// Writes the rows of `G`, starting at `row`.
    pub fn add_mass(&self, factor: &mut Mat<f64>, row: usize) {
        match self {
            Self::Mass {
                motion,
                mass_kg,
                rotary_inertia_kg_m2,
            } => {
                let mut put = |row: usize, root: f64, motion: &Row| {
                    motion
                        .iter()
                        .enumerate()
                        .filter(|(_, value)| **value != 0.0)
                        .for_each(|(column, value)| factor[(row, column)] = root * value);
                };
                put(row, mass_kg.sqrt(), &motion.displacement);
                if *rotary_inertia_kg_m2 > 0.0 {
                    put(row + 1, rotary_inertia_kg_m2.sqrt(), &motion.slope);
                }
            }
            Self::Beam(chain) => {
                let mut row = row;
                for element in chain {
                    element.add_mass(factor, row);
                    row += element.mass_rows();
                }
            }
        }
    }

    /// Returns a unit translation in the rows of `G`.
    pub fn translation(&self) -> Vec<f64> {
        match self {
            Self::Mass { mass_kg, .. } => std::iter::once(mass_kg.sqrt())
                .chain(std::iter::repeat_n(0.0, self.mass_rows() - 1))
                .collect(),
            Self::Beam(chain) => {
                let of = |element: &PlacedElement| {
                    std::iter::once(element.element.mass_weight(0))
                        .chain(std::iter::repeat_n(0.0, element.mass_rows() - 1))
                };
                chain.iter().flat_map(of).collect()
            }
        }
    }
}

/// A mass on its support. On a spring it has its own coordinate and does not rotate; free, it has
/// only that coordinate.
pub(super) fn mass_part(
    mass: &Mass,
    on: Support,
    support: PlaceMotion,
    next_column: &mut usize,
) -> BodyPart {
    let row_of_element = mass
        .stiffness_n_m
        .map(|stiffness_n_m| 1.0 / stiffness_n_m.sqrt())
        .or((on == Support::Nothing).then_some(1.0));
    let mut motion = support;
    if let Some(displacement) = row_of_element {
        motion.displacement[*next_column] += displacement;
        motion.slope.fill(0.0);
        *next_column += 1;
    }
    BodyPart::Mass {
        motion,
        mass_kg: mass.mass_kg,
        rotary_inertia_kg_m2: mass.rotary_inertia_kg_m2,
    }
}

/// Returns the motion of the root of a beam on its support: a flexible clamp rotates by its own
/// coordinate.
pub(super) fn clamped(beam: &Beam, support: PlaceMotion, next_column: &mut usize) -> PlaceMotion {
    let mut motion = support;
    if let Some(stiffness_n_m_rad) = beam.root_stiffness_n_m_rad {
        motion.slope[*next_column] += 1.0 / stiffness_n_m_rad.sqrt();
        *next_column += 1;
    }
    motion
}

/// Places a chain of elements one after the other from a root with the motion `root`.
pub(super) fn chained(
    elements: Vec<Element>,
    root: PlaceMotion,
    next_column: &mut usize,
) -> Vec<PlacedElement> {
    let PlaceMotion {
        mut displacement,
        mut slope,
    } = root;
    let mut chain = Vec::with_capacity(elements.len());
    for element in elements {
        let first_column = *next_column;
        chain.push(PlacedElement {
            element,
            first_column,
            start: PlaceMotion {
                displacement: displacement.clone(),
                slope: slope.clone(),
            },
        });
        for (w, rotation) in displacement.iter_mut().zip(&slope) {
            *w += element.length_m * rotation;
        }
        let [by_mean, by_gradient] = element.end_displacement();
        displacement[first_column] += by_mean;
        displacement[first_column + 1] += by_gradient;
        slope[first_column] += element.end_slope();
        *next_column += element.terms;
    }
    chain
}

impl PlacedElement {
    fn mass_rows(&self) -> usize {
        self.element.terms + 2
    }

    /// Adds the contribution of an element to a row.
    pub fn add(&self, row: &mut Row, row_of_element: &[f64]) {
        for (entry, value) in row[self.first_column..].iter_mut().zip(row_of_element) {
            *entry += value;
        }
    }

    /// Writes the weighted Legendre coefficients of the displacement into `factor`, starting at
    /// `row`.
    fn add_mass(&self, factor: &mut Mat<f64>, row: usize) {
        let weight: Vec<f64> = (0..self.mass_rows())
            .map(|order| self.element.mass_weight(order))
            .collect();
        let half_m = self.element.length_m / 2.0;
        for column in 0..self.first_column {
            let by_slope_m = half_m * self.start.slope[column];
            factor[(row, column)] = weight[0] * (self.start.displacement[column] + by_slope_m);
            factor[(row + 1, column)] = weight[1] * by_slope_m;
        }
        for j in 0..self.element.terms {
            for (order, coefficient) in self.element.displacement_orders(j) {
                factor[(row + order, self.first_column + j)] += weight[order] * coefficient;
            }
        }
    }
}

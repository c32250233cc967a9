//! A connected structure in coordinates of strain: stiffness is the identity, mass is `G^T G`.
//!
//! Every structure of a spec is statically determinate (cantilevers on the ground or on a sprung mass), so the map from its
//! degrees of freedom to its strains is square and is inverted by integrating along the beam, with no solve:
//!
//! ```text
//! s        = (sqrt(k) u, sqrt(EI l / (2j+1)) c_j of every element)     coordinates, J^(1/2)
//! U        = s^T s / 2                                                 strain energy
//! T        = |G s'|^2 / 2                                              kinetic energy
//! x(point) = row(point) s                                              displacement, m
//! ```
//!
//! A row holds the flexibility of its point: `row . row` is its static displacement per unit force, exact on any mesh that has a
//! node there. A mass without a spring is its own coordinate 0 (`s_0 = u`) without strain energy.

use super::body::Body;
use super::element::Element;
use super::error::StructureError;
use faer::Mat;

/// Displacement or slope per unit of each strain coordinate.
pub(super) type Row = Vec<f64>;

/// A body divided into elements.
#[derive(Debug, Clone)]
pub(super) struct Assembly<'a> {
    pub body: Body<'a>,
    /// Number of coordinates.
    pub columns: usize,
    /// The first coordinate is a rigid-body motion.
    pub rigid: bool,
    root: Row,
    beams: Vec<Vec<Placed>>,
}

/// An element, its coordinates, and how its start moves.
#[derive(Debug, Clone)]
struct Placed {
    element: Element,
    first_column: usize,
    start_displacement: Row,
    start_slope: Row,
}

impl<'a> Assembly<'a> {
    /// Chains the elements of each beam of the body, `elements` in the order of `body.beams`.
    pub fn new(body: Body<'a>, elements: Vec<Vec<Element>>) -> Self {
        let support = usize::from(body.mass.is_some());
        let columns = support + elements.iter().flatten().map(|element| element.terms).sum::<usize>();
        let stiffness_n_m = body.mass.map_or(0.0, |(_, mass)| mass.stiffness_n_m);
        let rigid = body.mass.is_some() && stiffness_n_m == 0.0;
        let mut root = vec![0.0; columns];
        if body.mass.is_some() {
            root[0] = if rigid { 1.0 } else { 1.0 / stiffness_n_m.sqrt() };
        }
        let mut next_column = support;
        let beams = elements.into_iter().map(|chain| chained(chain, &root, &mut next_column)).collect();
        Self { body, columns, rigid, root, beams }
    }

    /// Displacement of the mass or of the clamped roots.
    pub fn root_displacement(&self) -> &Row {
        &self.root
    }

    /// Displacement of beam `beam` (its place in `body.beams`) at `place_m` from the root.
    pub fn displacement(&self, beam: usize, place_m: f64) -> Row {
        let placed = self.element_at(beam, place_m);
        let offset_m = place_m - placed.element.start_m;
        let mut row: Row = placed.start_displacement.iter().zip(&placed.start_slope).map(|(w, slope)| w + offset_m * slope).collect();
        placed.add(&mut row, &placed.element.displacement(offset_m));
        row
    }

    /// Slope of beam `beam` at `place_m` from the root.
    pub fn slope(&self, beam: usize, place_m: f64) -> Row {
        let placed = self.element_at(beam, place_m);
        let mut row = placed.start_slope.clone();
        placed.add(&mut row, &placed.element.slope(place_m - placed.element.start_m));
        row
    }

    /// Displacement of the free end of each beam; of the mass where it carries none.
    pub fn free_ends(&self) -> Vec<Row> {
        let end_m = |chain: &Vec<Placed>| chain.last().map_or(0.0, |placed| placed.element.start_m + placed.element.length_m);
        let ends: Vec<Row> = self.beams.iter().enumerate().map(|(beam, chain)| self.displacement(beam, end_m(chain))).collect();
        if ends.is_empty() { vec![self.root.clone()] } else { ends }
    }

    /// The mass factor `G`.
    ///
    /// # Errors
    /// `NotRepresentable` where an entry is not finite.
    pub fn mass_factor(&self) -> Result<Mat<f64>, StructureError> {
        let support = usize::from(self.body.mass.is_some());
        let rows = support + self.beams.iter().flatten().map(Placed::mass_rows).sum::<usize>();
        let mut factor = Mat::zeros(rows, self.columns);
        if let Some((_, mass)) = self.body.mass {
            factor[(0, 0)] = mass.mass_kg.sqrt() * self.root[0];
        }
        let mut row = support;
        for placed in self.beams.iter().flatten() {
            placed.add_mass(&mut factor, row);
            row += placed.mass_rows();
        }
        let finite = factor.col_iter().all(|column| column.iter().all(|entry| entry.is_finite()));
        if finite { Ok(factor) } else { Err(StructureError::NotRepresentable { body: self.body.name().into() }) }
    }

    /// Mass that moves with each strain coordinate under a unit translation of everything: `G^T g`, with `g` the translation in the rows
    /// of `G`. Its product with a mass-normalised mode is the participation of the mode in a uniform acceleration of the base.
    ///
    /// # Errors
    /// As [`Assembly::mass_factor`].
    pub fn translated_mass(&self) -> Result<Row, StructureError> {
        let factor = self.mass_factor()?;
        let mut translation = vec![0.0; factor.nrows()];
        let support = usize::from(self.body.mass.is_some());
        if let Some((_, mass)) = self.body.mass {
            translation[0] = mass.mass_kg.sqrt();
        }
        let mut row = support;
        for placed in self.beams.iter().flatten() {
            translation[row] = placed.element.mass_weight(0);
            row += placed.mass_rows();
        }
        Ok(factor.col_iter().map(|column| column.iter().zip(&translation).map(|(entry, unit)| entry * unit).sum()).collect())
    }

    fn element_at(&self, beam: usize, place_m: f64) -> &Placed {
        let chain = &self.beams[beam];
        let after = chain.partition_point(|placed| placed.element.start_m <= place_m);
        &chain[after.saturating_sub(1)]
    }
}

/// Places a chain of elements one after the other from a root that moves as `root` and does not turn.
fn chained(elements: Vec<Element>, root: &Row, next_column: &mut usize) -> Vec<Placed> {
    let (mut displacement, mut slope) = (root.clone(), vec![0.0; root.len()]);
    let mut chain = Vec::with_capacity(elements.len());
    for element in elements {
        let first_column = *next_column;
        chain.push(Placed { element, first_column, start_displacement: displacement.clone(), start_slope: slope.clone() });
        for (w, turned) in displacement.iter_mut().zip(&slope) {
            *w += element.length_m * turned;
        }
        let [by_mean, by_gradient] = element.end_displacement();
        displacement[first_column] += by_mean;
        displacement[first_column + 1] += by_gradient;
        slope[first_column] += element.end_slope();
        *next_column += element.terms;
    }
    chain
}

impl Placed {
    fn mass_rows(&self) -> usize {
        self.element.terms + 2
    }

    fn add(&self, row: &mut Row, own: &[f64]) {
        for (entry, value) in row[self.first_column..].iter_mut().zip(own) {
            *entry += value;
        }
    }

    /// Writes the weighted Legendre coefficients of the displacement into `factor`, from `row` on.
    fn add_mass(&self, factor: &mut Mat<f64>, row: usize) {
        let weight: Vec<f64> = (0..self.mass_rows()).map(|order| self.element.mass_weight(order)).collect();
        let half_m = self.element.length_m / 2.0;
        for column in 0..self.first_column {
            let by_slope_m = half_m * self.start_slope[column];
            factor[(row, column)] = weight[0] * (self.start_displacement[column] + by_slope_m);
            factor[(row + 1, column)] = weight[1] * by_slope_m;
        }
        for j in 0..self.element.terms {
            for (order, coefficient) in self.element.displacement_orders(j) {
                factor[(row + order, self.first_column + j)] += weight[order] * coefficient;
            }
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::spec::Mass;
    use crate::structure::section::CrossSection;

    fn stepped(terms: usize) -> Vec<Element> {
        let section = |bending_stiffness_n_m2| CrossSection { bending_stiffness_n_m2, mass_per_length_kg_m: 0.08, neutral_axis_m: 0.0 };
        let element = |start_m, length_m, stiffness| Element { start_m, length_m, section: section(stiffness), terms };
        vec![element(0.0, 0.1, 0.2), element(0.1, 0.05, 0.2), element(0.15, 0.15, 0.1)]
    }

    fn square(row: &Row) -> f64 {
        row.iter().map(|value| value * value).sum()
    }

    /// A unit force at the end: `1/k + integral of (L - x)^2 / EI`; measured 3e-16.
    #[test]
    fn rows_hold_the_static_flexibility() {
        let mass = Mass { mass_kg: 2.0, stiffness_n_m: 400.0, damping_ratio: 0.0 };
        for terms in [2, 7] {
            let body = Body { mass: Some(("table", &mass)), beams: vec!["beam"] };
            let assembly = Assembly::new(body, vec![stepped(terms)]);
            let exact = 1.0 / 400.0 + (0.3_f64.powi(3) - 0.15_f64.powi(3)) / (3.0 * 0.2) + 0.15_f64.powi(3) / (3.0 * 0.1);
            assert!((square(&assembly.displacement(0, 0.3)) / exact - 1.0).abs() < 1e-14);
            let inside = 1.0 / 400.0 + 0.1_f64.powi(3) / (3.0 * 0.2);
            assert!((square(&assembly.displacement(0, 0.1)) / inside - 1.0).abs() < 1e-14);
            let turned = 0.15 / 0.2 + 0.15 / 0.1;
            assert!((square(&assembly.slope(0, 0.3)) / turned - 1.0).abs() < 1e-14);
        }
    }

    /// Rigid motion of a free mass: column 0 of `G` weighs all that moves.
    #[test]
    fn rigid_column_has_the_total_mass() {
        let mass = Mass { mass_kg: 2.0, stiffness_n_m: 0.0, damping_ratio: 0.0 };
        let body = Body { mass: Some(("table", &mass)), beams: vec!["beam"] };
        let factor = Assembly::new(body, vec![stepped(4)]).mass_factor().unwrap();
        assert!((factor.col(0).squared_norm_l2() - 2.0 - 0.08 * 0.3).abs() < 1e-14);
    }

    #[test]
    fn free_ends_are_the_ends_of_the_beams() {
        let assembly = Assembly::new(Body { mass: None, beams: vec!["beam"] }, vec![stepped(3)]);
        assert_eq!(assembly.free_ends(), [assembly.displacement(0, 0.3)]);
        assert!(assembly.root_displacement().iter().all(|value| *value == 0.0));
    }
}

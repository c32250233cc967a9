//! A connected structure in strain coordinates: stiffness is the identity, mass is `G^T G`.
//!
//! Every structure of a spec is a tree: each beam and mass has one support. The map from its
//! degrees of freedom to its strains is therefore square. Integration from the support outwards
//! inverts it without a solve:
//!
//! ```text
//! s        = (sqrt(k) (u - w), sqrt(EI l / (2j+1)) c_j of every element)     coordinates, J^(1/2)
//!            and sqrt(k_r) (w' - v) of every clamp that is not rigid, k_r its rotary stiffness (N m/rad)
//! U        = s^T s / 2                                                       strain energy
//! T        = |G s'|^2 / 2                                                    kinetic energy
//! x(point) = row(point) s                                                    displacement, m
//! ```
//!
//! with `u` the displacement of a mass, `w` the displacement of the support of its spring, `w'` the
//! slope of a root and `v` the slope of the support of the root. A row holds the flexibility of its
//! point: `row . row` is its static displacement per unit force, exact on any mesh with a node
//! there. A free mass is its own coordinate 0 (`s_0 = u`) without strain energy. A mass fixed to a
//! beam adds `sqrt(m) w` and `sqrt(J) w'` to the sum of squares of the kinetic energy.

pub(super) mod body;
mod mass;
mod placement;
pub(super) mod reduction;
pub(super) mod refinement;
pub(super) mod solution;

use crate::structure::beam::element::Element;
use body::{Body, PartKind, Support};
use placement::{BodyPart, PlaceMotion, PlacedElement, chained, clamped, mass_part};

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
    /// One per part of the body.
    parts: Vec<BodyPart>,
}

impl<'a> Assembly<'a> {
    /// Places every part on its support; `elements` are those of each beam, by its index among the
    /// parts.
    pub fn new(body: Body<'a>, elements: Vec<Vec<Element>>) -> Self {
        let has_coordinate = |kind: &PartKind, on: &Support| match kind {
            PartKind::Mass(mass) => {
                usize::from(mass.stiffness_n_m.is_some() || *on == Support::Nothing)
            }
            PartKind::Beam(beam) => usize::from(beam.root_stiffness_n_m_rad.is_some()),
        };
        let coordinates: usize = body
            .parts
            .iter()
            .map(|part| has_coordinate(&part.kind, &part.on))
            .sum();
        let columns = coordinates
            + elements
                .iter()
                .flatten()
                .map(|element| element.terms)
                .sum::<usize>();
        let rigid = body
            .parts
            .first()
            .is_some_and(|part| part.on == Support::Nothing);
        let mut assembly = Self {
            columns,
            rigid,
            parts: Vec::with_capacity(body.parts.len()),
            body,
        };
        let mut next_column = 0;
        for (index, chain) in elements.into_iter().enumerate() {
            let part = assembly.body.parts[index];
            let support = assembly.motion_of(part.on);
            let body_part = match part.kind {
                PartKind::Mass(mass) => mass_part(mass, part.on, support, &mut next_column),
                PartKind::Beam(beam) => BodyPart::Beam(chained(
                    chain,
                    clamped(beam, support, &mut next_column),
                    &mut next_column,
                )),
            };
            assembly.parts.push(body_part);
        }
        assembly
    }

    /// Returns the displacement of the mass or of the clamped root that is part `part`.
    pub fn root_displacement(&self, part: usize) -> Row {
        match &self.parts[part] {
            BodyPart::Mass { motion, .. } => motion.displacement.clone(),
            BodyPart::Beam(chain) => chain.first().map_or_else(
                || vec![0.0; self.columns],
                |body_part| body_part.start.displacement.clone(),
            ),
        }
    }

    /// Returns the displacement of the beam that is part `part` at `position_m` from the root.
    pub fn displacement(&self, part: usize, position_m: f64) -> Row {
        let Some(body_part) = self.element_at(part, position_m) else {
            return self.root_displacement(part);
        };
        let offset_m = position_m - body_part.element.start_m;
        let start = &body_part.start;
        let mut row: Row = start
            .displacement
            .iter()
            .zip(&start.slope)
            .map(|(w, slope)| w + offset_m * slope)
            .collect();
        body_part.add(&mut row, &body_part.element.displacement(offset_m));
        row
    }

    /// Returns the slope of the beam that is part `part` at `position_m` from the root; for a mass,
    /// the slope of its support.
    pub fn slope(&self, part: usize, position_m: f64) -> Row {
        let Some(body_part) = self.element_at(part, position_m) else {
            return if let BodyPart::Mass { motion, .. } = &self.parts[part] {
                motion.slope.clone()
            } else {
                vec![0.0; self.columns]
            };
        };
        let mut row = body_part.start.slope.clone();
        body_part.add(
            &mut row,
            &body_part
                .element
                .slope(position_m - body_part.element.start_m),
        );
        row
    }

    /// Returns the curvature of the beam that is part `part` at `position_m` from the root, 1/m per
    /// coordinate.
    pub fn curvature(&self, part: usize, position_m: f64) -> Row {
        let mut row = vec![0.0; self.columns];
        if let Some(body_part) = self.element_at(part, position_m) {
            body_part.add(
                &mut row,
                &body_part
                    .element
                    .curvature(position_m - body_part.element.start_m),
            );
        }
        row
    }

    /// Returns the displacement of the end of each beam, in the order of their names; of each mass
    /// if there is no beam.
    pub fn free_ends(&self) -> Vec<Row> {
        let beams = self.body.beams();
        let ends: Vec<Row> = beams
            .iter()
            .map(|(part, _, beam)| self.displacement(*part, beam.length_m))
            .collect();
        if ends.is_empty() {
            self.body
                .masses()
                .map(|(part, ..)| self.root_displacement(part))
                .collect()
        } else {
            ends
        }
    }

    fn motion_of(&self, support: Support) -> PlaceMotion {
        match support {
            Support::Ground | Support::Nothing => PlaceMotion {
                displacement: vec![0.0; self.columns],
                slope: vec![0.0; self.columns],
            },
            Support::Mass(part) => PlaceMotion {
                displacement: self.root_displacement(part),
                slope: self.slope(part, 0.0),
            },
            Support::Point(part, position_m) => PlaceMotion {
                displacement: self.displacement(part, position_m),
                slope: self.slope(part, position_m),
            },
        }
    }

    fn element_at(&self, part: usize, position_m: f64) -> Option<&PlacedElement> {
        let BodyPart::Beam(chain) = &self.parts[part] else {
            return None;
        };
        let after = chain.partition_point(|body_part| body_part.element.start_m <= position_m);
        chain.get(after.saturating_sub(1))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::structure::assembly::body::bodies;
    use crate::structure::beam::section::CrossSection;
    use jounce_spec::{Beam, Mass, Spec};

    fn stepped(terms: usize) -> Vec<Element> {
        let section = |bending_stiffness_n_m2| CrossSection {
            bending_stiffness_n_m2,
            mass_per_length_kg_m: 0.08,
            neutral_axis_m: 0.0,
            coated_m: [0.0; 2],
        };
        let element = |start_m, length_m, stiffness| Element {
            start_m,
            length_m,
            section: section(stiffness),
            terms,
        };
        vec![
            element(0.0, 0.1, 0.2),
            element(0.1, 0.05, 0.2),
            element(0.15, 0.15, 0.1),
        ]
    }

    fn square(row: &Row) -> f64 {
        row.iter().map(|value| value * value).sum()
    }

    fn table(on: &str, stiffness_n_m: Option<f64>) -> Mass {
        Mass {
            on: on.into(),
            mass_kg: 2.0,
            rotary_inertia_kg_m2: 0.0,
            stiffness_n_m,
            damping_ratio: stiffness_n_m.map(|_| 0.0),
            velocity_m_s: None,
            friction_n_s_m: None,
        }
    }

    /// A beam of 0.3 m, by its name, on a mass of 2 kg.
    fn on_table(table: Mass) -> Spec {
        let beam = Beam {
            length_m: 0.3,
            root: "table".into(),
            ..crate::structure::beam::section::tests::paper_beam()
        };
        Spec {
            beam: [("beam".into(), beam)].into(),
            mass: [("table".into(), table)].into(),
            ..Spec::default()
        }
    }

    /// A unit force at the end: `1/k + integral of (L - x)^2 / EI`; measured 3e-16.
    #[test]
    fn rows_hold_the_static_flexibility() {
        let spec = on_table(table("ground", Some(400.0)));
        for terms in [2, 7] {
            let assembly = Assembly::new(
                bodies(&spec, &[]).unwrap().remove(0),
                vec![Vec::new(), stepped(terms)],
            );
            let exact = 1.0 / 400.0
                + (0.3_f64.powi(3) - 0.15_f64.powi(3)) / (3.0 * 0.2)
                + 0.15_f64.powi(3) / (3.0 * 0.1);
            assert!((square(&assembly.displacement(1, 0.3)) / exact - 1.0).abs() < 1e-14);
            let inside = 1.0 / 400.0 + 0.1_f64.powi(3) / (3.0 * 0.2);
            assert!((square(&assembly.displacement(1, 0.1)) / inside - 1.0).abs() < 1e-14);
            let rotation = 0.15 / 0.2 + 0.15 / 0.1;
            assert!((square(&assembly.slope(1, 0.3)) / rotation - 1.0).abs() < 1e-14);
        }
    }

    /// A second beam on the end of the first rotates with it: a force at its end also bends the
    /// first by its moment. Measured 4e-16.
    #[test]
    fn a_beam_on_a_beam_adds_its_flexibility() {
        let mut spec = on_table(table("ground", Some(400.0)));
        let arm = Beam {
            length_m: 0.3,
            root: "beam.end".into(),
            ..crate::structure::beam::section::tests::paper_beam()
        };
        spec.beam.insert("arm".into(), arm);
        let uniform = |length_m: f64| {
            let section = CrossSection {
                bending_stiffness_n_m2: 0.2,
                mass_per_length_kg_m: 0.08,
                neutral_axis_m: 0.0,
                coated_m: [0.0; 2],
            };
            vec![Element {
                start_m: 0.0,
                length_m,
                section,
                terms: 3,
            }]
        };
        let body = bodies(&spec, &[]).unwrap().remove(0);
        assert_eq!(
            body.parts.iter().map(|part| part.name).collect::<Vec<_>>(),
            ["table", "beam", "arm"]
        );
        let assembly = Assembly::new(body, vec![Vec::new(), uniform(0.3), uniform(0.3)]);
        let exact = 1.0 / 400.0 + 0.6_f64.powi(3) / (3.0 * 0.2);
        assert!((square(&assembly.displacement(2, 0.3)) / exact - 1.0).abs() < 1e-14);
        assert!((square(&assembly.slope(2, 0.3)) / (0.6 / 0.2) - 1.0).abs() < 1e-14);
    }

    /// Rigid motion of a free mass: column 0 of `G` has the weight of the total moving mass.
    #[test]
    fn rigid_column_has_the_total_mass() {
        let spec = on_table(table("nothing", None));
        let assembly = Assembly::new(
            bodies(&spec, &[]).unwrap().remove(0),
            vec![Vec::new(), stepped(4)],
        );
        assert!(assembly.rigid);
        assert!(
            (assembly.mass_factor().unwrap().column(0).norm_squared() - 2.0 - 0.08 * 0.3).abs()
                < 1e-14
        );
        assert_eq!(assembly.free_ends(), [assembly.displacement(1, 0.3)]);
    }
}

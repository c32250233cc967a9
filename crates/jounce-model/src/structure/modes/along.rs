//! Mode shapes along the beams, for figures.

use crate::structure::assembly::solution::StructureSolution;
use std::collections::BTreeMap;

/// The modes of one beam along its length.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamShape {
    /// Distances from the root, m, ascending, from 0 to the length of the beam.
    pub place_m: Vec<f64>,
    /// Mass-normalised displacement at each place, kg^-1/2, one value per mode.
    pub shape: Vec<Vec<f64>>,
}

impl BeamShape {
    /// Returns one mode at every place; `None` if there is no such mode.
    pub fn mode(&self, mode: usize) -> Option<Vec<f64>> {
        self.shape
            .iter()
            .map(|values| values.get(mode).copied())
            .collect()
    }
}

/// Returns the retained modes of each beam at `samples` equidistant places (at least 2).
pub(in crate::structure) fn beam_shapes(
    solution: &StructureSolution,
    samples: usize,
) -> BTreeMap<String, BeamShape> {
    let intervals = samples.max(2) - 1;
    let mut shapes = BTreeMap::new();
    for (part, (assembly, reduced)) in solution.parts.iter().enumerate() {
        let needed = solution.order.needed(part);
        for (index, name, beam) in assembly.body.beams() {
            let length_m = beam.length_m;
            let position_m: Vec<f64> = (0..=intervals)
                .map(|sample| length_m * sample as f64 / intervals as f64)
                .collect();
            let at = |position_m: &f64| {
                solution.order.spread(
                    part,
                    &reduced.modal(&assembly.displacement(index, *position_m), needed),
                )
            };
            let shape = position_m.iter().map(at).collect();
            shapes.insert(
                name.to_owned(),
                BeamShape {
                    place_m: position_m,
                    shape,
                },
            );
        }
    }
    shapes
}

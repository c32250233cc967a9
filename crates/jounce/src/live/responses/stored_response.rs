//! Responses computed so far, for the orbits of their points and for the next response.

use super::draft::Draft;
use crate::error::Error;
use jounce_analysis::{Branch, KnownOrbit, Model, Parameter};
use jounce_spec::{NumericKey, Spec};
use std::sync::Arc;

/// Stored response.
#[derive(Debug, Clone)]
pub struct StoredResponse {
    /// The design.
    pub spec: Spec,
    /// Key.
    pub key: NumericKey,
    /// Ends of its range, SI.
    pub range: (f64, f64),
    /// The branches.
    pub branches: Arc<Vec<Branch>>,
    /// Design and branches from which these were updated, point by point.
    pub origin: Option<Origin>,
    /// How a draft was found; `None` for a searched response.
    pub draft: Option<Draft>,
    /// Orbits from which the next search also starts.
    pub known_orbits: Vec<KnownOrbit>,
}

/// Origin of updated branches.
pub type Origin = (Spec, Arc<Vec<Branch>>);

impl StoredResponse {
    /// Returns the design at a value of the key.
    pub fn spec_at(&self, parameter: f64) -> Result<Spec, Error> {
        let mut spec = self.spec.clone();
        self.key.set(&mut spec, parameter)?;
        Ok(spec)
    }

    /// Returns the family of models over the key.
    pub fn parameter<'s>(&'s self, base: &'s Model) -> Parameter<'s> {
        Parameter::new(base, &self.key, self.range.1 - self.range.0)
    }
}

/// Returns the orbits at both ends and in the middle of each branch.
pub fn known_orbits<'b>(branches: impl Iterator<Item = &'b Branch>) -> Vec<KnownOrbit> {
    let branch_orbits = |branch: &Branch| {
        let count = branch.points.len();
        let mut indices = vec![0, count.saturating_sub(1), count / 2];
        indices.dedup();
        let orbit = |index: usize| {
            let point = branch.points.get(index)?;
            Some(KnownOrbit {
                period_cycles: branch.period_cycles,
                state: point.orbit.start().to_vec(),
                parameter: point.parameter,
            })
        };
        indices.into_iter().filter_map(orbit).collect::<Vec<_>>()
    };
    branches.flat_map(branch_orbits).collect()
}

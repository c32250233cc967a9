//! Responses computed so far, for the orbits of their points and for the next response.

use super::draft::Draft;
use jounce_analysis::{Branch, KnownOrbit, Model, Parameter};
use jounce_spec::{NumericKey, Spec};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Largest number of stored responses.
const MAX_STORED_RESPONSES: usize = 8;

/// Stored response.
#[derive(Debug, Clone)]
pub struct StoredResponse {
    /// Number of the response.
    pub id: u64,
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
}

/// Origin of updated branches.
pub type Origin = (Spec, Arc<Vec<Branch>>);

/// Last responses.
#[derive(Debug, Default)]
pub struct StoredResponses(Mutex<VecDeque<Arc<StoredResponse>>>);

impl StoredResponses {
    fn lock(&self) -> MutexGuard<'_, VecDeque<Arc<StoredResponse>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns a copy that the responses stored later in one of both do not change.
    pub fn fork(&self) -> Self {
        Self(Mutex::new(self.lock().clone()))
    }

    /// Stores a response; a fine response replaces the coarse one of its number.
    pub fn store(&self, response: StoredResponse) {
        let mut responses = self.lock();
        responses.retain(|stored| stored.id != response.id);
        responses.push_back(Arc::new(response));
        if responses.len() > MAX_STORED_RESPONSES {
            responses.pop_front();
        }
    }

    /// Returns the response of a number.
    pub fn find(&self, id: u64) -> Option<Arc<StoredResponse>> {
        self.lock().iter().find(|stored| stored.id == id).cloned()
    }

    /// Returns the last response over a key.
    pub fn last(&self, key: &str) -> Option<Arc<StoredResponse>> {
        self.lock()
            .iter()
            .rev()
            .find(|stored| stored.key.path() == key && !stored.branches.is_empty())
            .cloned()
    }
}

impl StoredResponse {
    /// Returns the family of models over the key.
    pub fn parameter<'s>(&'s self, base: &'s Model) -> Parameter<'s> {
        Parameter::new(base, &self.key, self.range.1 - self.range.0)
    }

    /// Returns the orbits at both ends and in the middle of each branch.
    pub fn orbits(&self) -> Vec<KnownOrbit> {
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
        self.branches.iter().flat_map(branch_orbits).collect()
    }
}

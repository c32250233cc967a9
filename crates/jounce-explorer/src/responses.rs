//! The responses that a page has been given, for the orbits behind their points and for the next response.

use jounce::analysis::{Branch, KnownOrbit};
use jounce::spec::{NumericKey, Spec};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Responses that are kept.
const MAX_STORED_RESPONSES: usize = 8;

/// A response.
#[derive(Debug)]
pub struct StoredResponse {
    /// Number of the request.
    pub id: u64,
    /// The design.
    pub spec: Spec,
    /// The key.
    pub key: NumericKey,
    /// Ends of its range, SI.
    pub range: (f64, f64),
    /// The branches.
    pub branches: Arc<Vec<Branch>>,
    /// The design and the branches from which these were carried over, point by point.
    pub origin: Option<Origin>,
}

/// Where branches came from.
pub type Origin = (Spec, Arc<Vec<Branch>>);

/// The last ones.
#[derive(Debug, Default)]
pub struct Responses(Mutex<VecDeque<Arc<StoredResponse>>>);

impl Responses {
    fn open(&self) -> MutexGuard<'_, VecDeque<Arc<StoredResponse>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Keeps a response; a finer one of the same request takes the place of the coarse one.
    pub fn keep(&self, answered: StoredResponse) {
        let mut kept = self.open();
        kept.retain(|known| known.id != answered.id);
        kept.push_back(Arc::new(answered));
        if kept.len() > MAX_STORED_RESPONSES {
            kept.pop_front();
        }
    }

    /// The response to a request.
    pub fn find(&self, id: u64) -> Option<Arc<StoredResponse>> {
        self.open().iter().find(|known| known.id == id).cloned()
    }

    /// The last response over a key.
    pub fn last(&self, key: &str) -> Option<Arc<StoredResponse>> {
        self.open()
            .iter()
            .rev()
            .find(|known| known.key.path() == key && !known.branches.is_empty())
            .cloned()
    }
}

impl StoredResponse {
    /// Orbits on its branches: both ends and the middle of each.
    pub fn orbits(&self) -> Vec<KnownOrbit> {
        let known = |branch: &Branch| {
            let count = branch.points.len();
            let mut places = vec![0, count.saturating_sub(1), count / 2];
            places.dedup();
            let orbit = |place: usize| {
                let point = branch.points.get(place)?;
                Some(KnownOrbit {
                    period_cycles: branch.period_cycles,
                    state: point.orbit.start().to_vec(),
                    parameter: point.parameter,
                })
            };
            places.into_iter().filter_map(orbit).collect::<Vec<_>>()
        };
        self.branches.iter().flat_map(known).collect()
    }
}

//! What a study without a known end has done so far.

use std::sync::atomic::{AtomicU64, Ordering};

/// A counter that any thread may read while the study runs.
#[derive(Debug, Default)]
pub struct Watch {
    harvesters: AtomicU64,
}

impl Watch {
    /// Harvesters made so far: one for each trial of an orbit.
    pub fn harvesters(&self) -> u64 {
        self.harvesters.load(Ordering::Relaxed)
    }

    pub(super) fn count(&self) {
        self.harvesters.fetch_add(1, Ordering::Relaxed);
    }
}

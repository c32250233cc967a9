//! Latest request of each kind on a socket: a new request cancels the previous one.

use crate::cancellation::Cancellation;
use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Running computation of each kind.
#[derive(Debug, Default)]
pub struct LatestRequests(Mutex<HashMap<String, Cancellation>>);

impl LatestRequests {
    fn open(&self) -> MutexGuard<'_, HashMap<String, Cancellation>> {
        // The map of flags is valid even after a panic of the thread that held it.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Cancels the computation of a kind and registers a new one.
    pub fn enter(&self, name: &str) -> Cancellation {
        let cancellation = Cancellation::default();
        if let Some(before) = self.open().insert(name.to_owned(), cancellation.clone()) {
            before.stop();
        }
        cancellation
    }

    /// Cancels the computation of a kind.
    pub fn stop(&self, name: &str) {
        if let Some(running) = self.open().remove(name) {
            running.stop();
        }
    }

    /// Cancels all computations.
    pub fn stop_all(&self) {
        self.open().drain().for_each(|(_, running)| running.stop());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_one_wins() {
        let lanes = LatestRequests::default();
        let (first, other) = (lanes.enter("response"), lanes.enter("orbit"));
        let second = lanes.enter("response");
        assert!(first.is_stopped() && !second.is_stopped() && !other.is_stopped());
        lanes.stop("orbit");
        assert!(other.is_stopped() && !second.is_stopped());
        lanes.stop_all();
        assert!(second.is_stopped());
    }
}

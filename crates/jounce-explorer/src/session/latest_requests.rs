//! Latest request of each kind on a socket: a new request cancels the previous one.

use super::cancellation::Cancellation;
use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Running computation of each kind.
#[derive(Debug, Default)]
pub struct LatestRequests(Mutex<HashMap<String, Cancellation>>);

impl LatestRequests {
    fn lock(&self) -> MutexGuard<'_, HashMap<String, Cancellation>> {
        // The map of flags is valid even after a panic of the thread that held it.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Cancels the computation of a kind and registers a new one.
    pub fn register(&self, name: &str) -> Cancellation {
        let cancellation = Cancellation::default();
        if let Some(previous) = self.lock().insert(name.to_owned(), cancellation.clone()) {
            previous.stop();
        }
        cancellation
    }

    /// Cancels the computation of a kind.
    pub fn stop(&self, name: &str) {
        if let Some(running) = self.lock().remove(name) {
            running.stop();
        }
    }

    /// Cancels all computations.
    pub fn stop_all(&self) {
        self.lock().drain().for_each(|(_, running)| running.stop());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_request_cancels_the_previous_one_of_its_kind() {
        let requests = LatestRequests::default();
        let (first, other) = (requests.register("response"), requests.register("orbit"));
        let second = requests.register("response");
        assert!(first.is_stopped() && !second.is_stopped() && !other.is_stopped());
        requests.stop("orbit");
        assert!(other.is_stopped() && !second.is_stopped());
        requests.stop_all();
        assert!(second.is_stopped());
    }
}

//! The last results of one kind, by the number of their request.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Largest number of results.
const MAX_STORED: usize = 8;

/// Last results.
#[derive(Debug)]
pub struct Recent<T>(Mutex<VecDeque<(u64, Arc<T>)>>);

impl<T> Default for Recent<T> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<T> Recent<T> {
    fn lock(&self) -> MutexGuard<'_, VecDeque<(u64, Arc<T>)>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns a copy that the results stored later in one of both do not change.
    pub fn fork(&self) -> Self {
        Self(Mutex::new(self.lock().clone()))
    }

    /// Stores a result under a number, in place of the one that has this number.
    pub fn store(&self, id: u64, result: Arc<T>) {
        let mut results = self.lock();
        results.retain(|(stored, _)| *stored != id);
        results.push_back((id, result));
        if results.len() > MAX_STORED {
            results.pop_front();
        }
    }

    /// Returns the result of a number.
    pub fn find(&self, id: u64) -> Option<Arc<T>> {
        let results = self.lock();
        let (_, found) = results.iter().find(|(stored, _)| *stored == id)?;
        Some(Arc::clone(found))
    }

    /// Returns all results with their numbers, the last one first.
    pub fn all(&self) -> Vec<(u64, Arc<T>)> {
        self.lock().iter().rev().cloned().collect()
    }
}

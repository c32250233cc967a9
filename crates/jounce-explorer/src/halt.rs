//! Stopping a computation from outside, and whether it was its time that was over.

use jounce::march::Watch;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The wish that a computation stops; its clones are the same wish. Every march under its watch ends before its next step.
#[derive(Debug, Clone, Default)]
pub struct Halt {
    watch: Watch,
    late: Arc<AtomicBool>,
}

impl Halt {
    /// Wishes it.
    pub fn stop(&self) {
        self.watch.stop();
    }

    /// Wishes it because the time is over.
    pub fn stop_late(&self) {
        if !self.is_stopped() {
            self.late.store(true, Ordering::Relaxed);
            self.stop();
        }
    }

    /// True where it was stopped because its time was over.
    pub fn is_late(&self) -> bool {
        self.late.load(Ordering::Relaxed)
    }

    /// True once somebody wished it.
    pub fn is_stopped(&self) -> bool {
        self.watch.is_stopped()
    }

    /// The watch of its marches.
    pub fn watch(&self) -> &Watch {
        &self.watch
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_computation_that_was_stopped_is_not_late() {
        let (stopped, late) = (Halt::default(), Halt::default());
        stopped.stop();
        stopped.clone().stop_late();
        late.clone().stop_late();
        assert!(stopped.is_stopped() && stopped.watch().is_stopped() && !stopped.is_late());
        assert!(late.is_stopped() && late.watch().is_stopped() && late.is_late());
    }
}

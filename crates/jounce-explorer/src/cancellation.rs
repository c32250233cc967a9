//! Stopping a computation from outside, and whether it was its time that was over.

use jounce::integrate::Control;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The wish that a computation stops; its clones are the same wish. Every march under its control ends before its next step.
#[derive(Debug, Clone, Default)]
pub struct Cancellation {
    control: Control,
    late: Arc<AtomicBool>,
}

impl Cancellation {
    /// Wishes it.
    pub fn stop(&self) {
        self.control.stop();
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
        self.control.is_stopped()
    }

    /// The control of its marches.
    pub fn control(&self) -> &Control {
        &self.control
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_computation_that_was_stopped_is_not_late() {
        let (stopped, late) = (Cancellation::default(), Cancellation::default());
        stopped.stop();
        stopped.clone().stop_late();
        late.clone().stop_late();
        assert!(stopped.is_stopped() && stopped.control().is_stopped() && !stopped.is_late());
        assert!(late.is_stopped() && late.control().is_stopped() && late.is_late());
    }
}

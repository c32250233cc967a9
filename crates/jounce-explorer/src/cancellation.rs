//! Cancellation of a computation by a user or by the time limit.

use jounce_core::integrate::Control;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Cancellation of a computation, shared by its clones. Every integration under its control ends
/// before its next step.
#[derive(Debug, Clone, Default)]
pub struct Cancellation {
    control: Control,
    late: Arc<AtomicBool>,
}

impl Cancellation {
    /// Cancels the computation.
    pub fn stop(&self) {
        self.control.stop();
    }

    /// Cancels the computation because it reached the time limit.
    pub fn stop_late(&self) {
        if !self.is_stopped() {
            self.late.store(true, Ordering::Relaxed);
            self.stop();
        }
    }

    /// True where the time limit cancelled it.
    pub fn is_late(&self) -> bool {
        self.late.load(Ordering::Relaxed)
    }

    /// True once it is cancelled.
    pub fn is_stopped(&self) -> bool {
        self.control.is_stopped()
    }

    /// Returns the control of its integrations.
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

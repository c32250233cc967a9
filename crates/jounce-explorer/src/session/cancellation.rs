//! Cancellation of a computation by a user or by the time limit.

use jounce::Control;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use tokio::sync::Notify;

/// Cancellation of a computation, shared by its clones. Every integration under its control ends
/// before its next step.
#[derive(Debug, Clone, Default)]
pub struct Cancellation {
    control: Control,
    timed_out: Arc<AtomicBool>,
    notify: Arc<Notify>,
}

impl Cancellation {
    /// Cancels the computation.
    pub fn stop(&self) {
        self.control.stop();
        self.notify.notify_waiters();
    }

    /// Waits until it is cancelled.
    pub async fn stopped(&self) {
        // A waiter is notified from its creation on.
        let notified = self.notify.notified();
        if !self.is_stopped() {
            notified.await;
        }
    }

    /// Cancels the computation because it reached the time limit.
    pub fn stop_on_timeout(&self) {
        if !self.is_stopped() {
            self.timed_out.store(true, Ordering::Relaxed);
            self.stop();
        }
    }

    /// True where the time limit cancelled it.
    pub fn is_timed_out(&self) -> bool {
        self.timed_out.load(Ordering::Relaxed)
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
    fn a_computation_stopped_by_its_user_has_not_timed_out() {
        let (stopped, timed_out) = (Cancellation::default(), Cancellation::default());
        stopped.stop();
        stopped.clone().stop_on_timeout();
        timed_out.clone().stop_on_timeout();
        assert!(stopped.is_stopped() && stopped.control().is_stopped() && !stopped.is_timed_out());
        assert!(
            timed_out.is_stopped() && timed_out.control().is_stopped() && timed_out.is_timed_out()
        );
    }
}

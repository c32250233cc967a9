//! Control of a computation from outside: cancellation, progress and wall time.
//!
//! Everyone who waits and every integration of the computation share one control (see
//! `with_control` of a kernel). An integration polls it before each step and therefore ends
//! within microseconds of a stop request. It reports its progress only on request.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, AtomicU64, Ordering};
use std::time::Duration;

/// No request.
const NO_REQUEST: u8 = 0;
/// Request for a progress report.
const PROGRESS_REQUEST: u8 = 1;
/// Request to stop.
const STOP_REQUEST: u8 = 2;

/// Number of parts of a run in progress reports.
const PROGRESS_PARTS: u64 = 1000;

/// Handle to a control; its clones refer to the same control.
#[derive(Debug, Clone, Default)]
pub struct Control {
    request: Arc<AtomicU8>,
    /// Wall time of all runs, ns.
    wall_time_ns: Arc<AtomicU64>,
    counts: Arc<Counts>,
    callback: Option<Callback>,
}

/// Callback of the working thread.
#[derive(Clone)]
struct Callback(Arc<dyn Fn(&Control) + Send + Sync>);

impl fmt::Debug for Callback {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Callback")
    }
}

#[derive(Debug, Default)]
struct Counts {
    done: AtomicU64,
    expected: AtomicU64,
    harvesters: AtomicU64,
    /// Bits of the length of the reported run, s; 0 without one.
    run_s: AtomicU64,
}

impl Control {
    /// Returns a control with this stop request, for a part of the work that counts its own parts.
    #[must_use]
    pub fn apart(&self) -> Self {
        Self {
            request: Arc::clone(&self.request),
            wall_time_ns: Arc::clone(&self.wall_time_ns),
            ..Self::default()
        }
    }

    /// Creates a control without a waiting thread. The working thread calls `visit` at its polls
    /// and every few dozen steps of its integrations; `visit` decides whether to act.
    #[must_use]
    pub fn with_callback(visit: impl Fn(&Self) + Send + Sync + 'static) -> Self {
        Self {
            callback: Some(Callback(Arc::new(visit))),
            ..Self::default()
        }
    }

    /// Runs the callback, if there is one.
    #[inline]
    fn call_back(&self) {
        if let Some(Callback(visit)) = &self.callback {
            visit(self);
        }
    }

    /// Requests that the computation stops. Finished results are retained.
    pub fn stop(&self) {
        self.request.store(STOP_REQUEST, Ordering::Relaxed);
    }

    /// True after a stop request.
    #[inline]
    pub fn is_stopped(&self) -> bool {
        self.call_back();
        self.request.load(Ordering::Relaxed) == STOP_REQUEST
    }

    /// True without a pending request.
    #[inline(always)]
    pub fn is_quiet(&self) -> bool {
        self.request.load(Ordering::Relaxed) == NO_REQUEST
    }

    /// Expects one run of this length, s, with thousandths as its parts.
    pub fn expect_run(&self, duration_s: f64) {
        self.counts
            .run_s
            .store(duration_s.to_bits(), Ordering::Relaxed);
        self.expect(PROGRESS_PARTS as usize);
    }

    /// Requests that the run reports its time before its next step.
    pub fn request_progress(&self) {
        if self.counts.run_s.load(Ordering::Relaxed) != 0 {
            let _ = self.request.compare_exchange(
                NO_REQUEST,
                PROGRESS_REQUEST,
                Ordering::Relaxed,
                Ordering::Relaxed,
            );
        }
    }

    /// Reports the current time of the run, s.
    pub fn report_progress(&self, time_s: f64) {
        let _ = self.request.compare_exchange(
            PROGRESS_REQUEST,
            NO_REQUEST,
            Ordering::Relaxed,
            Ordering::Relaxed,
        );
        let run_s = f64::from_bits(self.counts.run_s.load(Ordering::Relaxed));
        if run_s > 0.0 {
            let parts = PROGRESS_PARTS as f64 * (time_s / run_s).clamp(0.0, 1.0);
            self.counts.done.store(parts as u64, Ordering::Relaxed);
        }
    }

    /// Announces a number of further parts of the work.
    pub fn expect(&self, parts: usize) {
        self.counts
            .expected
            .fetch_add(parts as u64, Ordering::Relaxed);
    }

    /// Counts a finished part.
    pub fn count(&self) {
        self.counts.done.fetch_add(1, Ordering::Relaxed);
    }

    /// Counts a harvester that was built: one for each trial of an orbit.
    pub fn count_harvester(&self) {
        self.counts.harvesters.fetch_add(1, Ordering::Relaxed);
    }

    /// Returns the number of harvesters built so far, for work without a known end.
    pub fn harvesters(&self) -> u64 {
        self.counts.harvesters.load(Ordering::Relaxed)
    }

    /// Adds the wall time of a run.
    pub fn add_wall_time(&self, time: Duration) {
        self.wall_time_ns
            .fetch_add(time.as_nanos() as u64, Ordering::Relaxed);
    }

    /// Returns the total wall time of the integration in all runs, s, including parts with their
    /// own count.
    pub fn wall_time_s(&self) -> f64 {
        1e-9 * self.wall_time_ns.load(Ordering::Relaxed) as f64
    }

    /// Returns the numbers of finished and expected parts.
    pub fn progress(&self) -> (u64, u64) {
        (
            self.counts.done.load(Ordering::Relaxed),
            self.counts.expected.load(Ordering::Relaxed),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn callback_can_cancel_at_any_poll() {
        let polls = Arc::new(AtomicU64::new(0));
        let counter = Arc::clone(&polls);
        let control = Control::with_callback(move |control| {
            if counter.fetch_add(1, Ordering::Relaxed) == 2 {
                control.stop();
            }
        });
        assert_eq!(
            [
                control.is_stopped(),
                control.is_stopped(),
                control.is_stopped(),
                control.is_quiet()
            ],
            [false, false, true, false]
        );
        assert!(
            control.apart().is_stopped() && polls.load(Ordering::Relaxed) == 3,
            "a part of the work shares the stop request, not the callbacks"
        );
    }

    #[test]
    fn run_reports_its_time_per_request_and_cancellation_persists() {
        let control = Control::default();
        control.request_progress();
        assert!(control.is_quiet(), "there is no run");
        control.expect_run(8.0);
        assert_eq!(control.progress(), (0, 1000));
        control.request_progress();
        assert!(!control.is_quiet() && !control.is_stopped());
        control.report_progress(2.0);
        assert!(control.is_quiet());
        assert_eq!(control.progress(), (250, 1000));
        control.stop();
        control.request_progress();
        control.report_progress(8.0);
        assert!(control.is_stopped());
        assert_eq!(control.progress(), (1000, 1000));
    }
}

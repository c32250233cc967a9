//! A computation seen from outside: the wish that it stops, how far it is, and the time that marching took.
//!
//! One watch is shared by whoever waits and by every march that belongs to the computation (see [`super::Kernel::watched_by`]). A march
//! looks at it before each of its steps, so that it ends within microseconds of the wish.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;

/// A handle; its clones are the same watch.
#[derive(Debug, Clone, Default)]
pub struct Watch {
    stopped: Arc<AtomicBool>,
    /// Wall time of all runs, ns.
    marched_ns: Arc<AtomicU64>,
    counts: Arc<Counts>,
}

#[derive(Debug, Default)]
struct Counts {
    done: AtomicU64,
    expected: AtomicU64,
    harvesters: AtomicU64,
}

impl Watch {
    /// The same wish to stop, for a part of the work that counts its own parts.
    #[must_use]
    pub fn apart(&self) -> Self {
        Self { stopped: Arc::clone(&self.stopped), marched_ns: Arc::clone(&self.marched_ns), counts: Arc::default() }
    }

    /// Wishes that the computation stops. It keeps what is finished.
    pub fn stop(&self) {
        self.stopped.store(true, Ordering::Relaxed);
    }

    /// True once somebody wished so.
    #[inline(always)]
    pub fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }

    /// Tells how many more parts of the work there will be.
    pub fn expect(&self, parts: usize) {
        self.counts.expected.fetch_add(parts as u64, Ordering::Relaxed);
    }

    /// Counts a finished part.
    pub fn count(&self) {
        self.counts.done.fetch_add(1, Ordering::Relaxed);
    }

    /// Counts a harvester that was made: one for each trial of an orbit.
    pub fn count_harvester(&self) {
        self.counts.harvesters.fetch_add(1, Ordering::Relaxed);
    }

    /// Harvesters made so far, for work whose end is not known.
    pub fn harvesters(&self) -> u64 {
        self.counts.harvesters.load(Ordering::Relaxed)
    }

    /// Adds the wall time of a run.
    pub fn count_marched(&self, time: Duration) {
        self.marched_ns.fetch_add(time.as_nanos() as u64, Ordering::Relaxed);
    }

    /// Wall time of the marching of all runs together, s, those of parts that count on their own among them.
    pub fn marched_s(&self) -> f64 {
        1e-9 * self.marched_ns.load(Ordering::Relaxed) as f64
    }

    /// Finished and expected parts.
    pub fn progress(&self) -> (u64, u64) {
        (self.counts.done.load(Ordering::Relaxed), self.counts.expected.load(Ordering::Relaxed))
    }
}

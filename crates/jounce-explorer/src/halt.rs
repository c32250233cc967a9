//! Stopping a computation from outside.
//!
//! Every orbit that is tried asks its family for a harvester first. [`Haltable`] stands between the two and refuses once the wish to stop
//! is there, so that a computation ends within one march of a period.

use jounce::orbit::{Harvester, Setting};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The wish that a computation stops; its clones are the same wish.
#[derive(Debug, Clone, Default)]
pub struct Halt(Arc<Wishes>);

#[derive(Debug, Default)]
struct Wishes {
    stop: AtomicBool,
    late: AtomicBool,
}

impl Halt {
    /// Wishes it.
    pub fn stop(&self) {
        self.0.stop.store(true, Ordering::Relaxed);
    }

    /// Wishes it because the time is over.
    pub fn stop_late(&self) {
        if !self.is_stopped() {
            self.0.late.store(true, Ordering::Relaxed);
            self.stop();
        }
    }

    /// True where it was stopped because its time was over.
    pub fn is_late(&self) -> bool {
        self.0.late.load(Ordering::Relaxed)
    }

    /// True once somebody wished it.
    pub fn is_stopped(&self) -> bool {
        self.0.stop.load(Ordering::Relaxed)
    }

    /// The flag itself, for studies that look at one.
    pub fn flag(&self) -> &AtomicBool {
        &self.0.stop
    }
}

/// Why there is no harvester.
#[derive(Debug, thiserror::Error)]
pub enum Halted<E: std::error::Error> {
    /// Somebody wished that the computation stops.
    #[error("the computation was stopped")]
    Stopped,
    /// The harvester itself.
    #[error(transparent)]
    Harvester(E),
}

/// A family of harvesters that can be refused.
#[derive(Debug)]
pub struct Haltable<'h, H> {
    /// The family.
    pub inner: &'h H,
    /// The wish.
    pub halt: Halt,
}

impl<H: Harvester> Harvester for Haltable<'_, H> {
    type Error = Halted<H::Error>;

    fn at(&self, parameter: f64) -> Result<Setting, Self::Error> {
        if self.halt.is_stopped() {
            return Err(Halted::Stopped);
        }
        self.inner.at(parameter).map_err(Halted::Harvester)
    }

    fn difference(&self) -> f64 {
        self.inner.difference()
    }
}

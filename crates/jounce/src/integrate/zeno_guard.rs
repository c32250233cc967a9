//! Rounds of a march that take no time: a few are an impact and what follows from it, very many are a fault of the march, and its end.

use super::error::IntegrationError;
use crate::plant::Plant;

/// Most rounds at one instant.
const MAX_ROUNDS_PER_INSTANT: usize = 10_000;

/// The present instant and how many rounds there were at it.
#[derive(Debug, Default)]
pub(super) struct ZenoGuard {
    time_s: f64,
    count: usize,
}

impl ZenoGuard {
    /// Counts a round.
    ///
    /// # Errors
    /// [`IntegrationError::ImpactsWithoutEnd`].
    pub fn count(&mut self, plant: &Plant, time_s: f64) -> Result<(), IntegrationError> {
        self.count = if time_s == self.time_s {
            self.count + 1
        } else {
            0
        };
        self.time_s = time_s;
        if self.count <= MAX_ROUNDS_PER_INSTANT {
            return Ok(());
        }
        let stops = plant
            .system
            .stops
            .iter()
            .map(|stop| stop.name.clone())
            .collect();
        Err(IntegrationError::ImpactsWithoutEnd {
            time_s,
            stops,
            impacts: MAX_ROUNDS_PER_INSTANT,
        })
    }
}

//! Limit on rounds of the integration without advance in time: a few are an impact and its
//! consequences, very many are a fault that ends the integration.

use crate::error::IntegrationError;
use jounce_model::plant::Plant;

/// Largest number of rounds at one instant.
const MAX_ROUNDS_PER_INSTANT: usize = 10_000;

/// Current instant and the number of rounds at it.
#[derive(Debug, Default)]
pub(crate) struct ZenoGuard {
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

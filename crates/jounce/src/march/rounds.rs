//! Rounds of a march that take no time: a few are an impact and what follows from it, very many are a fault of the march, and its end.

use super::error::MarchError;
use crate::plant::Plant;

/// Most rounds at one instant.
const MOST: usize = 10_000;

/// The present instant and how many rounds there were at it.
#[derive(Debug, Default)]
pub(super) struct Rounds {
    time_s: f64,
    count: usize,
}

impl Rounds {
    /// Counts a round.
    ///
    /// # Errors
    /// [`MarchError::ImpactsWithoutEnd`].
    pub fn count(&mut self, plant: &Plant, time_s: f64) -> Result<(), MarchError> {
        self.count = if time_s == self.time_s { self.count + 1 } else { 0 };
        self.time_s = time_s;
        if self.count <= MOST {
            return Ok(());
        }
        let stops = plant.system.stops.iter().map(|stop| stop.name.clone()).collect();
        Err(MarchError::ImpactsWithoutEnd { time_s, stops, impacts: MOST })
    }
}

//! A signal at the current time of an integration.

use jounce_model::drive::{Travel, WavePiece};
use jounce_model::plant::Signal;
use std::sync::Arc;

/// Signal with its current position.
#[derive(Debug, Clone)]
pub struct SignalCursor {
    pub index: usize,
    pub piece: WavePiece,
    pub travel: Option<Arc<Travel>>,
}

impl SignalCursor {
    /// Creates the cursor of a signal in one of its pieces; `held_a` are the currents that bridges
    /// draw from their storages, 0 where none is given.
    pub fn new(signal: &Signal, travel: Option<Arc<Travel>>, index: usize, held_a: &[f64]) -> Self {
        let held = signal.drawn_from.and_then(|bridge| held_a.get(bridge));
        let mut piece = signal.wave.piece(index);
        if let Some(held) = held {
            (piece.size, piece.end_size) = (*held, *held);
        }
        Self {
            index,
            piece,
            travel,
        }
    }
}

//! A signal at the current time of an integration.

use crate::flow::layout::StateLayout;
use jounce_model::drive::{Travel, WavePiece};
use jounce_model::plant::{Forcing, Signal};
use jounce_simd::F64x8;
use std::sync::Arc;

/// Signal with its current position.
#[derive(Debug, Clone)]
pub struct SignalCursor {
    pub index: usize,
    pub piece: WavePiece,
    pub travel: Option<Arc<Travel>>,
    pub column: Vec<F64x8>,
    pub rest: Vec<F64x8>,
    pub lag: Vec<F64x8>,
    pub local: Vec<F64x8>,
}

impl SignalCursor {
    /// Creates the cursor of a signal at a time; `held_a` are the currents that bridges draw from
    /// their storages, 0 where none is given.
    pub fn at(
        layout: &StateLayout,
        (signal, forcing): (&Signal, &Forcing),
        travel: Option<Arc<Travel>>,
        (time_s, held_a): (f64, &[f64]),
    ) -> Self {
        let index = signal.wave.index_at(time_s);
        let held = signal.drawn_from.and_then(|bridge| held_a.get(bridge));
        let mut piece = signal.wave.piece(index);
        if let Some(held) = held {
            (piece.size, piece.end_size) = (*held, *held);
        }
        let [column, rest, lag, local] =
            [&forcing.column, &forcing.rest, &forcing.lag, &forcing.local].map(|b| layout.pack(b));
        Self {
            index,
            piece,
            travel,
            column,
            rest,
            lag,
            local,
        }
    }
}

//! Breakpoints of the signals: slopes that change, values that jump, and impulses; and the values that
//! the integrator holds.

use super::Excitation;
use crate::kernel::Kernel;
use jounce_simd::F64x8;

impl Excitation {
    /// Passes the breakpoints up to the current time; true where an impulse has changed the
    /// velocities.
    pub fn cross(&mut self, kernel: &Kernel, time_s: f64, y: &mut [F64x8]) -> bool {
        let mut has_impulse = false;
        let mut full_state = self.full_state(&kernel.layout, y);
        self.signal_work.close(
            kernel,
            &self.sizes,
            &full_state,
            time_s,
            self.piece_s(time_s),
        );
        while self.next_s <= time_s {
            for k in 0..self.cursors.len() {
                if self.cursors[k].piece.until_s <= time_s {
                    has_impulse |= self.cross_one(kernel, k, time_s, y);
                }
            }
            self.find_next();
        }
        if has_impulse {
            full_state = self.full_state(&kernel.layout, y);
        }
        self.signal_work.open(&self.sizes, full_state);
        self.aim(time_s);
        has_impulse
    }

    /// Holds a signal at another value from now on; `y` is the state without its forced part.
    pub fn hold(
        &mut self,
        kernel: &Kernel,
        (signal, value): (usize, f64),
        time_s: f64,
        y: &mut [F64x8],
    ) {
        let full_state = self.full_state(&kernel.layout, y);
        self.signal_work
            .close(kernel, &self.sizes, &full_state, time_s, None);
        let (cursor, before) = (&mut self.cursors[signal], self.sizes[signal][0]);
        (cursor.piece.size, cursor.piece.end_size) = (value, value);
        self.sizes[signal][0] = value;
        for (i, y) in y.iter_mut().enumerate() {
            *y = y.add_scaled(before - value, &cursor.rest[i]);
        }
        self.signal_work.open(&self.sizes, full_state);
        self.aim(time_s);
    }

    /// Returns the length of a complete piece of the only signal with breakpoints that ends now, s.
    fn piece_s(&self, time_s: f64) -> Option<f64> {
        let piece = &self.cursors[self.tables.moving?].piece;
        let is_complete = self.signal_work.since_s() == piece.from_s && time_s == piece.until_s;
        is_complete.then_some(piece.length_s)
    }

    fn cross_one(&mut self, kernel: &Kernel, k: usize, time_s: f64, y: &mut [F64x8]) -> bool {
        let cursor = &mut self.cursors[k];
        cursor.index += 1;
        let piece = kernel.plant.system.signals[k].wave.piece(cursor.index);
        cursor.piece = piece;
        let (before, after) = (self.sizes[k], [piece.size_at(time_s), piece.slope]);
        self.sizes[k] = after;
        for (i, y) in y.iter_mut().enumerate() {
            *y = y
                .add_scaled(before[0] - after[0], &cursor.rest[i])
                .add_scaled(before[1] - after[1], &cursor.lag[i]);
        }
        if piece.impulse_s != 0.0 {
            let before = kernel.layout.unpack(y);
            y.iter_mut()
                .zip(&cursor.column)
                .for_each(|(y, b)| *y = y.add_scaled(piece.impulse_s, b));
            let middle: Vec<f64> = before
                .iter()
                .zip(kernel.layout.unpack(y))
                .map(|(a, b)| 0.5 * (a + b))
                .collect();
            let forced = kernel.plant.forced(&self.sizes, 0.0);
            self.signal_work.strike(
                k,
                piece.impulse_s,
                middle.iter().zip(&forced).map(|(y, p)| y + p),
                time_s,
            );
        }
        piece.impulse_s != 0.0
    }
}

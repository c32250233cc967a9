//! Breakpoints of the signals: slopes that change, values that jump, and impulses; and the values that
//! the integrator holds.

use super::Excitation;
use crate::kernel::Kernel;
use jounce_simd::{F64x8, Portable, Simd};

/// Lowest derivative of the modal coordinates that jumps at a breakpoint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Jump {
    /// The third or none: a slope changes.
    Jerk,
    /// A value jumps. The rate of the current of a patch jumps with it.
    Acceleration,
    /// An impulse acts.
    Velocity,
}

impl Excitation {
    /// Passes the breakpoints up to the current time.
    #[inline(always)]
    pub fn cross<W: Simd>(&mut self, w: W, kernel: &Kernel, time_s: f64, y: &mut [F64x8]) -> Jump {
        w.out_of_line(
            #[inline(always)]
            || {
                let piece_s = self.piece_s(time_s);
                self.close(w, time_s, piece_s, y);
                let mut jump = Jump::Jerk;
                while self.next_s <= time_s {
                    for k in 0..self.cursors.len() {
                        if self.cursors[k].piece.until_s <= time_s {
                            jump = jump.max(self.cross_one(w, kernel, k, time_s, y));
                        }
                    }
                    self.find_next();
                }
                self.reopen(w, jump == Jump::Velocity, time_s, y);
                jump
            },
        )
    }

    /// Closes the piece of the signals that ends now, at the state `y` without its forced part.
    #[inline(always)]
    fn close<W: Simd>(&mut self, w: W, time_s: f64, piece_s: Option<f64>, y: &[F64x8]) {
        let mut full = std::mem::take(&mut self.full);
        full.copy_from_slice(y);
        self.add_forced(w, &mut full);
        self.signal_work
            .close(w, &self.sizes, &full, time_s, piece_s);
        self.full = full;
    }

    /// Opens the next piece; the state with its forced part has changed where `has_impulse`.
    #[inline(always)]
    fn reopen<W: Simd>(&mut self, w: W, has_impulse: bool, time_s: f64, y: &[F64x8]) {
        let mut full = std::mem::take(&mut self.full);
        if has_impulse {
            full.copy_from_slice(y);
            self.add_forced(w, &mut full);
        }
        self.signal_work.open(&self.sizes, &full);
        self.full = full;
        self.aim(w, time_s);
    }

    /// Holds a signal at another value from now on; `y` is the state without its forced part.
    pub fn hold(&mut self, (signal, value): (usize, f64), time_s: f64, y: &mut [F64x8]) {
        let w = Portable::new();
        self.close(w, time_s, None, y);
        let (cursor, before) = (&mut self.cursors[signal], self.sizes[signal][0]);
        (cursor.piece.size, cursor.piece.end_size) = (value, value);
        self.sizes[signal][0] = value;
        for (y, rest) in y.iter_mut().zip(&self.tables.signals[signal].rest) {
            *y = y.add_scaled(before - value, rest);
        }
        self.reopen(w, false, time_s, y);
    }

    /// Returns the length of a complete piece of the only signal with breakpoints that ends now, s.
    fn piece_s(&self, time_s: f64) -> Option<f64> {
        let piece = &self.cursors[self.tables.moving?].piece;
        let is_complete = self.signal_work.since_s() == piece.from_s && time_s == piece.until_s;
        is_complete.then_some(piece.length_s)
    }

    #[inline(always)]
    fn cross_one<W: Simd>(
        &mut self,
        w: W,
        kernel: &Kernel,
        k: usize,
        time_s: f64,
        y: &mut [F64x8],
    ) -> Jump {
        let cursor = &mut self.cursors[k];
        cursor.index += 1;
        let piece = kernel.plant.system.signals[k].wave.piece(cursor.index);
        cursor.piece = piece;
        let (before, after) = (self.sizes[k], [piece.size_at(time_s), piece.slope]);
        self.sizes[k] = after;
        let columns = &self.tables.signals[k];
        let changes = [0, 1].map(|i| w.splat(before[i] - after[i]));
        for (y, (rest, lag)) in y.iter_mut().zip(columns.rest.iter().zip(&columns.lag)) {
            let by_value = w.fma(changes[0], w.load(rest), w.load(y));
            *y = w.store(w.fma(changes[1], w.load(lag), by_value));
        }
        if piece.impulse_s != 0.0 {
            let mut middle = y.to_vec();
            for ((y, middle), b) in y.iter_mut().zip(&mut middle).zip(&columns.column) {
                *y = y.add_scaled(piece.impulse_s, b);
                *middle = middle.add_scaled(0.5 * piece.impulse_s, b);
            }
            self.add_forced(w, &mut middle);
            self.signal_work.strike(k, piece.impulse_s, &middle, time_s);
            return Jump::Velocity;
        }
        if after[0] == before[0] {
            Jump::Jerk
        } else {
            Jump::Acceleration
        }
    }
}

//! Drive signal in time, linear between breakpoints.

use std::sync::Arc;

/// Drive signal in time.
#[derive(Debug, Clone, PartialEq)]
pub enum Wave {
    /// Constant for all time.
    Constant(f64),
    /// Linear between samples (first-order hold), 0 before the first and after the last.
    Sampled {
        /// Time of the first sample, s.
        start_s: f64,
        /// Time between samples, s.
        step_s: f64,
        /// The samples, at least two.
        sizes: Arc<[f64]>,
    },
    /// Impulse at one instant.
    Impulse {
        /// Time of the impulse, s.
        time_s: f64,
        /// Integral over time.
        size_s: f64,
    },
}

/// Interval on which a wave is linear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WavePiece {
    /// Start, s; minus infinity for the first.
    pub from_s: f64,
    /// End, s; infinity for the last.
    pub until_s: f64,
    /// Nominal length, s, without the roundoff of the two ends.
    pub length_s: f64,
    /// Value at the start.
    pub size: f64,
    /// Value at the end.
    pub end_size: f64,
    /// Slope, 1/s.
    pub slope: f64,
    /// Impulse at the start.
    pub impulse_s: f64,
}

impl WavePiece {
    const SILENT: Self = Self {
        from_s: f64::NEG_INFINITY,
        until_s: f64::INFINITY,
        length_s: f64::INFINITY,
        size: 0.0,
        end_size: 0.0,
        slope: 0.0,
        impulse_s: 0.0,
    };

    /// Returns the value at a time of the piece.
    #[inline(always)]
    pub fn size_at(&self, time_s: f64) -> f64 {
        if time_s == self.until_s {
            // Exact to the last bit where the next piece begins.
            self.end_size
        } else if self.slope == 0.0 {
            self.size
        } else {
            self.size + self.slope * (time_s - self.from_s)
        }
    }
}

impl Wave {
    /// True for a drive without breakpoints.
    pub fn is_constant(&self) -> bool {
        matches!(self, Wave::Constant(_))
    }

    /// Returns piece number `index`, in order of time.
    pub fn piece(&self, index: usize) -> WavePiece {
        match *self {
            Wave::Constant(size) => WavePiece {
                size,
                end_size: size,
                ..WavePiece::SILENT
            },
            Wave::Impulse { time_s, .. } if index == 0 => WavePiece {
                until_s: time_s,
                ..WavePiece::SILENT
            },
            Wave::Impulse { time_s, size_s } => WavePiece {
                from_s: time_s,
                impulse_s: size_s,
                ..WavePiece::SILENT
            },
            Wave::Sampled {
                start_s,
                step_s,
                ref sizes,
            } => {
                let time_s = |sample: usize| start_s + step_s * sample as f64;
                match index {
                    0 => WavePiece {
                        until_s: start_s,
                        ..WavePiece::SILENT
                    },
                    _ if index >= sizes.len() => WavePiece {
                        from_s: time_s(sizes.len() - 1),
                        ..WavePiece::SILENT
                    },
                    _ => WavePiece {
                        from_s: time_s(index - 1),
                        until_s: time_s(index),
                        length_s: step_s,
                        size: sizes[index - 1],
                        end_size: sizes[index],
                        slope: (sizes[index] - sizes[index - 1]) / step_s,
                        impulse_s: 0.0,
                    },
                }
            }
        }
    }

    /// Returns the number of the piece that begins at or before a time. An impulse at exactly this
    /// time is still ahead.
    pub fn index_at(&self, time_s: f64) -> usize {
        match *self {
            Wave::Constant(_) => 0,
            Wave::Impulse { time_s: when_s, .. } => usize::from(time_s > when_s),
            Wave::Sampled {
                start_s,
                step_s,
                ref sizes,
            } => {
                let near = ((time_s - start_s) / step_s)
                    .floor()
                    .clamp(-1.0, sizes.len() as f64) as i64
                    + 1;
                let mut index = near.clamp(0, sizes.len() as i64) as usize;
                // The quotient is rounded, so the ends of the pieces decide.
                while index > 0 && self.piece(index).from_s > time_s {
                    index -= 1;
                }
                while self.piece(index).until_s <= time_s {
                    index += 1;
                }
                index
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_join_and_are_found_by_time() {
        let wave = Wave::Sampled {
            start_s: 0.3,
            step_s: 0.1,
            sizes: Arc::from([1.0, 3.0, -1.0]),
        };
        assert_eq!(
            [0.0, 0.3, 0.35, 0.5, 9.0].map(|t| wave.index_at(t)),
            [0, 1, 1, 3, 3]
        );
        for index in 0..3 {
            let (piece, next) = (wave.piece(index), wave.piece(index + 1));
            assert_eq!(piece.until_s, next.from_s, "{index}");
            assert_eq!(wave.index_at(piece.until_s), index + 1);
        }
        assert!((wave.piece(2).size_at(0.45) - 1.0).abs() < 1e-15);
        assert_eq!(
            Wave::Impulse {
                time_s: 0.0,
                size_s: 2.0
            }
            .index_at(0.0),
            0
        );
    }
}

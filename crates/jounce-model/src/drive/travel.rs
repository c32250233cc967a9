//! Motion of a base from its acceleration signal.
//!
//! With `a(t) = u + s t` on a piece that begins at the displacement `x` and the velocity `v`,
//!
//! ```text
//! x(t) = x + v t + u t^2 / 2 + s t^3 / 6,   v(t) = v + u t + s t^2 / 2
//! ```
//!
//! exactly. The base is at rest at 0 before the signal begins; an impulse of acceleration is a jump
//! of `v`.

use super::{Wave, WavePiece};

/// Displacement (m) and velocity (m/s) of a base at the start of each piece of its acceleration.
#[derive(Debug, Clone, PartialEq)]
pub struct Travel {
    starts: Vec<[f64; 2]>,
}

impl Travel {
    /// Integrates an acceleration signal, m/s^2.
    pub fn of(wave: &Wave) -> Self {
        let mut starts = vec![[0.0; 2]];
        let mut index = 0;
        while wave.piece(index).until_s.is_finite() {
            let end = if index == 0 {
                [0.0; 2]
            } else {
                advance(
                    &wave.piece(index),
                    starts[index],
                    wave.piece(index).length_s,
                )
            };
            index += 1;
            starts.push([end[0], end[1] + wave.piece(index).impulse_s]);
        }
        Self { starts }
    }

    /// Returns displacement, m, and velocity, m/s, at a time within a piece, which has number
    /// `index` in the wave.
    #[inline(always)]
    pub fn at(&self, index: usize, piece: &WavePiece, time_s: f64) -> [f64; 2] {
        if index == 0 {
            [0.0; 2]
        } else {
            advance(piece, self.starts[index], time_s - piece.from_s)
        }
    }
}

#[inline(always)]
fn advance(piece: &WavePiece, [x, v]: [f64; 2], t: f64) -> [f64; 2] {
    let (u, s) = (piece.size, piece.slope);
    [
        x + t * (v + t * (0.5 * u + s * t / 6.0)),
        v + t * (u + 0.5 * s * t),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    /// Compares a velocity step and linear pieces with their integrals by hand.
    #[test]
    fn a_base_goes_where_its_acceleration_takes_it() {
        let step = Wave::Impulse {
            time_s: 0.5,
            size_s: 2.0,
        };
        assert_eq!(Travel::of(&step).at(1, &step.piece(1), 2.0), [3.0, 2.0]);
        let wave = Wave::Sampled {
            start_s: 1.0,
            step_s: 1.0,
            sizes: Arc::from([0.0, 6.0, -6.0]),
        };
        let travel = Travel::of(&wave);
        let at = |time_s: f64| {
            travel.at(
                wave.index_at(time_s),
                &wave.piece(wave.index_at(time_s)),
                time_s,
            )
        };
        assert_eq!(
            (at(0.7), at(1.5), at(2.0)),
            ([0.0; 2], [0.125, 0.75], [1.0, 3.0])
        );
        // On the second piece a = 6 - 12 t: v = 3 + 6 t - 6 t^2 and x = 1 + 3 t + 3 t^2 - 2 t^3.
        assert_eq!(
            (at(2.5), at(3.0), at(5.0)),
            ([3.0, 4.5], [5.0, 3.0], [11.0, 3.0])
        );
    }
}

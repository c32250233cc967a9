//! Monotone force over penetration through measured points.
//!
//! A piecewise cubic `F(delta)` through `(0, 0)` and the points, with a continuous slope and no
//! overshoot. With the secants `D_i` over the intervals `h_i`, the slope at an inner point is
//!
//! ```text
//! (w_1 + w_2) / d_i = w_1 / D_(i-1) + w_2 / D_i,   w_1 = 2 h_i + h_(i-1),   w_2 = h_i + 2 h_(i-1)
//! ```
//!
//! and 0 where one of the secants is 0. At both ends it is that of the parabola through three
//! points, at most 3 secants; at the first point at least 0, at the last at least half a secant.
//! Past the last point the force continues with the last slope.
//!
//! Source: F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300; monotone by
//! F. N. Fritsch and R. E. Carlson, SIAM J. Numer. Anal. 17 (1980) 238.

/// Monotone piecewise cubic with its energy and its largest slopes.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceCurve {
    /// Pieces in the order of penetration; the last one is the straight continuation.
    pieces: Vec<Piece>,
}

/// One piece: `F = f + s (d + s (c2 + s c3))` with `s = delta - start`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    start_m: f64,
    force_n: f64,
    slope_n_m: f64,
    square: f64,
    cube: f64,
    /// Energy up to the start, J.
    energy_j: f64,
    /// Largest slope up to the end of the piece, N/m.
    steepest_n_m: f64,
}

impl ForceCurve {
    /// Creates the curve through `(0, 0)` and points of ascending penetration (m) and force (N);
    /// `None` if the lists have different lengths or no points, if the penetration does not ascend
    /// from above 0, or if the force descends or does not ascend to the last point.
    pub fn through(penetration_m: &[f64], force_n: &[f64]) -> Option<Self> {
        let with_origin = |values: &[f64]| [&[0.0], values].concat();
        let (at, force) = (with_origin(penetration_m), with_origin(force_n));
        let rises = |values: &[f64]| values.windows(2).all(|pair| pair[1] > pair[0]);
        let last_rises = rises(&force[force.len().saturating_sub(2)..]);
        let never_falls = force.windows(2).all(|pair| pair[1] >= pair[0]);
        if at.len() != force.len() || at.len() < 2 || !rises(&at) || !never_falls || !last_rises {
            return None;
        }
        let lengths: Vec<f64> = at.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let rise = force.windows(2).map(|pair| pair[1] - pair[0]);
        let secants: Vec<f64> = rise
            .zip(&lengths)
            .map(|(rise, length)| rise / length)
            .collect();
        let slopes = slopes(&lengths, &secants);
        let mut pieces = Vec::with_capacity(at.len());
        let (mut energy_j, mut steepest_n_m) = (0.0, 0.0);
        for (i, length) in lengths.iter().enumerate() {
            let (start, end, secant) = (slopes[i], slopes[i + 1], secants[i]);
            let piece = Piece {
                start_m: at[i],
                force_n: force[i],
                slope_n_m: start,
                square: (3.0 * secant - 2.0 * start - end) / length,
                cube: (start + end - 2.0 * secant) / (length * length),
                energy_j,
                steepest_n_m: 0.0,
            };
            steepest_n_m = piece.steepest_n_m(*length, end).max(steepest_n_m);
            energy_j = piece.energy_j(at[i + 1]);
            pieces.push(Piece {
                steepest_n_m,
                ..piece
            });
        }
        pieces.push(Piece {
            start_m: at[lengths.len()],
            force_n: force[lengths.len()],
            slope_n_m: slopes[lengths.len()],
            square: 0.0,
            cube: 0.0,
            energy_j,
            steepest_n_m,
        });
        Some(Self { pieces })
    }

    /// Returns each piece as its start, m, and the coefficients of `s`, `s^2` and `s^3` with which the
    /// force rises over the distance `s` past the start; the last piece has no end.
    pub fn pieces(&self) -> impl Iterator<Item = (f64, [f64; 3])> {
        self.pieces
            .iter()
            .map(|piece| (piece.start_m, [piece.slope_n_m, piece.square, piece.cube]))
    }

    /// Returns the force, N; 0 without penetration.
    #[inline]
    pub fn force_n(&self, penetration_m: f64) -> f64 {
        let Some((piece, s)) = self.piece(penetration_m) else {
            return 0.0;
        };
        piece.force_n + s * (piece.slope_n_m + s * (piece.square + s * piece.cube))
    }

    /// Returns the slope `dF/d delta`, N/m; at zero penetration that from inside.
    #[inline]
    pub fn slope_n_m(&self, penetration_m: f64) -> f64 {
        let Some((piece, s)) = self.piece(penetration_m) else {
            return 0.0;
        };
        piece.slope_n_m + s * (2.0 * piece.square + 3.0 * s * piece.cube)
    }

    /// Returns the stored energy, the integral of the force from 0, J.
    pub fn energy_j(&self, penetration_m: f64) -> f64 {
        self.piece(penetration_m)
            .map_or(0.0, |(piece, _)| piece.energy_j(penetration_m))
    }

    /// Returns an upper bound of the slope up to a penetration, N/m: the largest slope up to the
    /// next point.
    #[inline]
    pub fn steepest_n_m(&self, reach_m: f64) -> f64 {
        self.piece(reach_m)
            .map_or(0.0, |(piece, _)| piece.steepest_n_m)
    }

    /// Returns the penetration under a force, m; 0 without a force.
    pub fn penetration_m(&self, force_n: f64) -> f64 {
        if force_n.is_nan() || force_n <= 0.0 {
            return 0.0;
        }
        let index = self.pieces.partition_point(|piece| piece.force_n < force_n);
        let Some(next) = self.pieces.get(index) else {
            let last = self.pieces[self.pieces.len() - 1];
            return last.start_m + (force_n - last.force_n) / last.slope_n_m;
        };
        let (mut low, mut high) = (self.pieces[index - 1].start_m, next.start_m);
        while low < 0.5 * (low + high) && 0.5 * (low + high) < high {
            let middle = 0.5 * (low + high);
            if self.force_n(middle) < force_n {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }

    /// Returns the piece of a penetration and the distance from its start; `None` outside contact.
    #[inline(always)]
    fn piece(&self, penetration_m: f64) -> Option<(&Piece, f64)> {
        if penetration_m.is_nan() || penetration_m < 0.0 {
            return None;
        }
        let index = self
            .pieces
            .partition_point(|piece| piece.start_m <= penetration_m);
        let piece = &self.pieces[index - 1];
        Some((piece, penetration_m - piece.start_m))
    }
}

impl Piece {
    fn energy_j(&self, penetration_m: f64) -> f64 {
        let s = penetration_m - self.start_m;
        let inner = self.square / 3.0 + 0.25 * s * self.cube;
        self.energy_j + s * (self.force_n + s * (0.5 * self.slope_n_m + s * inner))
    }

    /// Largest slope over the length of the piece: at an end, or where the slope is stationary.
    fn steepest_n_m(&self, length_m: f64, at_end_n_m: f64) -> f64 {
        let ends = self.slope_n_m.max(at_end_n_m);
        let stationary_m = -self.square / (3.0 * self.cube);
        if self.cube < 0.0 && stationary_m > 0.0 && stationary_m < length_m {
            ends.max(self.slope_n_m + self.square * stationary_m)
        } else {
            ends
        }
    }
}

/// Returns the slopes at all points.
fn slopes(lengths: &[f64], secants: &[f64]) -> Vec<f64> {
    let last = secants.len() - 1;
    if last == 0 {
        return vec![secants[0]; 2];
    }
    let parabola = |near: usize, far: usize| {
        let [h, g] = [lengths[near], lengths[far]];
        ((2.0 * h + g) * secants[near] - h * secants[far]) / (h + g)
    };
    let inner = |i: usize| {
        let (before, after) = (secants[i - 1], secants[i]);
        if before == 0.0 || after == 0.0 {
            return 0.0;
        }
        let weights = [
            2.0 * lengths[i] + lengths[i - 1],
            lengths[i] + 2.0 * lengths[i - 1],
        ];
        (weights[0] + weights[1]) / (weights[0] / before + weights[1] / after)
    };
    let first = parabola(0, 1).clamp(0.0, 3.0 * secants[0]);
    let end = parabola(last, last - 1).clamp(0.5 * secants[last], 3.0 * secants[last]);
    let inner = (1..=last).map(inner);
    std::iter::once(first).chain(inner).chain([end]).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    /// Points with a plateau and a steep rise, where a plain spline overshoots.
    const AT: [f64; 6] = [0.5, 1.0, 1.2, 3.0, 3.5, 3.6];
    const FORCE: [f64; 6] = [0.2, 1.0, 1.0, 1.1, 8.0, 8.4];

    #[test]
    fn the_curve_passes_the_points_and_rises_between_them() {
        let curve = ForceCurve::through(&AT, &FORCE).unwrap();
        assert_eq!((curve.force_n(-1.0), curve.force_n(0.0)), (0.0, 0.0));
        for (at, force) in AT.iter().zip(FORCE) {
            assert!((curve.force_n(*at) - force).abs() < 1e-15 * force);
        }
        let mut before = 0.0;
        for k in 0..5000 {
            let force = curve.force_n(f64::from(k) * 1e-3);
            assert!(force >= before - 1e-14, "{k}: {force} {before}");
            before = force;
        }
        let rise = curve.force_n(5.0) - curve.force_n(4.0);
        assert!((rise / curve.slope_n_m(3.6) - 1.0).abs() < 1e-13, "{rise}");
    }

    /// Central differences; the slope has no jump at the points.
    #[test]
    fn energy_force_and_slope_are_consistent() {
        let curve = ForceCurve::through(&AT, &FORCE).unwrap();
        let h = 1e-6;
        for x in [0.1, 0.7, 1.1, 2.0, 3.2, 3.55, 4.0] {
            let slope = (curve.force_n(x + h) - curve.force_n(x - h)) / (2.0 * h);
            let force = (curve.energy_j(x + h) - curve.energy_j(x - h)) / (2.0 * h);
            assert!((slope - curve.slope_n_m(x)).abs() < 1e-7, "{x}");
            assert!((force - curve.force_n(x)).abs() < 1e-7, "{x}");
            let force = curve.force_n(x);
            let pressed = curve.force_n(curve.penetration_m(force));
            assert!((pressed - force).abs() < 1e-12 * force, "{x}");
            for reach in [x, x + 0.5] {
                assert!(curve.slope_n_m(x) <= curve.steepest_n_m(reach));
            }
        }
        for at in AT {
            let jump = curve.slope_n_m(at + 1e-12) - curve.slope_n_m(at - 1e-12);
            assert!(jump.abs() < 1e-8, "{at}: {jump}");
        }
    }

    /// The error falls with the square of the spacing or faster.
    #[test]
    fn a_fine_table_of_a_power_law_converges() {
        let error = |count: u32| {
            let at: Vec<f64> = (1..=count)
                .map(|k| (f64::from(k) / f64::from(count)).powi(2))
                .collect();
            let force: Vec<f64> = at.iter().map(|x| x.powf(1.5)).collect();
            let curve = ForceCurve::through(&at, &force).unwrap();
            let errors = (1..1000).map(|k| {
                let x = f64::from(k) / 1000.0;
                (curve.force_n(x) - x.powf(1.5)).abs()
            });
            errors.fold(0.0, f64::max)
        };
        let [coarse, fine] = [20, 200].map(error);
        assert!(fine < 1e-6 && fine < 0.01 * coarse, "{coarse:e} {fine:e}");
    }

    #[test]
    fn points_that_are_no_force_law_have_no_curve() {
        for (at, force) in [
            (&[][..], &[][..]),
            (&[1.0], &[1.0, 2.0]),
            (&[0.0, 1.0], &[0.0, 1.0]),
            (&[1.0, 1.0], &[1.0, 2.0]),
            (&[1.0, 2.0], &[2.0, 1.0]),
            (&[1.0, 2.0], &[1.0, 1.0]),
            (&[1.0, f64::NAN], &[1.0, 2.0]),
        ] {
            assert_eq!(ForceCurve::through(at, force), None, "{at:?} {force:?}");
        }
    }
}

//! Test function on a step: its cubic Hermite interpolant with an error bound, and the proved
//! crossings of zero.
//!
//! ```text
//! f(t) = H(t) + e(t),   |e(t)| <= 16 E t^2 (1 - t)^2,   |e'(t)| <= 32 E / sqrt(108),   t = 0 .. 1
//! E = |p - q| / 8 + 4 / 27 |p + q - 2 (f1 - f0)|
//! ```
//!
//! `p` and `q` are the slopes at the two ends times the length of the step. The first part of `E`
//! is the height of `H` above its chord. So the function may bend twice as far as the cubic, for
//! example at a kink in the middle of the step. The second part is the distance of `H` from the
//! parabolas that omit one of the slopes.
//!
//! The proof is the same as for a flight without contact: by Bernstein coefficients, on pieces of
//! the step.

/// Largest number of halvings of a step: to pieces of a 256th of the step.
const MAX_HALVINGS: u32 = 8;

/// Largest slope of `16 t^2 (1 - t)^2`: `32 / sqrt(108)`.
const ERROR_SLOPE: f64 = 3.079_201_435_678_004;

/// Test function on a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interpolant {
    /// Values at the two ends.
    pub values: [f64; 2],
    /// Slopes at the two ends, times the length of the step.
    pub slopes: [f64; 2],
}

/// Property of the function that is proved on a piece of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
enum InterpolantPiece {
    /// It has this sign.
    Sign(bool),
    /// It is monotone: rising or falling.
    Monotone(bool),
    /// Neither is proved.
    Open,
}

impl Interpolant {
    /// Returns the error `E` of the cubic.
    pub fn error(&self) -> f64 {
        let ([from, to], [p, q]) = (self.values, self.slopes);
        0.125 * (p - q).abs() + 4.0 / 27.0 * (p + q - 2.0 * (to - from)).abs()
    }

    /// Returns by how much a zero at a fraction `t` of the step contradicts the error bound, divided
    /// by the slope of the chord, as a fraction of the step.
    pub fn contradiction(&self, t: f64) -> f64 {
        let ([from, to], [p, q]) = (self.values, self.slopes);
        let rest = 1.0 - t;
        let cubic = rest * rest * (from * (1.0 + 2.0 * t) + p * t)
            + t * t * (to * (1.0 + 2.0 * rest) - q * rest);
        let bound = 16.0 * self.error() * (t * rest).powi(2);
        (cubic.abs() - bound).max(0.0) / (to - from).abs()
    }

    /// Returns the number of crossings of zero on the step; `None` where it is not proved.
    pub fn crossings(&self) -> Option<usize> {
        self.crossings_with([0.0; 2])
    }

    /// Returns the number of crossings of zero; `None` where it is not proved. The function and its
    /// slope have an additional error anywhere on the step.
    pub fn crossings_with(&self, extra_error: [f64; 2]) -> Option<usize> {
        let [from, to] = self.values;
        if !(from.is_finite()
            && to.is_finite()
            && self
                .slopes
                .iter()
                .chain(&extra_error)
                .all(|number| number.is_finite()))
        {
            return None;
        }
        let ([p, q], error) = (self.slopes, self.error());
        let cubic = [from, from + p / 3.0, to - q / 3.0, to];
        // The same polynomial raised to degree four, where the error has one coefficient.
        let raised = |i: usize| {
            let share = i as f64 / 4.0;
            share * cubic[i.saturating_sub(1)] + (1.0 - share) * cubic[i.min(3)]
        };
        let bound = |sign: f64| {
            std::array::from_fn(|i| {
                let of_cubic = if i == 2 { 16.0 / 6.0 * error } else { 0.0 };
                raised(i) + sign * (of_cubic + extra_error[0])
            })
        };
        let slope = std::array::from_fn(|i| 3.0 * (cubic[i + 1] - cubic[i]));
        let mut pieces = Vec::new();
        examine(
            bound(-1.0),
            bound(1.0),
            (slope, ERROR_SLOPE * error + extra_error[1]),
            MAX_HALVINGS,
            &mut pieces,
        );
        counted(from > 0.0, to > 0.0, &pieces)
    }
}

/// Lists the pieces of a step between a lower and an upper bound.
fn examine(
    low: [f64; 5],
    high: [f64; 5],
    (slope, slope_error): ([f64; 3], f64),
    depth: u32,
    pieces: &mut Vec<InterpolantPiece>,
) {
    // An end of a step may lie on zero.
    let piece = if low[1..4].iter().all(|c| *c > 0.0) && low[0] >= 0.0 && low[4] >= 0.0 {
        InterpolantPiece::Sign(true)
    } else if high[1..4].iter().all(|c| *c < 0.0) && high[0] <= 0.0 && high[4] <= 0.0 {
        InterpolantPiece::Sign(false)
    } else if slope.iter().all(|c| *c > slope_error) {
        InterpolantPiece::Monotone(true)
    } else if slope.iter().all(|c| *c < -slope_error) {
        InterpolantPiece::Monotone(false)
    } else if depth == 0 {
        InterpolantPiece::Open
    } else {
        let ([low_1, low_2], [high_1, high_2], [slope_1, slope_2]) =
            (halves(low), halves(high), halves(slope));
        examine(low_1, high_1, (slope_1, slope_error), depth - 1, pieces);
        return examine(low_2, high_2, (slope_2, slope_error), depth - 1, pieces);
    };
    pieces.push(piece);
}

/// Returns the Bernstein coefficients on the two halves, by de Casteljau.
fn halves<const N: usize>(coefficients: [f64; N]) -> [[f64; N]; 2] {
    let (mut row, mut first, mut second) = (coefficients, coefficients, coefficients);
    for level in 0..N {
        (first[level], second[N - 1 - level]) = (row[0], row[N - 1 - level]);
        for i in 0..N - 1 - level {
            row[i] = 0.5 * (row[i] + row[i + 1]);
        }
    }
    [first, second]
}

/// Counts the crossings on consecutive pieces, between two ends of known signs.
fn counted(first: bool, last: bool, pieces: &[InterpolantPiece]) -> Option<usize> {
    let (mut sign, mut count, mut direction) = (first, 0, None);
    for piece in pieces.iter().chain([&InterpolantPiece::Sign(last)]) {
        match (*piece, direction) {
            (InterpolantPiece::Open, _) => return None,
            (InterpolantPiece::Monotone(rises), None) => direction = Some(rises),
            (InterpolantPiece::Monotone(rises), Some(before)) if rises == before => {}
            // The function turns where its sign is unknown.
            (InterpolantPiece::Monotone(_), Some(_)) => return None,
            (InterpolantPiece::Sign(now), _) => {
                count += usize::from(now != sign);
                (sign, direction) = (now, None);
            }
        }
    }
    Some(count)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(
        value: impl Fn(f64) -> f64,
        slope: impl Fn(f64) -> f64,
        (from, to): (f64, f64),
    ) -> Interpolant {
        Interpolant {
            values: [value(from), value(to)],
            slopes: [slope(from) * (to - from), slope(to) * (to - from)],
        }
    }

    /// `e - (s - 0.4)^2`, two zeros `2 sqrt(e)` apart: found where they are separate, never missed
    /// however near they are.
    #[test]
    fn close_pairs_of_zeros_are_detected() {
        for power in 1..14 {
            let distance = 10.0_f64.powi(-power);
            let pair = of(
                |s| distance - (s - 0.4) * (s - 0.4),
                |s| -2.0 * (s - 0.4),
                (0.0, 1.0),
            );
            assert_ne!(pair.crossings(), Some(0), "{distance:e}");
            let half = of(
                |s| distance - (s - 0.4) * (s - 0.4),
                |s| -2.0 * (s - 0.4),
                (0.5, 1.0),
            );
            assert!(
                half.crossings().is_none_or(|count| count < 2),
                "{distance:e}"
            );
        }
        let far = of(
            |s| -1.0 - (s - 0.4) * (s - 0.4),
            |s| -2.0 * (s - 0.4),
            (0.0, 1.0),
        );
        assert_eq!(far.crossings(), Some(0));
    }

    /// Comparison with 4000 samples of polynomials and waves: proved results hold.
    #[test]
    fn proofs_agree_with_samples() {
        let mut proved = 0;
        for k in 0..2000 {
            let unit = |j: u32| (f64::from(k * 7 + j) * 0.618_033_988_749_895).fract() * 2.0 - 1.0;
            let (bend, wave, phase) = (unit(1), 0.3 * unit(2), 3.0 * unit(3));
            let value =
                |s: f64| unit(4) + unit(5) * s + bend * s * s + wave * (2.0 * s + phase).sin();
            let slope = |s: f64| unit(5) + 2.0 * bend * s + 2.0 * wave * (2.0 * s + phase).cos();
            let Some(count) = of(value, slope, (0.0, 1.0)).crossings() else {
                continue;
            };
            let signs: Vec<bool> = (0..=4000)
                .map(|i| value(f64::from(i) / 4000.0) > 0.0)
                .collect();
            let sampled = signs.windows(2).filter(|two| two[0] != two[1]).count();
            assert_eq!(count, sampled, "case {k}");
            proved += 1;
        }
        assert!(proved > 1000, "{proved}");
    }

    /// The rule on a curve with known events: `prod (s - s_k)` with pairs of zeros down to 1e-7
    /// apart. Every zero lies on its own step or on a part that is not proved, and no such part is
    /// longer than the shortest step.
    #[test]
    fn every_zero_of_a_pair_is_found_or_not_proved() {
        for k in 0..400_u32 {
            let unit = |j: u32| (f64::from(k * 5 + j) * 0.618_033_988_749_895).fract();
            let (first, second, distance) = (
                0.1 + 0.3 * unit(1),
                0.6 + 0.3 * unit(2),
                10.0_f64.powf(-1.0 - 6.0 * unit(3)),
            );
            let zeros = [first, first + distance, second];
            let value = |s: f64| zeros.iter().map(|z| s - z).product::<f64>();
            let slope = |s: f64| {
                (0..3)
                    .map(|k| {
                        (0..3)
                            .filter(|j| *j != k)
                            .map(|j| s - zeros[j])
                            .product::<f64>()
                    })
                    .sum::<f64>()
            };
            let (mut steps, mut zeros_found, mut open) = (vec![(0.0, 1.0)], 0, 0);
            while let Some((from, to)) = steps.pop() {
                let inside = zeros.iter().filter(|z| (from..to).contains(*z)).count();
                match of(value, slope, (from, to)).crossings() {
                    Some(count) if count < 2 => {
                        assert_eq!(count, inside, "{from} {to} {zeros:?}");
                        zeros_found += count;
                    }
                    _ if to - from < 1.5 / 1024.0 => open += inside,
                    _ => steps.extend([(from, 0.5 * (from + to)), (0.5 * (from + to), to)]),
                }
            }
            assert_eq!(zeros_found + open, 3, "{zeros:?}");
            // Zeros a few shortest steps apart are found.
            assert!(distance < 4e-3 || open == 0, "{zeros:?}");
        }
    }

    /// A zero of the function contradicts nothing, a zero elsewhere does.
    #[test]
    fn a_zero_away_from_that_of_the_cubic_is_a_contradiction() {
        let step = of(|s| s * s * s - 0.3, |s| 3.0 * s * s, (0.0, 1.0));
        assert_eq!(step.contradiction(0.3_f64.cbrt()), 0.0);
        let line = of(|s| s - 0.3, |_| 1.0, (0.0, 1.0));
        assert!((line.contradiction(0.5) - 0.2).abs() < 1e-12);
        assert!((line.contradiction(0.1) - 0.2).abs() < 1e-12);
    }

    /// A kink in the middle of the step that dips below zero, with slopes that show it.
    #[test]
    fn a_kink_below_zero_is_not_proved_away() {
        let kink = of(
            |s| (s - 0.5).abs() - 0.01,
            |s| (s - 0.5).signum(),
            (0.0, 1.0),
        );
        assert_ne!(kink.crossings(), Some(0));
        let above = of(
            |s| (s - 0.5).abs() + 0.6,
            |s| (s - 0.5).signum(),
            (0.0, 1.0),
        );
        assert_eq!(above.crossings(), Some(0));
    }
}

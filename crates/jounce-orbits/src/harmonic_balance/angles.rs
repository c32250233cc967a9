//! Sums of harmonics at many angles, eight per SIMD vector.
//!
//! ```text
//! values   d_q = Re sum_n c_n e^(i n x_q)        moments   m_n = sum_q w_q e^(i n x_q)
//! ```
//!
//! Both use powers of `e^(i x)`, whose roundoff grows with `n`: about 1e-14 at a hundred harmonics.

use jounce_linalg::c64;
use jounce_simd::{F64x8, LANES, Simd, Task, widest};

/// Angles by their cosines and sines; the last vector is padded with zero angles.
#[derive(Debug)]
pub struct Angles {
    count: usize,
    cos: Vec<F64x8>,
    sin: Vec<F64x8>,
}

/// Packs numbers into vectors, padded with zeros.
pub fn lanes(values: &[f64]) -> Vec<F64x8> {
    let lane = |values: &[f64]| {
        F64x8(std::array::from_fn(|i| {
            values.get(i).copied().unwrap_or(0.0)
        }))
    };
    values.chunks(LANES).map(lane).collect()
}

impl Angles {
    /// Creates the set from angles in rad.
    pub fn new(angles: &[f64]) -> Self {
        let mut turns = Self {
            count: angles.len(),
            cos: Vec::new(),
            sin: Vec::new(),
        };
        for angles in angles.chunks(LANES) {
            let turn: [(f64, f64); LANES] =
                std::array::from_fn(|i| angles.get(i).copied().unwrap_or(0.0).sin_cos());
            turns.sin.push(F64x8(turn.map(|(sin, _)| sin)));
            turns.cos.push(F64x8(turn.map(|(_, cos)| cos)));
        }
        turns
    }

    /// Returns the values of several sums with equal numbers of harmonics.
    pub fn values<const K: usize>(&self, sums: [&[c64]; K]) -> [Vec<f64>; K] {
        let mut values = widest(HarmonicSums { angles: self, sums });
        values
            .iter_mut()
            .for_each(|values| values.truncate(self.count));
        values
    }

    /// Returns the moments `n = 0..=highest` of weights, one weight for each angle.
    pub fn moments(&self, weights: &[f64], highest: usize) -> Vec<c64> {
        widest(AngleMoments {
            angles: self,
            weights: lanes(weights),
            highest,
        })
    }
}

/// Horner's rule for all sums, eight angles per vector.
struct HarmonicSums<'a, const K: usize> {
    angles: &'a Angles,
    sums: [&'a [c64]; K],
}

impl<const K: usize> Task for HarmonicSums<'_, K> {
    type Output = [Vec<f64>; K];

    #[inline(always)]
    fn run<W: Simd>(self, w: W) -> Self::Output {
        let mut out: [Vec<f64>; K] =
            std::array::from_fn(|_| Vec::with_capacity(LANES * self.angles.cos.len()));
        let most = self.sums.iter().map(|sum| sum.len()).min().unwrap_or(0);
        for (cos, sin) in self.angles.cos.iter().zip(&self.angles.sin) {
            let (cos, sin) = (w.load(cos), w.load(sin));
            let back = w.sub(w.zero(), sin);
            let mut values = [(w.zero(), w.zero()); K];
            for n in (0..most).rev() {
                for (value, sum) in values.iter_mut().zip(&self.sums) {
                    let (re, im) = *value;
                    value.0 = w.fma(re, cos, w.fma(im, back, w.splat(sum[n].re)));
                    value.1 = w.fma(re, sin, w.fma(im, cos, w.splat(sum[n].im)));
                }
            }
            for (out, value) in out.iter_mut().zip(values) {
                out.extend(w.store(value.0).0);
            }
        }
        out
    }
}

/// Powers of all angles, with their moments summed per lane.
struct AngleMoments<'a> {
    angles: &'a Angles,
    weights: Vec<F64x8>,
    highest: usize,
}

impl Task for AngleMoments<'_> {
    type Output = Vec<c64>;

    #[inline(always)]
    fn run<W: Simd>(self, w: W) -> Self::Output {
        let mut sums = vec![(F64x8::ZERO, F64x8::ZERO); self.highest + 1];
        for ((cos, sin), weight) in self
            .angles
            .cos
            .iter()
            .zip(&self.angles.sin)
            .zip(&self.weights)
        {
            let (cos, sin) = (w.load(cos), w.load(sin));
            let back = w.sub(w.zero(), sin);
            let (mut re, mut im) = (w.load(weight), w.zero());
            for sum in &mut sums {
                sum.0 = w.store(w.add(w.load(&sum.0), re));
                sum.1 = w.store(w.add(w.load(&sum.1), im));
                (re, im) = (
                    w.fma(re, cos, w.mul(im, back)),
                    w.fma(re, sin, w.mul(im, cos)),
                );
            }
        }
        let mut moments = Vec::with_capacity(sums.len());
        for (re, im) in &sums {
            moments.push(c64::new(w.sum(w.load(re)), w.sum(w.load(im))));
        }
        moments
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_those_of_cosines_and_sines() {
        let angles: Vec<f64> = (0..19).map(|q| 0.37 * f64::from(q)).collect();
        let turns = Angles::new(&angles);
        // A geometric series: sum_n (r e^(i x))^n.
        let (r, count) = (0.9_f64, 120);
        let series: Vec<c64> = (0..count).map(|n| c64::new(r.powi(n), 0.0)).collect();
        let [values, same] = turns.values([&series, &series]);
        let weights: Vec<f64> = (0..19).map(|q| 1.0 + f64::from(q)).collect();
        let moments = turns.moments(&weights, 60);
        for (angle, value) in angles.iter().zip(&values) {
            let z = c64::cis(*angle) * r;
            let exact = ((c64::new(1.0, 0.0) - z.powi(count)) / (c64::new(1.0, 0.0) - z)).re;
            assert!((value - exact).abs() < 1e-13, "{angle}: {value} {exact}");
        }
        assert!(values == same && values.len() == 19);
        for (n, moment) in moments.iter().enumerate() {
            let exact: c64 = angles
                .iter()
                .zip(&weights)
                .map(|(x, w)| c64::cis(n as f64 * x) * *w)
                .sum();
            assert!((moment - exact).norm() < 1e-11, "{n}: {moment} {exact}");
        }
    }
}

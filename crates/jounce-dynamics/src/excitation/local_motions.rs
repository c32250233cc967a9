//! Cache of forced motions of local blocks over steps of some lengths.

use crate::kernel::Kernel;
use jounce_model::plant::{LOCAL_TERMS, NEGLIGIBLE_TERM};
use jounce_simd::{F64x8, Portable};

/// Number of step lengths in the cache.
const MAX_CACHED_LENGTHS: usize = 16;

/// Motions over steps of some lengths, the latest first.
#[derive(Debug, Clone, Default)]
pub(super) struct LocalMotions(Vec<LocalMotion>);

/// Motion over a step under a unit value and under a unit slope, per signal.
#[derive(Debug, Clone)]
struct LocalMotion {
    length_s: f64,
    by: Vec<[Vec<F64x8>; 2]>,
}

impl LocalMotions {
    /// Returns the motion over a step under a unit value and under a unit slope of each signal,
    /// whose columns are `local`.
    pub fn over<'c>(
        &mut self,
        kernel: &Kernel,
        local: impl Iterator<Item = &'c Vec<F64x8>>,
        length_s: f64,
    ) -> &[[Vec<F64x8>; 2]] {
        if self
            .0
            .first()
            .is_none_or(|motion| motion.length_s != length_s)
        {
            let cached_index = self.0.iter().position(|motion| motion.length_s == length_s);
            let motion = match cached_index {
                Some(index) => self.0.remove(index),
                None => LocalMotion {
                    length_s,
                    by: local
                        .map(|column| forced_motion(kernel, column, length_s))
                        .collect(),
                },
            };
            self.0.truncate(MAX_CACHED_LENGTHS - 1);
            self.0.insert(0, motion);
        }
        &self.0[0].by
    }
}

/// Computes `sum_j A^(j-1) b t^j / j!` and `sum_j A^(j-1) b t^(j+1) / (j+1)!`.
fn forced_motion(kernel: &Kernel, local: &[F64x8], t: f64) -> [Vec<F64x8>; 2] {
    let mut sums = [
        vec![F64x8::ZERO; local.len()],
        vec![F64x8::ZERO; local.len()],
    ];
    let (mut power, mut next) = (local.to_vec(), local.to_vec());
    let mut factor = t;
    for j in 1..=LOCAL_TERMS {
        let later = factor * t / (j + 1) as f64;
        let mut is_complete = true;
        for (i, lane) in power.iter().enumerate() {
            let terms = lane.0.iter().zip(&sums[0][i].0);
            is_complete &= (terms
                .map(|(p, sum)| (factor * p).abs() <= NEGLIGIBLE_TERM * sum.abs()))
            .fold(true, |all, one| all & one);
            sums[0][i] = sums[0][i].add_scaled(factor, lane);
            sums[1][i] = sums[1][i].add_scaled(later, lane);
        }
        if is_complete {
            break;
        }
        kernel.generator.apply(Portable::new(), &power, &mut next);
        std::mem::swap(&mut power, &mut next);
        factor = later;
    }
    sums
}

//! Steps between stamps: each of them, their median and means.

use crate::recording::Series;

/// Maximum deviation from the uniform grid, in steps, of stamps that are only rounded.
pub(super) const MAX_UNIFORM_DEVIATION: f64 = 0.02;

/// Passes each step to `callback` with the index of the sample at its end.
pub(super) fn steps<S: Series>(
    stamps: &S,
    mut callback: impl FnMut(usize, f64),
) -> Result<(), S::Fault> {
    let (mut number, mut previous) = (0, 0.0);
    stamps.each(|t| {
        if number > 0 {
            callback(number, t - previous);
        }
        previous = t;
        number += 1;
    })
}

/// Median of all steps (at least one, none negative): gaps do not affect it. Nonnegative doubles
/// are ordered like their bits, so four counts of sixteen bits each find it without a copy.
pub(super) fn median_step<S: Series>(stamps: &S) -> Result<f64, S::Fault> {
    let (mut rank, mut high) = (stamps.count().saturating_sub(1) / 2, 0);
    for shift in [48u32, 32, 16, 0] {
        let mut counts = vec![0usize; 1 << 16];
        steps(stamps, |_, step| {
            let bits = step.to_bits();
            if bits.checked_shr(shift + 16).unwrap_or(0) == high {
                counts[usize::from((bits >> shift) as u16)] += 1;
            }
        })?;
        let bin = counts.iter().position(|count| {
            let is_in_bin = rank < *count;
            rank -= if is_in_bin { 0 } else { *count };
            is_in_bin
        });
        high = high << 16 | bin.unwrap_or(0) as u64;
    }
    Ok(f64::from_bits(high))
}

/// Number of grid positions that a step spans.
pub(super) fn steps_between(step: f64, near: f64) -> f64 {
    (step / near).round()
}

/// Mean of the steps below a length; NaN if there are none.
pub(super) fn mean_below<S: Series>(stamps: &S, upper: f64) -> Result<f64, S::Fault> {
    let (mut sum, mut count) = (0.0, 0.0);
    steps(stamps, |_, step| {
        if step < upper {
            sum += step;
            count += 1.0;
        }
    })?;
    Ok(sum / count)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    /// Compares with sorting all steps.
    #[test]
    fn the_median_by_counts_is_that_of_sorted_steps() {
        let mut stamps = vec![0.0];
        for k in 0..9001u32 {
            let step = f64::from(k.wrapping_mul(2_654_435_761) % 1000)
                * 1e-3
                * 10f64.powi((k % 7) as i32 - 3);
            stamps.push(stamps[k as usize] + step);
        }
        let mut sorted: Vec<f64> = stamps.windows(2).map(|pair| pair[1] - pair[0]).collect();
        sorted.sort_by(f64::total_cmp);
        let Ok(median) = median_step(&stamps.as_slice());
        assert_eq!(median, sorted[sorted.len() / 2]);
    }
}

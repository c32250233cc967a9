//! Quantised step lengths: `2^-e` and `1.5 2^-e` seconds, numbered from the longest.

use crate::kernel::Kernel;

/// Number of levels over which the length of a step halves.
pub(crate) const LEVELS_PER_OCTAVE: i32 = 2;
/// Coarsest level ...
const COARSEST_LEVEL: i32 = -12 * LEVELS_PER_OCTAVE;
/// ... and finest level.
const FINEST_LEVEL: i32 = 60 * LEVELS_PER_OCTAVE;

impl Kernel {
    /// Returns the length of a level, s.
    #[inline(always)]
    pub fn length_s(level: i32) -> f64 {
        // From exponent and first bit of the mantissa: all levels are far inside the normal
        // numbers.
        f64::from_bits(((2046 - i64::from(level)) as u64) << 51)
    }

    /// Returns the finest level.
    pub const fn finest() -> i32 {
        FINEST_LEVEL
    }

    /// Returns the coarsest level.
    pub const fn coarsest() -> i32 {
        COARSEST_LEVEL
    }

    /// Returns the coarsest level not longer than a time.
    #[inline(always)]
    pub fn level_within(time_s: f64) -> i32 {
        // For a positive normal number.
        (2046 - (time_s.to_bits() >> 51) as i32).clamp(COARSEST_LEVEL, FINEST_LEVEL)
    }

    /// Returns the index of a level in lists of all levels.
    #[inline(always)]
    pub(crate) fn index(level: i32) -> usize {
        (level - COARSEST_LEVEL) as usize
    }

    /// Returns the number of levels.
    pub(crate) const fn count() -> usize {
        (FINEST_LEVEL - COARSEST_LEVEL + 1) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every level is the coarsest one within its own length, and within any time up to the next
    /// level.
    #[test]
    fn levels_lie_by_their_lengths() {
        for level in COARSEST_LEVEL + 1..=FINEST_LEVEL {
            let (length_s, next_s) = (Kernel::length_s(level), Kernel::length_s(level - 1));
            let ratio = if level % LEVELS_PER_OCTAVE == 0 {
                1.5
            } else {
                4.0 / 3.0
            };
            assert!(
                (next_s / length_s - ratio).abs() < 1e-15,
                "{level}: {}",
                next_s / length_s
            );
            assert!(
                Kernel::level_within(length_s) == level
                    && Kernel::level_within(length_s.midpoint(next_s)) == level,
                "{level}"
            );
        }
        assert!(Kernel::length_s(0) == 1.0 && Kernel::length_s(LEVELS_PER_OCTAVE) == 0.5);
    }
}

//! Lengths of steps: `2^-e` and `1.5 2^-e` seconds, numbered from the longest on.

use super::kernel::Kernel;

/// Levels on which the length of a step falls by half.
pub(super) const LEVELS_PER_OCTAVE: i32 = 2;
/// Levels run from here ...
const COARSEST_LEVEL: i32 = -12 * LEVELS_PER_OCTAVE;
/// ... to here.
const FINEST_LEVEL: i32 = 60 * LEVELS_PER_OCTAVE;

impl Kernel {
    /// Length of a level, s.
    #[inline(always)]
    pub fn length_s(level: i32) -> f64 {
        // By exponent and first bit of the mantissa: levels lie far inside the normal numbers.
        f64::from_bits(((2046 - i64::from(level)) as u64) << 51)
    }

    /// Finest level there is.
    pub const fn finest() -> i32 {
        FINEST_LEVEL
    }

    /// Coarsest level there is.
    pub const fn coarsest() -> i32 {
        COARSEST_LEVEL
    }

    /// Coarsest level not longer than a time.
    #[inline(always)]
    pub fn level_within(time_s: f64) -> i32 {
        // Of a positive normal number.
        (2046 - (time_s.to_bits() >> 51) as i32).clamp(COARSEST_LEVEL, FINEST_LEVEL)
    }

    /// Index of a level in lists of all levels.
    #[inline(always)]
    pub(super) fn index(level: i32) -> usize {
        (level - COARSEST_LEVEL) as usize
    }

    /// Number of levels.
    pub(super) const fn count() -> usize {
        (FINEST_LEVEL - COARSEST_LEVEL + 1) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every level is the coarsest one within its own length, and within anything up to the next.
    #[test]
    fn levels_lie_by_their_lengths() {
        for level in COARSEST_LEVEL + 1..=FINEST_LEVEL {
            let (own_s, next_s) = (Kernel::length_s(level), Kernel::length_s(level - 1));
            let ratio = if level % LEVELS_PER_OCTAVE == 0 {
                1.5
            } else {
                4.0 / 3.0
            };
            assert!(
                (next_s / own_s - ratio).abs() < 1e-15,
                "{level}: {}",
                next_s / own_s
            );
            assert!(
                Kernel::level_within(own_s) == level
                    && Kernel::level_within(own_s.midpoint(next_s)) == level,
                "{level}"
            );
        }
        assert!(Kernel::length_s(0) == 1.0 && Kernel::length_s(LEVELS_PER_OCTAVE) == 0.5);
    }
}

//! Expected power of a cloud with its 95 % interval.
//!
//! Of `n` starts, `n_i` reached the attractor of power `P_i`. The interval contains every `E = sum
//! p_i P_i` of fractions `p` that the score test of the counts does not reject:
//!
//! ```text
//! sum (n_i - n p_i)^2 / (n p_i) <= z^2,   that is   sum q_i^2 / p_i <= 1 + z^2 / n,   q_i = n_i / n
//! ```
//!
//! At its ends `p_i` is proportional to `q_i / sqrt(|l - P_i|)`; `l`, outside the range of all
//! powers, follows from the bound. For two attractors this is Wilson's interval. An attractor that
//! no start reached may still have a fraction: the lower end allows one of zero power. The upper
//! end covers only the attractors found; it does not bound the power of others.
//!
//! Source: E. B. Wilson, J. Am. Stat. Assoc. 22 (1927) 209; the Lagrange multipliers for more than
//! two fractions are our derivation.

use jounce_signal::NORMAL_95;

/// Largest number of bisections of the logarithm of the distance from a power to `l`.
const MAX_HALVINGS: usize = 200;

/// Returns the expected power and the ends of its 95 % interval, W, from the number of starts and
/// the power of each attractor.
pub fn expected_power_w(observed: &[(usize, f64)]) -> [f64; 3] {
    let of: usize = observed.iter().map(|(count, _)| count).sum();
    if of == 0 {
        return [0.0; 3];
    }
    let shares: Vec<(f64, f64)> = observed
        .iter()
        .map(|(count, power)| (*count as f64 / of as f64, *power))
        .collect();
    let bound = 1.0 + NORMAL_95.powi(2) / of as f64;
    let expected = shares.iter().map(|(q, power)| q * power).sum();
    [expected, lowest(&shares, bound), highest(&shares, bound)]
}

fn lowest(shares: &[(f64, f64)], bound: f64) -> f64 {
    let least = shares
        .iter()
        .map(|(_, power)| *power)
        .fold(f64::INFINITY, f64::min);
    let roots: f64 = shares.iter().map(|(q, power)| q * power.sqrt()).sum();
    if least > 0.0
        && roots
            * shares
                .iter()
                .map(|(q, power)| q / power.sqrt())
                .sum::<f64>()
            < bound
    {
        return roots * roots / bound;
    }
    end(
        &shares
            .iter()
            .map(|(q, power)| (*q, power - least))
            .collect::<Vec<_>>(),
        bound,
    )
    .map_or(least, |above| least + above)
}

fn highest(shares: &[(f64, f64)], bound: f64) -> f64 {
    let most = shares
        .iter()
        .map(|(_, power)| *power)
        .fold(f64::NEG_INFINITY, f64::max);
    end(
        &shares
            .iter()
            .map(|(q, power)| (*q, most - power))
            .collect::<Vec<_>>(),
        bound,
    )
    .map_or(most, |below| most - below)
}

/// Smallest mean distance of the powers from an end; `None` where all powers are equal.
fn end(shares: &[(f64, f64)], bound: f64) -> Option<f64> {
    let widest = shares
        .iter()
        .map(|(_, distance)| *distance)
        .fold(0.0, f64::max);
    if widest == 0.0 {
        return None;
    }
    let sums = |beyond: f64| {
        let [above, below] = [0.5, -0.5].map(|power| {
            shares
                .iter()
                .map(|(q, distance)| q * (distance + beyond).powf(power))
                .sum::<f64>()
        });
        (above * below, below)
    };
    // The product of both sums falls from infinity to one as `l` moves away.
    let (mut low, mut high) = (-600.0, 60.0);
    for _ in 0..MAX_HALVINGS {
        let middle = 0.5 * (low + high);
        if sums(widest * f64::exp2(middle)).0 > bound {
            low = middle
        } else {
            high = middle
        }
    }
    let beyond = widest * f64::exp2(0.5 * (low + high));
    let (_, below) = sums(beyond);
    Some(
        shares
            .iter()
            .map(|(q, distance)| q * distance / (distance + beyond).sqrt())
            .sum::<f64>()
            / below,
    )
}

#[cfg(test)]
mod tests {
    use super::super::basin_fraction::wilson;
    use super::*;

    #[test]
    fn two_outcomes_give_the_wilson_interval() {
        for (hits, misses) in [(1, 9), (7, 13), (60, 140), (19, 1)] {
            let [expected, low, high] = expected_power_w(&[(hits, 1.0), (misses, 0.0)]);
            let share = wilson(hits, hits + misses);
            for (computed, exact) in [
                (expected, share.fraction),
                (low, share.low),
                (high, share.high),
            ] {
                assert!(
                    (computed - exact).abs() < 1e-12,
                    "{hits} of {}: {computed} {exact}",
                    hits + misses
                );
            }
        }
    }

    #[test]
    fn one_outcome_allows_an_unobserved_outcome_of_zero_power() {
        let [expected, low, high] = expected_power_w(&[(20, 3.0)]);
        assert!(
            expected == 3.0 && high == 3.0 && (low - 3.0 * wilson(20, 20).low).abs() < 1e-12,
            "{low}"
        );
        assert_eq!(expected_power_w(&[]), [0.0; 3]);
        assert_eq!(expected_power_w(&[(5, 0.0)]), [0.0; 3]);
    }

    /// Evaluates all fractions on a fine lattice that the counts do not reject.
    #[test]
    fn three_outcomes_give_the_extreme_of_all_accepted_fractions() {
        let observed = [(30_usize, 1.0), (10, 4.0), (2, 9.0)];
        let [_, low, high] = expected_power_w(&observed);
        let (of, steps) = (42.0, 1500_u32);
        let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
        for i in 1..steps {
            for j in 1..steps - i {
                let shares = [i, j, steps - i - j].map(|part| f64::from(part) / f64::from(steps));
                let score: f64 = observed
                    .iter()
                    .zip(&shares)
                    .map(|((n, _), p)| (*n as f64 - of * p).powi(2) / (of * p))
                    .sum();
                if score <= NORMAL_95.powi(2) {
                    let mean: f64 = observed
                        .iter()
                        .zip(&shares)
                        .map(|((_, power), p)| p * power)
                        .sum();
                    (least, most) = (least.min(mean), most.max(mean));
                }
            }
        }
        assert!(
            (low..low + 0.01).contains(&least) && (high - 0.01..high).contains(&most),
            "{low} {least} {high} {most}"
        );
    }
}

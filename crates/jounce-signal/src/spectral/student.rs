//! Student's distribution.

/// Panels of Simpson's rule.
const SIMPSON_PANELS: usize = 400;
/// Standard deviations beyond which the normal distribution is negligible.
const MAX_NORMAL_DEVIATIONS: f64 = 9.0;

/// Quantile of Student's distribution for a two-sided interval of 95 %, for 1 or more degrees of
/// freedom, not necessarily integer: with `t = sqrt(n) tan(a)` the distribution of `a` is
/// `cos(a)^(n - 1)`.
pub fn student_95(freedom: f64) -> f64 {
    let end = (MAX_NORMAL_DEVIATIONS / freedom.sqrt()).min(std::f64::consts::FRAC_PI_2);
    let density = |a: f64| {
        if freedom == 1.0 {
            1.0
        } else {
            a.cos().max(0.0).powf(freedom - 1.0)
        }
    };
    let integral = |to: f64| {
        let step = to / SIMPSON_PANELS as f64;
        let weight = |k: usize| {
            if k == 0 || k == SIMPSON_PANELS {
                1.0
            } else {
                2.0 + 2.0 * (k % 2) as f64
            }
        };
        (0..=SIMPSON_PANELS)
            .map(|k| weight(k) * density(k as f64 * step))
            .sum::<f64>()
            * step
            / 3.0
    };
    let target = 0.95 * integral(end);
    let (mut low, mut high) = (0.0, end);
    for _ in 0..60 {
        let centre = (low + high) / 2.0;
        if integral(centre) < target {
            low = centre
        } else {
            high = centre
        }
    }
    freedom.sqrt() * low.tan()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Table 26.10 of Abramowitz and Stegun, and `tan(0.475 pi)`; equal to all given digits.
    #[test]
    fn quantiles_are_those_of_the_table() {
        let table = [
            (1.0, 12.706_204_7),
            (2.0, 4.302_652_7),
            (3.0, 3.182_446_3),
            (5.0, 2.570_581_8),
            (15.0, 2.131_449_5),
            (1e6, 1.959_966_4),
        ];
        for (freedom, expected) in table {
            let relative_error = student_95(freedom) / expected - 1.0;
            eprintln!("{freedom}: {relative_error:.1e}");
            assert!(relative_error.abs() < 3e-7, "{freedom} {relative_error}");
        }
        assert!(
            (student_95(2.5) - 3.558).abs() < 0.3
                && student_95(2.5) < student_95(2.0)
                && student_95(2.5) > student_95(3.0)
        );
    }
}

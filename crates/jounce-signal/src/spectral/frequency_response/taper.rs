//! Windows of impact tests, which retain the hit and make the response decay within the record.

/// Returns a force window: 1 over the hit, then a cosine slope to 0, which removes noise after the
/// hit.
///
/// `end` is the last sample of the hit and `slope` the length of the slope in samples.
pub fn force_window(samples: usize, end: usize, slope: usize) -> Vec<f64> {
    let weight = |k: usize| {
        if k <= end {
            1.0
        } else if k < end + slope {
            0.5 + 0.5 * (std::f64::consts::PI * (k - end) as f64 / slope as f64).cos()
        } else {
            0.0
        }
    };
    (0..samples).map(weight).collect()
}

/// Returns an exponential window `exp(-a k / r)` with final value `end_ratio`, and the damping `a`
/// (1/s) that it adds to every mode: a mode at `w` rad/s identified from windowed records has a
/// damping ratio too high by `a / w`.
pub fn exponential_window(samples: usize, rate_hz: f64, end_ratio: f64) -> (Vec<f64>, f64) {
    let decay_per_s = -end_ratio.ln() * rate_hz / (samples.max(2) - 1) as f64;
    (
        (0..samples)
            .map(|k| (-decay_per_s * k as f64 / rate_hz).exp())
            .collect(),
        decay_per_s,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_have_their_ends() {
        let force = force_window(100, 20, 10);
        assert!(
            force[20] == 1.0
                && (force[25] - 0.5).abs() < 1e-15
                && force[30] == 0.0
                && force[99] == 0.0
        );
        let (decay, rate) = exponential_window(101, 100.0, 0.01);
        assert!((decay[100] - 0.01).abs() < 1e-15 && (rate - 100f64.ln()).abs() < 1e-12);
    }
}

//! Gaussian noise of a flat power spectral density in a band.
//!
//! ```text
//! u(t) = sum_j sqrt(G df) (a_j cos(2 pi f_j t) + b_j sin(2 pi f_j t)),   f_j = j df,   low <= f_j <= high
//! ```
//!
//! with independent normal `a_j`, `b_j` and the one-sided density `G` (unit^2/Hz), so the mean
//! square is `G (high - low)`. The period `1 / df` is no shorter than the run. The samples are
//! divided by the `sinc^2` of linear interpolation.
//!
//! Source: M. Shinozuka, C.-M. Jan, J. Sound Vib. 25 (1972) 111, with random amplitudes instead of
//! random phases.

use super::{Wave, hold};
use jounce_fft::Complex;
use jounce_signal::RandomStream;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// Noise in a frequency band.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoiseBand {
    /// One-sided power spectral density, unit^2/Hz.
    pub density: f64,
    /// Lower end, Hz.
    pub low_hz: f64,
    /// Upper end, Hz.
    pub high_hz: f64,
    /// Samples per second, more than twice the upper end.
    pub sample_rate_hz: f64,
}

/// Number of samples from which a realisation, at a tenth of a second or more, can be cancelled.
const INTERRUPTIBLE_SAMPLES: usize = 1 << 20;

/// Time between two checks for cancellation.
const STOP_CHECK_INTERVAL: Duration = Duration::from_millis(5);

/// Returns a realisation of at least `duration_s`, the same for the same seed; zeros if
/// `is_stopped` returns true meanwhile.
pub fn noise(band: &NoiseBand, duration_s: f64, seed: u64, is_stopped: &dyn Fn() -> bool) -> Wave {
    let (band, step_s) = (*band, 1.0 / band.sample_rate_hz);
    let count = smooth_length((duration_s * band.sample_rate_hz).ceil() as usize + 2);
    let sizes = match count {
        _ if is_stopped() => vec![0.0; 2],
        INTERRUPTIBLE_SAMPLES.. => unless_stopped(move || realised(&band, count, seed), is_stopped),
        _ => realised(&band, count, seed),
    };
    Wave::Sampled {
        start_s: 0.0,
        step_s,
        sizes: sizes.into(),
    }
}

/// Runs a computation that does not check for cancellation; returns zeros, and discards its result,
/// once `is_stopped` returns true.
fn unless_stopped(
    compute: impl FnOnce() -> Vec<f64> + Send + 'static,
    is_stopped: &dyn Fn() -> bool,
) -> Vec<f64> {
    let (sender, receiver) = channel();
    std::thread::spawn(move || sender.send(compute()));
    loop {
        match receiver.recv_timeout(STOP_CHECK_INTERVAL) {
            Ok(sizes) => return sizes,
            Err(RecvTimeoutError::Timeout) if !is_stopped() => {}
            Err(_) => return vec![0.0; 2],
        }
    }
}

/// Returns one period of `count` samples.
fn realised(band: &NoiseBand, count: usize, seed: u64) -> Vec<f64> {
    let step_s = 1.0 / band.sample_rate_hz;
    let df = band.sample_rate_hz / count as f64;
    let inverse = jounce_fft::inverse(count);
    let mut lines = inverse.make_input_vec();
    let mut stream = RandomStream::new(seed, 0);
    let first = (band.low_hz / df).ceil().max(1.0) as usize;
    let last = ((band.high_hz / df).floor() as usize).min(lines.len() - 2);
    for (j, line) in lines.iter_mut().enumerate().take(last + 1).skip(first) {
        let [a, b] = stream.normal_pair();
        // The transform adds each line and its conjugate, so this is half of a - i b.
        let size = 0.5 * (band.density * df).sqrt() / hold(j as f64 * df, step_s);
        *line = Complex::new(size * a, -size * b);
    }
    let mut sizes = inverse.make_output_vec();
    // Lengths fit by construction, and the end lines are real.
    if inverse.process(&mut lines, &mut sizes).is_err() {
        sizes.fill(0.0);
    }
    sizes
}

/// Returns the next number without prime factors above 5; transforms of such lengths are fast.
fn smooth_length(least: usize) -> usize {
    let is_smooth = |mut n: usize| {
        for prime in [2, 3, 5] {
            while n.is_multiple_of(prime) {
                n /= prime;
            }
        }
        n == 1
    };
    (least.max(16).next_multiple_of(2)..)
        .step_by(2)
        .find(|n| is_smooth(*n))
        .unwrap_or(least)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_1_SQRT_2;

    /// The mean square is `G (high - low)`; over 4000 lines its relative deviation is
    /// `sqrt(2 / 8000)`, 1.6 %.
    #[test]
    fn mean_square_is_density_times_band() {
        let band = NoiseBand {
            density: 0.02,
            low_hz: 50.0,
            high_hz: 250.0,
            sample_rate_hz: 2500.0,
        };
        let Wave::Sampled { sizes, .. } = noise(&band, 20.0, 11, &|| false) else {
            panic!("not sampled")
        };
        // Linear interpolation multiplies each frequency by sinc^2; divide by it at the edges of
        // the band.
        let square = sizes.iter().map(|u| u * u).sum::<f64>() / sizes.len() as f64;
        let expected = 0.02
            * (0..=200)
                .map(|k| hold(50.0 + f64::from(k), 4e-4).powi(-2))
                .sum::<f64>()
            * 200.0
            / 201.0;
        assert!(
            (square / expected - 1.0).abs() < 3.0 * FRAC_1_SQRT_2 * 0.0224,
            "{square} {expected}"
        );
        let Wave::Sampled { sizes: other, .. } = noise(&band, 20.0, 12, &|| false) else {
            panic!("not sampled")
        };
        let cross = sizes
            .iter()
            .zip(other.iter())
            .map(|(a, b)| a * b)
            .sum::<f64>()
            / sizes.len() as f64;
        assert!(cross.abs() < 0.05 * square, "{cross}");
    }

    /// Cancels at the first check and later; without cancellation all samples equal those of a
    /// separate thread.
    #[test]
    fn a_realisation_that_nobody_waits_for_is_silence() {
        let band = NoiseBand {
            density: 0.02,
            low_hz: 50.0,
            high_hz: 250.0,
            sample_rate_hz: 2500.0,
        };
        for polls in [0_usize, 1] {
            let remaining = std::cell::Cell::new(polls);
            let is_stopped = || remaining.replace(remaining.get().saturating_sub(1)) == 0;
            let Wave::Sampled { sizes, .. } = noise(&band, 4000.0, 11, &is_stopped) else {
                panic!("not sampled")
            };
            assert_eq!(*sizes, [0.0; 2], "{polls}");
        }
        let Wave::Sampled { sizes, .. } = noise(&band, 500.0, 11, &|| false) else {
            panic!("not sampled")
        };
        assert!(sizes.len() >= 1_250_000 && *sizes == *realised(&band, sizes.len(), 11));
    }

    #[test]
    fn lengths_have_small_factors() {
        assert_eq!([17, 1000, 60_002].map(smooth_length), [18, 1000, 60_750]);
    }
}

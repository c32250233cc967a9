//! Prescribed displacements of a base, converted to acceleration.
//!
//! A displacement signal has velocity jumps, impulses of acceleration, at its start and end;
//! between them it is smooth. The two impulses bring the base, moved by the samples of the
//! acceleration, to its final position and to rest there. The error of the samples in the double
//! integral then causes no drift.

use super::{Chirp, Travel, Wave, half_sine};
use jounce_spec::DriveSignal;
use std::f64::consts::PI;

/// Returns the accelerations, m/s^2, for a displacement signal in m. After a chirp the base stays in
/// place. Empty for a sinusoid, and for velocity steps, noise and recordings, which are not
/// displacement signals.
pub fn displaced(signal: &DriveSignal) -> Vec<Wave> {
    match *signal {
        DriveSignal::HalfSine {
            amplitude,
            start_s,
            duration_s,
        } => {
            let peak_m_s2 = -amplitude * (PI / duration_s).powi(2);
            stop_at_position(
                0.0,
                half_sine(peak_m_s2, start_s, duration_s),
                [start_s, duration_s],
            )
        }
        DriveSignal::Chirp {
            amplitude,
            from_hz,
            to_hz,
            sweep,
            phase_rad,
            start_s,
            duration_s,
        } => {
            let chirp = Chirp {
                amplitude,
                from_hz,
                to_hz,
                sweep,
                phase_rad,
                start_s,
                duration_s,
            };
            let end_m = chirp.size(duration_s) - chirp.size(0.0);
            stop_at_position(end_m, chirp.acceleration(), [start_s, duration_s])
        }
        DriveSignal::Sine { .. }
        | DriveSignal::VelocityStep { .. }
        | DriveSignal::Noise { .. }
        | DriveSignal::Recording { .. } => Vec::new(),
    }
}

/// Adds velocity jumps, m/s, at the start and end of a smooth part, so the base ends at a position,
/// m, at rest.
fn stop_at_position(end_m: f64, smooth: Wave, [start_s, duration_s]: [f64; 2]) -> Vec<Wave> {
    let end_s = start_s + duration_s;
    let index = smooth.index_at(end_s);
    let [position_m, speed_m_s] = Travel::of(&smooth).at(index, &smooth.piece(index), end_s);
    let first_m_s = (end_m - position_m) / duration_s;
    let jump = |time_s: f64, size_s: f64| Wave::Impulse { time_s, size_s };
    vec![
        jump(start_s, first_m_s),
        smooth,
        jump(end_s, -(speed_m_s + first_m_s)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use jounce_spec::FrequencySweep;

    fn position_m(waves: &[Wave], time_s: f64) -> f64 {
        let of = |wave: &Wave| {
            Travel::of(wave).at(
                wave.index_at(time_s),
                &wave.piece(wave.index_at(time_s)),
                time_s,
            )[0]
        };
        waves.iter().map(of).sum()
    }

    /// Compares the double integral with the signal, also long after its end.
    #[test]
    fn the_base_is_where_its_course_says() {
        let (amplitude, start_s, duration_s) = (2e-3, 0.1, 0.8);
        let half = DriveSignal::HalfSine {
            amplitude,
            start_s,
            duration_s,
        };
        let waves = displaced(&half);
        for time_s in [0.05, 0.1, 0.3, 0.511, 0.9, 5.0] {
            let t: f64 = time_s - start_s;
            let exact = if (0.0..=duration_s).contains(&t) {
                amplitude * (PI * t / duration_s).sin()
            } else {
                0.0
            };
            let error = (position_m(&waves, time_s) - exact).abs();
            assert!(
                error < 1e-11 * amplitude,
                "half-sine at {time_s}: {error:e}"
            );
        }
        for sweep in [FrequencySweep::Linear, FrequencySweep::Logarithmic] {
            let (from_hz, to_hz, duration_s) = (5.0, 60.0, 20.0);
            let chirp = Chirp {
                amplitude,
                from_hz,
                to_hz,
                sweep,
                phase_rad: 0.0,
                start_s,
                duration_s,
            };
            let waves = displaced(&DriveSignal::Chirp {
                amplitude,
                from_hz,
                to_hz,
                sweep,
                phase_rad: 0.0,
                start_s,
                duration_s,
            });
            for k in 0..200 {
                let time_s = 0.11 * f64::from(k) + 0.05;
                let error = (position_m(&waves, time_s)
                    - chirp.size((time_s - start_s).clamp(0.0, duration_s)))
                .abs();
                assert!(error < 1e-8 * amplitude, "{sweep:?} at {time_s}: {error:e}");
            }
        }
    }
}

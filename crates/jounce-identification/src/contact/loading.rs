//! Force over penetration from the loading branch of a pulse, without a law.
//!
//! A body of mass `m` strikes a body at rest with the speed `v`. While it is pressed in,
//!
//! ```text
//! d'(t) = v - (1/m) (integral of F from 0 to t),   d(t) = integral of d' from 0 to t
//! ```
//!
//! until `d'` is 0. Between samples the force is linear, so both integrals are exact. The pairs
//! `(d, F)` are the table. Where noise lets the force fall, the points are joined to their mean
//! (pool adjacent violators), so that the force ascends.
//!
//! Limits: the table includes the force of damping, and its work is `m v^2 / 2`. It does not describe
//! the unloading, and so no dissipation. An error `e` of the start of the pulse shifts
//! the penetrations by `v e`.
//!
//! Source: W. Goldsmith, Impact (1960), chapter 4 (equation of motion); R. Barlow et al.,
//! Statistical inference under order restrictions (1972), chapter 1 (pooling).

use super::ContactError;
use jounce_signal::Samples;
use jounce_signal::spectral::Hit;
use serde::Serialize;

/// Largest number of points of a table.
const MAX_POINTS: usize = 100;
/// Difference from 0 and 1 that the restitution from impulse and momentum may have due to the
/// measurement.
const MAX_RESTITUTION_ERROR: f64 = 0.1;

/// Force over penetration of one pulse.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoadingCurve {
    /// Penetrations, m, ascending from above 0.
    pub penetration_m: Vec<f64>,
    /// Forces, N, ascending from above 0.
    pub force_n: Vec<f64>,
    /// Speed of the striking body, m/s.
    pub speed_m_s: f64,
}

/// Mean of neighbouring samples.
#[derive(Debug, Clone, Copy)]
struct Pool {
    penetration_m: f64,
    force_n: f64,
    count: f64,
}

/// Returns the table of a pulse that begins at `start_s`, of a body of `mass_kg` that strikes a body
/// at rest with `speed_m_s`.
///
/// # Errors
/// [`ContactError::Mass`] for a mass that is not positive; [`ContactError::Momentum`] for a mass and
/// a speed that do not match the impulse; [`ContactError::NoLoading`] for a force that does not
/// ascend.
pub fn loading_curve(
    force: &Samples<'_>,
    hit: &Hit,
    start_s: f64,
    mass_kg: f64,
    speed_m_s: f64,
) -> Result<LoadingCurve, ContactError> {
    if !(mass_kg > 0.0 && mass_kg.is_finite()) {
        return Err(ContactError::Mass { mass_kg });
    }
    let restitution = hit.impulse_n_s / (mass_kg * speed_m_s) - 1.0;
    if !(-MAX_RESTITUTION_ERROR..=1.0 + MAX_RESTITUTION_ERROR).contains(&restitution) {
        return Err(ContactError::Momentum {
            impulse_n_s: hit.impulse_n_s,
            momentum_n_s: mass_kg * speed_m_s,
        });
    }
    let loading = loading(force, hit, start_s, mass_kg, speed_m_s);
    let pools = ascending(&grouped(&loading));
    if pools.is_empty() {
        return Err(ContactError::NoLoading);
    }
    Ok(LoadingCurve {
        penetration_m: pools.iter().map(|pool| pool.penetration_m).collect(),
        force_n: pools.iter().map(|pool| pool.force_n).collect(),
        speed_m_s,
    })
}

/// Returns penetration and force at each sample until the body stops.
fn loading(
    force: &Samples<'_>,
    hit: &Hit,
    start_s: f64,
    mass_kg: f64,
    speed_m_s: f64,
) -> Vec<(f64, f64)> {
    let rate_hz = force.rate_hz();
    // The pulse begins before its first sample above the threshold.
    let start = start_s.min(hit.start as f64 / rate_hz).max(0.0) * rate_hz;
    let first = start.floor() as usize + 1;
    let mut step_s = (first as f64 - start) / rate_hz;
    let (mut penetration_m, mut speed, mut before_n) = (0.0, speed_m_s, 0.0);
    let mut points = Vec::new();
    for force_n in &force.values()[first.min(hit.end)..hit.end] {
        penetration_m += step_s * (speed - step_s / mass_kg * (before_n / 3.0 + force_n / 6.0));
        speed -= step_s / mass_kg * 0.5 * (before_n + force_n);
        if speed <= 0.0 {
            break;
        }
        points.push((penetration_m, *force_n));
        (before_n, step_s) = (*force_n, 1.0 / rate_hz);
    }
    points
}

/// Returns means of neighbouring points, at most [`MAX_POINTS`].
fn grouped(points: &[(f64, f64)]) -> Vec<Pool> {
    let size = points.len().div_ceil(MAX_POINTS).max(1);
    let mean = |group: &[(f64, f64)]| {
        let count = group.len() as f64;
        Pool {
            penetration_m: group.iter().map(|point| point.0).sum::<f64>() / count,
            force_n: group.iter().map(|point| point.1).sum::<f64>() / count,
            count,
        }
    };
    points.chunks(size).map(mean).collect()
}

/// Joins neighbours until the force ascends from above 0.
fn ascending(points: &[Pool]) -> Vec<Pool> {
    let mut pools: Vec<Pool> = Vec::new();
    for point in points {
        let mut pool = *point;
        while let Some(before) = pools.pop_if(|before| before.force_n >= pool.force_n) {
            let count = before.count + pool.count;
            let mean = |a: f64, b: f64| (a * before.count + b * pool.count) / count;
            pool = Pool {
                penetration_m: mean(before.penetration_m, pool.penetration_m),
                force_n: mean(before.force_n, pool.force_n),
                count,
            };
        }
        if pool.force_n > 0.0 {
            pools.push(pool);
        }
    }
    pools
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::fit;
    use super::*;
    use jounce_signal::RandomStream;
    use jounce_signal::spectral::{HitSearch, hits};

    const MASS_KG: f64 = 0.1;
    const SPEED_M_S: f64 = 0.5;
    /// N/m^1.5
    const STIFFNESS: f64 = 1e8;

    /// Greatest penetration of an elastic Hertz impact (Goldsmith 1960): (5 m v^2 / (4 k))^(2/5).
    fn deepest_m() -> f64 {
        (1.25 * MASS_KG * SPEED_M_S * SPEED_M_S / STIFFNESS).powf(0.4)
    }

    /// Force of Hertz's impact with the damping factor c of Hunt and Crossley, by the classical
    /// Runge-Kutta method with 20 steps per sample; the pulse begins between two samples.
    fn pulse(damping: f64, rate_hz: f64, noise_n: f64) -> (Vec<f64>, f64) {
        let force =
            |d: f64, v: f64| (STIFFNESS * d.max(0.0).powf(1.5) * (1.0 + damping * v)).max(0.0);
        let step = 1.0 / (20.0 * rate_hz);
        let mut stream = RandomStream::new(7, 0);
        let (mut d, mut v, mut deepest) = (0.0, SPEED_M_S, 0.0_f64);
        let mut values = vec![0.0; 40];
        for k in 0..200_000 {
            if k % 20 == 7 {
                values.push(force(d, v));
            }
            let slope = |d: f64, v: f64| (v, -force(d, v) / MASS_KG);
            let a = slope(d, v);
            let b = slope(d + 0.5 * step * a.0, v + 0.5 * step * a.1);
            let c = slope(d + 0.5 * step * b.0, v + 0.5 * step * b.1);
            let e = slope(d + step * c.0, v + step * c.1);
            d += step / 6.0 * (a.0 + 2.0 * b.0 + 2.0 * c.0 + e.0);
            v += step / 6.0 * (a.1 + 2.0 * b.1 + 2.0 * c.1 + e.1);
            deepest = deepest.max(d);
            if d < 0.0 {
                break;
            }
        }
        values.resize(20 * values.len(), 0.0);
        for value in &mut values {
            *value += noise_n * stream.normal_pair()[0];
        }
        (values, deepest)
    }

    fn curve(
        values: &[f64],
        rate_hz: f64,
        speed: Option<f64>,
    ) -> Result<LoadingCurve, ContactError> {
        let samples = Samples::new(values, rate_hz).unwrap();
        let hit = &hits(&samples, HitSearch::default()).unwrap()[0];
        let law = fit(&samples, hit, Some(MASS_KG)).unwrap();
        let speed = speed.or(law.speed_m_s).unwrap();
        loading_curve(&samples, hit, law.units.start_s, MASS_KG, speed)
    }

    /// Largest difference from `k d^1.5`, relative to the largest force.
    fn error(curve: &LoadingCurve) -> f64 {
        let points = curve.penetration_m.iter().zip(&curve.force_n);
        let errors = points.map(|(d, f)| (f - STIFFNESS * d.powf(1.5)).abs());
        errors.fold(0.0, f64::max) / (STIFFNESS * deepest_m().powf(1.5))
    }

    /// The simulated pulse reaches the depth of the closed form. The table is Hertz's law, and its
    /// work is the kinetic energy; both errors fall with the sampling rate.
    #[test]
    fn the_pulse_of_a_hertz_impact_gives_hertz_law() {
        for (rate_hz, bound) in [(2e4, 1e-2), (2e5, 2e-4)] {
            let (values, deepest) = pulse(0.0, rate_hz, 0.0);
            assert!((deepest / deepest_m() - 1.0).abs() < 1e-5);
            for speed in [None, Some(SPEED_M_S)] {
                let curve = curve(&values, rate_hz, speed).unwrap();
                let error = error(&curve);
                let last = *curve.penetration_m.last().unwrap();
                let work: f64 = (1..curve.force_n.len())
                    .map(|k| {
                        let width = curve.penetration_m[k] - curve.penetration_m[k - 1];
                        0.5 * width * (curve.force_n[k] + curve.force_n[k - 1])
                    })
                    .sum();
                // The last point lies at most one group of samples before the greatest depth.
                let rest = (deepest - last) * STIFFNESS * deepest.powf(1.5);
                let energy = 0.5 * MASS_KG * SPEED_M_S * SPEED_M_S;
                assert!(error < bound, "{error:e}");
                assert!((last / deepest - 1.0).abs() < 0.02);
                assert!(((work + rest) / energy - 1.0).abs() < 0.02);
            }
        }
    }

    /// Noise of 0.5 % of the peak is pooled to an ascending table.
    #[test]
    fn a_noisy_pulse_gives_an_ascending_table() {
        let (clean, _) = pulse(0.0, 2e5, 0.0);
        let peak = clean.iter().copied().fold(0.0, f64::max);
        let (values, _) = pulse(0.0, 2e5, 0.005 * peak);
        let curve = curve(&values, 2e5, None).unwrap();
        let ascends = |values: &[f64]| values.windows(2).all(|pair| pair[1] > pair[0]);
        assert!(ascends(&curve.penetration_m) && ascends(&curve.force_n));
        assert!(curve.penetration_m[0] > 0.0 && curve.force_n[0] > 0.0);
        assert!(curve.force_n.len() > 20);
        let error = error(&curve);
        assert!(error < 0.02, "{error:e}");
    }

    /// With damping the table holds all force of the loading, more than that of the spring.
    #[test]
    fn the_force_of_damping_is_part_of_the_table() {
        let (values, deepest) = pulse(0.6, 2e5, 0.0);
        let curve = curve(&values, 2e5, Some(SPEED_M_S)).unwrap();
        let middle = curve.penetration_m.len() / 2;
        let [d, f] = [curve.penetration_m[middle], curve.force_n[middle]];
        assert!(f > 1.1 * STIFFNESS * d.powf(1.5), "{d} {f}");
        assert!(*curve.penetration_m.last().unwrap() < deepest * 1.001);
    }

    #[test]
    fn a_speed_that_does_not_fit_the_impulse_is_refused() {
        let (values, _) = pulse(0.0, 2e5, 0.0);
        for speed in [0.2, 1.5] {
            let error = curve(&values, 2e5, Some(speed)).unwrap_err();
            assert!(matches!(error, ContactError::Momentum { .. }), "{error}");
        }
    }
}

//! Fit of a contact law to a pulse.

use jounce_signal::Samples;
use levenberg_marquardt::LevenbergMarquardt;
use nalgebra::DVector;

use super::law::{Stiffness, covariance, relative_error, speed_m_s};
use super::problem::PulseProblem;
use super::{AllowedLaws, ContactError, ContactFit, FixedExponentLaw, PulseShape, PulseUnits};
use jounce_signal::spectral::Hit;

/// Unknowns of the fit with a free exponent, plus one sample for the noise.
const MIN_SAMPLES: usize = 6;
/// Samples before and after the pulse that are also fitted, relative to its length.
const MARGIN_SHARE: f64 = 0.25;
/// Fits the law to one hit of a force record. The body is assumed stationary during the contact.
///
/// # Errors
/// A pulse of too few samples, a mass that is not positive, a pulse that no law fits.
pub fn fit(
    force: &Samples<'_>,
    hit: &Hit,
    hammer_mass_kg: Option<f64>,
) -> Result<ContactFit, ContactError> {
    if let Some(mass_kg) = hammer_mass_kg.filter(|mass| !(*mass > 0.0 && mass.is_finite())) {
        return Err(ContactError::Mass { mass_kg });
    }
    let margin = ((hit.end - hit.start) as f64 * MARGIN_SHARE).ceil() as usize;
    let (first, last) = (
        hit.start.saturating_sub(margin),
        (hit.end + margin).min(force.values().len()),
    );
    if hit.end - hit.start < MIN_SAMPLES {
        return Err(ContactError::Coarse {
            samples: hit.end - hit.start,
            needed: MIN_SAMPLES,
        });
    }
    let time_s: Vec<f64> = (first..last).map(|k| k as f64 / force.rate_hz()).collect();
    let force_n = &force.values()[first..last];
    let (problem, squared) = minimised(&time_s, force_n, hit, None)?;
    let [start_s, unit_s, unit_n, exponent, damping] = problem.parameters(&problem.unknowns);
    let shape = PulseShape::new(exponent, damping);
    let covariance = covariance(&problem, squared)?;
    let deviation = |k: usize| covariance[(k, k)].sqrt() * problem.scale[k];
    let laws = AllowedLaws::of(exponent, deviation(3));
    let slope = (PulseShape::new(exponent, damping + 0.01).restitution - shape.restitution) / 0.01;
    let stiffness = hammer_mass_kg.map(|mass_kg| Stiffness::of(&problem, &covariance, mass_kg));
    let fixed_law = |allowed: &[AllowedLaws], exponent: f64| {
        let law = allowed
            .contains(&laws)
            .then(|| FixedExponentLaw::of(exponent, (&time_s, force_n), hit, hammer_mass_kg));
        law.transpose()
    };
    Ok(ContactFit {
        contact_time_s: shape.length * unit_s,
        exponent,
        exponent_deviation: deviation(3),
        restitution: shape.restitution,
        restitution_deviation: slope.abs() * deviation(4),
        stiffness: stiffness.as_ref().map(|stiffness| stiffness.value),
        stiffness_relative_deviation: stiffness
            .as_ref()
            .map(|stiffness| stiffness.relative_deviation),
        stiffness_95: stiffness.as_ref().map(Stiffness::interval_95),
        speed_m_s: hammer_mass_kg.map(|mass_kg| speed_m_s(&problem, mass_kg)),
        relative_error: relative_error(squared, &time_s, hit),
        allowed_laws: laws,
        linear: fixed_law(&[AllowedLaws::Linear, AllowedLaws::Both], 1.0)?,
        hertz: fixed_law(&[AllowedLaws::Hertz, AllowedLaws::Both], 1.5)?,
        units: PulseUnits {
            start_s,
            unit_s,
            unit_n,
            damping,
        },
    })
}

/// Returns the best fit and its squared error, from a guess with the peak and length of the hit.
pub(super) fn minimised<'a>(
    time_s: &'a [f64],
    force_n: &'a [f64],
    hit: &Hit,
    exponent: Option<f64>,
) -> Result<(PulseProblem<'a>, f64), ContactError> {
    let mut best: Option<(PulseProblem<'a>, f64)> = None;
    // The initial damping decides on which side of a nearly symmetrical pulse the fit begins.
    for (guess, damping) in [(1.5, 0.1), (1.5, 0.6), (2.5, 0.3)] {
        let guess = exponent.unwrap_or(guess);
        let shape = PulseShape::new(guess, damping);
        let (peak, at) = shape.peak();
        let unit_s = 1.15 * hit.contact_time_s / shape.length;
        let peak_s =
            time_s[0] + (hit.peak as f64 - (time_s[0] * rate(time_s)).round()) / rate(time_s);
        let mut scale = vec![unit_s, unit_s, hit.peak_force_n / peak];
        scale.extend(exponent.is_none().then_some(guess));
        scale.push(1.0);
        let mut unknowns = DVector::from_element(scale.len(), 1.0);
        unknowns[0] = (peak_s - at * unit_s) / unit_s;
        *unknowns
            .get_mut(scale.len() - 1)
            .ok_or(ContactError::NoFit)? = damping;
        let problem = PulseProblem {
            time_s,
            force_n,
            exponent,
            scale,
            unknowns,
        };
        let (problem, report) = LevenbergMarquardt::new()
            .with_patience(60)
            .minimize(problem);
        let squared = 2.0 * report.objective_function;
        let is_finite = squared.is_finite() && problem.unknowns.iter().all(|x| x.is_finite());
        if is_finite && best.as_ref().is_none_or(|(_, least)| squared < *least) {
            best = Some((problem, squared));
        }
    }
    best.ok_or(ContactError::NoFit)
}

fn rate(time_s: &[f64]) -> f64 {
    1.0 / (time_s[1] - time_s[0])
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use jounce_signal::spectral::{HitSearch, hits};
    use jounce_signal::{NORMAL_95, RandomStream};

    const RATE: f64 = 200_000.0;

    /// A pulse of a known law with noise: mass 0.1 kg at 0.5 m/s.
    fn record(exponent: f64, damping: f64, noise_n: f64, seed: u64) -> (Vec<f64>, f64) {
        let (mass, speed, unit_s) = (0.1, 0.5, 1e-4);
        let shape = PulseShape::new(exponent, damping);
        let mut stream = RandomStream::new(seed, 0);
        let values = (0..2000).map(|k| {
            let time = f64::from(k) / RATE - 1.03e-3;
            mass * speed / unit_s * shape.at(time / unit_s) + noise_n * stream.normal_pair()[0]
        });
        let stiffness = mass * speed / unit_s / (speed * unit_s).powf(exponent);
        (values.collect(), stiffness)
    }

    fn fitted(values: &[f64]) -> ContactFit {
        let samples = Samples::new(values, RATE).unwrap();
        let result = hits(&samples, HitSearch::default()).unwrap();
        fit(&samples, &result[0], Some(0.1)).unwrap()
    }

    /// With hardly any noise (1e-6 N at a peak of hundreds) the fit recovers the parameters;
    /// measured: exponent 4e-9, restitution 1e-9, stiffness 4e-8, speed 4e-10.
    #[test]
    fn a_pulse_of_a_known_law_gives_the_law_back() {
        for (exponent, damping) in [(1.5, 0.3), (1.0, 0.2), (2.2, 0.5), (1.0, 0.0), (1.5, 0.0)] {
            let (values, stiffness) = record(exponent, damping, 1e-6, 1);
            let result = fitted(&values);
            assert!(
                (result.exponent - exponent).abs() < 1e-7,
                "{exponent}: {result:?}"
            );
            assert!(
                (result.restitution - PulseShape::new(exponent, damping).restitution).abs() < 1e-7,
                "{result:?}"
            );
            assert!(
                (result.stiffness.unwrap() / stiffness - 1.0).abs() < 1e-6,
                "{} {stiffness}",
                result.stiffness.unwrap()
            );
            assert!((result.speed_m_s.unwrap() / 0.5 - 1.0).abs() < 1e-7);
        }
    }

    /// Each law that a pulse allows has its own stiffness. With hardly any noise only the true law
    /// is allowed, and the fit recovers its stiffness. If the pulse does not distinguish them, both
    /// are allowed, each with a narrower interval than under a free exponent.
    #[test]
    fn every_law_that_a_pulse_allows_has_its_stiffness() {
        for (exponent, is_linear) in [(1.0, true), (1.5, false)] {
            let (values, stiffness) = record(exponent, 0.3, 1e-6, 1);
            let result = fitted(&values);
            assert_eq!(
                (result.linear.is_some(), result.hertz.is_some()),
                (is_linear, !is_linear),
                "{result:?}"
            );
            let law = result.linear.or(result.hertz).unwrap();
            assert!(
                (law.stiffness.unwrap() / stiffness - 1.0).abs() < 1e-8 && law.exponent == exponent,
                "{law:?} {stiffness}"
            );
            assert!(
                (law.speed_m_s.unwrap() / 0.5 - 1.0).abs() < 1e-8 && law.restitution < 1.0,
                "{law:?}"
            );
        }
        let (values, _) = record(1.2, 0.3, 1e-6, 1);
        let no_law = fitted(&values);
        assert_eq!(
            (no_law.allowed_laws, no_law.linear, no_law.hertz),
            (AllowedLaws::Neither, None, None)
        );
        let (values, stiffness) = record(1.5, 0.4, 40.0, 3);
        let coarse_values: Vec<f64> = values.into_iter().step_by(5).collect();
        let samples = Samples::new(&coarse_values, RATE / 5.0).unwrap();
        let result = fit(
            &samples,
            &hits(&samples, HitSearch::default()).unwrap()[0],
            Some(0.1),
        )
        .unwrap();
        let [free, linear, hertz] = [
            result.stiffness_95,
            result.linear.unwrap().stiffness_95,
            result.hertz.unwrap().stiffness_95,
        ]
        .map(Option::unwrap);
        eprintln!(
            "free {free:?}, linear {linear:?}, Hertz {hertz:?}; the truth is Hertz with {stiffness:.3e}"
        );
        assert!(
            (hertz.0..=hertz.1).contains(&stiffness),
            "{hertz:?} {stiffness}"
        );
        assert!(
            [linear, hertz]
                .iter()
                .all(|law| law.1 / law.0 < free.1 / free.0)
        );
    }

    /// With noise the truth lies within 1.96 deviations at the nominal rate: 95 +- 4 % of 150
    /// trials; measured 96 %.
    #[test]
    #[ignore = "long: runs with ./test --long"]
    fn stated_deviations_hold_the_truth() {
        let covered_count = (0..150).filter(|seed| {
            let result = fitted(&record(1.5, 0.4, 2.0, *seed).0);
            (result.exponent - 1.5).abs() <= NORMAL_95 * result.exponent_deviation
        });
        let covered_share = covered_count.count() as f64 / 150.0;
        assert!((0.91..=0.99).contains(&covered_share), "{covered_share}");
    }

    /// Coverage of stiffness, exponent and restitution, and of the stiffness under the true law: 95
    /// +- 4 % of 150 trials each.
    #[test]
    #[ignore = "long: runs with ./test --long"]
    fn intervals_hold_the_truth() {
        let (mut covered, mut law_covered, mut allowed) = ([0.0; 3], 0.0, 0.0);
        for seed in 0..150 {
            let (values, stiffness) = record(1.5, 0.4, 2.0, 1000 + seed);
            let result = fitted(&values);
            let (low, high) = result.stiffness_95.unwrap();
            let coverage = [
                (low..=high).contains(&stiffness),
                (result.exponent - 1.5).abs() <= result.exponent_half_width(),
                (result.restitution - PulseShape::new(1.5, 0.4).restitution).abs()
                    <= result.restitution_half_width(),
            ];
            covered
                .iter_mut()
                .zip(coverage)
                .for_each(|(share, is_covered)| *share += f64::from(u8::from(is_covered)) / 150.0);
            if let Some((low, high)) = result.hertz.and_then(|hertz| hertz.stiffness_95) {
                (allowed, law_covered) = (
                    allowed + 1.0,
                    law_covered + f64::from(u8::from((low..=high).contains(&stiffness))),
                );
            }
        }
        eprintln!(
            "Hertz's law is allowed in {allowed} of 150, its stiffness {:.3} inside",
            law_covered / allowed
        );
        assert!(
            allowed > 135.0 && (0.91..=0.99).contains(&(law_covered / allowed)),
            "{law_covered} {allowed}"
        );
        eprintln!(
            "stiffness {:.3}, exponent {:.3}, restitution {:.3}",
            covered[0], covered[1], covered[2]
        );
        assert!(
            covered.iter().all(|share| (0.91..=0.99).contains(share)),
            "{covered:?}"
        );
    }

    #[test]
    fn laws_are_distinguished_under_little_noise_only() {
        assert_eq!(
            fitted(&record(1.5, 0.4, 0.5, 3).0).allowed_laws,
            AllowedLaws::Hertz
        );
        let noisy: Vec<f64> = record(1.5, 0.4, 40.0, 3).0.into_iter().step_by(5).collect();
        let samples = Samples::new(&noisy, RATE / 5.0).unwrap();
        let result = fit(
            &samples,
            &hits(&samples, HitSearch::default()).unwrap()[0],
            None,
        )
        .unwrap();
        assert_eq!(result.allowed_laws, AllowedLaws::Both, "{result:?}");
        let (values, _) = record(1.5, 0.4, 0.5, 3);
        let coarse_values: Vec<f64> = values.into_iter().step_by(20).collect();
        let samples = Samples::new(&coarse_values, RATE / 20.0).unwrap();
        let hit = &hits(&samples, HitSearch::default()).unwrap()[0];
        assert!(matches!(
            fit(&samples, hit, None),
            Err(ContactError::Coarse { .. })
        ));
        assert!(matches!(
            fit(&samples, hit, Some(0.0)),
            Err(ContactError::Mass { .. })
        ));
    }
}

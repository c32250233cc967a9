//! Result of the fit of contact laws.

use jounce_data::recording::Issue;
use jounce_experiment::draw::PulseFigure;
use jounce_identification::contact::{
    AllowedLaws, ContactError, ContactFit, FixedExponentLaw, loading_curve,
};
use jounce_signal::Samples;
use jounce_signal::spectral::{Hit, HitWarning};
use serde::Serialize;

/// Hits of a recording, and the contact law fitted to each.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ContactResult {
    /// Name of the channel.
    pub channel: String,
    /// Mass of the hammer, kg.
    pub mass_kg: Option<f64>,
    /// Hits in order.
    pub hits: Vec<HitResult>,
    /// Force over penetration of each hit; empty without a mass.
    pub force_tables: Vec<ForceTableResult>,
    /// Data-quality issues of the channel and of the times.
    pub issues: Vec<Issue>,
    /// Samples of each hit, with the fitted law.
    #[serde(skip)]
    pub pulses: Vec<PulseFigure>,
}

/// A hit and its contact law; without a law its numbers are `None`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HitResult {
    /// Time of the largest force, s from the first sample.
    pub time_s: f64,
    /// Begin of the pulse, s from the first sample.
    pub start_s: f64,
    /// End of the pulse, s from the first sample.
    pub end_s: f64,
    /// Largest force, N.
    pub peak_force_n: f64,
    /// A tenth of the largest force, N.
    pub edge_force_n: f64,
    /// Time above a tenth of the largest force, s.
    pub contact_time_s: f64,
    /// Integral of the force, N s.
    pub impulse_n_s: f64,
    /// Warnings of the hit.
    pub warnings: Vec<HitWarning>,
    /// Reason why no law could be fitted.
    pub reason: Option<String>,
    /// Contact time of the law, s.
    pub law_contact_time_s: Option<f64>,
    /// Exponent of the law: 1 for a linear spring, 1.5 for Hertz.
    pub exponent: Option<f64>,
    /// Standard deviation of the exponent.
    pub exponent_deviation: Option<f64>,
    /// Half width of the 95 % interval of the exponent.
    pub exponent_half_width: Option<f64>,
    /// Ratio of speed after to speed before contact.
    pub restitution: Option<f64>,
    /// Standard deviation of the restitution.
    pub restitution_deviation: Option<f64>,
    /// Half width of the 95 % interval of the restitution.
    pub restitution_half_width: Option<f64>,
    /// Stiffness of the law, N/m^exponent; `None` without a mass.
    pub stiffness: Option<f64>,
    /// Standard deviation of the logarithm of the stiffness.
    pub stiffness_relative_deviation: Option<f64>,
    /// Lower end of the 95 % interval of the stiffness, N/m^exponent.
    pub stiffness_low: Option<f64>,
    /// Upper end of the 95 % interval of the stiffness, N/m^exponent.
    pub stiffness_high: Option<f64>,
    /// Speed of the hammer, m/s; `None` without a mass.
    pub speed_m_s: Option<f64>,
    /// Rms residual of the law relative to the largest force.
    pub relative_error: Option<f64>,
    /// Laws that the pulse allows, at 95 %.
    pub allowed_laws: Option<AllowedLaws>,
    /// Fit of a linear spring, stiffness in N/m.
    pub linear: FixedLawResult,
    /// Fit of Hertz's law, stiffness in N/m^1.5.
    pub hertz: FixedLawResult,
}

/// Force over penetration of one hit, for `law = "table"` of a stop: the loading branch of the pulse,
/// with the force of damping. Both lists are empty where there is a reason.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct ForceTableResult {
    /// Penetrations, m, ascending.
    pub penetration_m: Vec<f64>,
    /// Force at each of them, N, ascending.
    pub force_n: Vec<f64>,
    /// Speed of the hammer from which the penetrations follow, m/s.
    pub speed_m_s: Option<f64>,
    /// Reason why there is no table.
    pub reason: Option<String>,
}

impl ForceTableResult {
    /// Integrates the loading branch of a hit; the pulse begins as its fitted law does.
    pub(super) fn of(
        force: &Samples<'_>,
        hit: &Hit,
        law: &Result<ContactFit, ContactError>,
        (mass_kg, speed_m_s): (f64, Option<f64>),
    ) -> Self {
        let curve = law.as_ref().map_err(|error| *error).and_then(|law| {
            let speed = speed_m_s.or(law.speed_m_s).unwrap_or(f64::NAN);
            loading_curve(force, hit, law.units.start_s, mass_kg, speed)
        });
        match curve {
            Ok(curve) => Self {
                penetration_m: curve.penetration_m,
                force_n: curve.force_n,
                speed_m_s: Some(curve.speed_m_s),
                reason: None,
            },
            Err(error) => Self {
                reason: Some(error.to_string()),
                ..Self::default()
            },
        }
    }
}

/// Fit of a law with a given exponent; its numbers are `None` where the pulse does not allow it.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct FixedLawResult {
    /// Stiffness, N/m^exponent; `None` without a mass.
    pub stiffness: Option<f64>,
    /// Lower end of the 95 % interval of the stiffness, N/m^exponent.
    pub stiffness_low: Option<f64>,
    /// Upper end of the 95 % interval of the stiffness, N/m^exponent.
    pub stiffness_high: Option<f64>,
    /// Ratio of speed after to speed before contact.
    pub restitution: Option<f64>,
    /// Speed of the hammer, m/s; `None` without a mass.
    pub speed_m_s: Option<f64>,
    /// Rms residual of the law relative to the largest force.
    pub relative_error: Option<f64>,
}

impl HitResult {
    pub(super) fn new(
        hit: &Hit,
        law: Result<ContactFit, ContactError>,
        rate_hz: f64,
        edge_ratio: f64,
    ) -> Self {
        let at = |sample: usize| sample as f64 / rate_hz;
        let reason = law.as_ref().err().map(ToString::to_string);
        let law = law.ok();
        let number = |value: fn(&ContactFit) -> f64| law.as_ref().map(value);
        let with_mass = |value: fn(&ContactFit) -> Option<f64>| law.as_ref().and_then(value);
        let (stiffness_low, stiffness_high) = law.as_ref().and_then(|law| law.stiffness_95).unzip();
        let fixed = |law: Option<FixedExponentLaw>| law.map(FixedLawResult::of).unwrap_or_default();
        Self {
            time_s: at(hit.peak),
            start_s: at(hit.start),
            end_s: at(hit.end),
            peak_force_n: hit.peak_force_n,
            edge_force_n: edge_ratio * hit.peak_force_n,
            contact_time_s: hit.contact_time_s,
            impulse_n_s: hit.impulse_n_s,
            warnings: hit.warnings.clone(),
            reason,
            law_contact_time_s: number(|law| law.contact_time_s),
            exponent: number(|law| law.exponent),
            exponent_deviation: number(|law| law.exponent_deviation),
            exponent_half_width: number(ContactFit::exponent_half_width),
            restitution: number(|law| law.restitution),
            restitution_deviation: number(|law| law.restitution_deviation),
            restitution_half_width: number(ContactFit::restitution_half_width),
            stiffness: with_mass(|law| law.stiffness),
            stiffness_relative_deviation: with_mass(|law| law.stiffness_relative_deviation),
            stiffness_low,
            stiffness_high,
            speed_m_s: with_mass(|law| law.speed_m_s),
            relative_error: number(|law| law.relative_error),
            allowed_laws: law.as_ref().map(|law| law.allowed_laws),
            linear: fixed(law.as_ref().and_then(|law| law.linear)),
            hertz: fixed(law.as_ref().and_then(|law| law.hertz)),
        }
    }
}

impl FixedLawResult {
    fn of(law: FixedExponentLaw) -> Self {
        let (stiffness_low, stiffness_high) = law.stiffness_95.unzip();
        Self {
            stiffness: law.stiffness,
            stiffness_low,
            stiffness_high,
            restitution: Some(law.restitution),
            speed_m_s: law.speed_m_s,
            relative_error: Some(law.relative_error),
        }
    }
}

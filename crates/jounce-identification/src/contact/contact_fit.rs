//! Contact law of a pulse, with its uncertainty.

use super::{FixedExponentLaw, PulseShape};
use jounce_signal::NORMAL_95;
use serde::Serialize;

/// Contact law with its uncertainty, as standard deviations.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ContactFit {
    /// Contact duration of the law, from touch to separation, s; longer than the time of a hit
    /// above a tenth of its peak.
    pub contact_time_s: f64,
    /// Exponent of the law: 1 for a linear spring, 1.5 for Hertz.
    pub exponent: f64,
    /// Standard deviation of the exponent.
    pub exponent_deviation: f64,
    /// Coefficient of restitution.
    pub restitution: f64,
    /// Standard deviation of the restitution.
    pub restitution_deviation: f64,
    /// Stiffness, N/m^exponent, for the mass of the hammer; `None` without a mass.
    pub stiffness: Option<f64>,
    /// Standard deviation of the logarithm of the stiffness, including exponent and units; `None`
    /// without a mass.
    pub stiffness_relative_deviation: Option<f64>,
    /// Confidence interval of the stiffness, 95 %, in N/m^exponent with the fitted exponent; `None`
    /// without a mass.
    pub stiffness_95: Option<(f64, f64)>,
    /// Approach velocity of the hammer, m/s; `None` without a mass.
    pub speed_m_s: Option<f64>,
    /// RMS residual of the law relative to the peak force.
    pub relative_error: f64,
    /// Laws that the pulse allows.
    pub allowed_laws: AllowedLaws,
    /// Fit of a linear spring; `None` where the pulse does not allow it.
    pub linear: Option<FixedExponentLaw>,
    /// Fit of Hertz's law; `None` where the pulse does not allow it.
    pub hertz: Option<FixedExponentLaw>,
    /// Start and units of the fitted pulse.
    #[serde(skip)]
    pub units: PulseUnits,
}

/// Start and units of a fitted pulse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PulseUnits {
    /// Start, s from the first sample of the record.
    pub start_s: f64,
    /// Unit of time, s.
    pub unit_s: f64,
    /// Unit of force, N.
    pub unit_n: f64,
    /// Damping of the law in these units.
    pub damping: f64,
}

impl ContactFit {
    /// Half-width of the 95 % confidence interval of the exponent.
    pub fn exponent_half_width(&self) -> f64 {
        NORMAL_95 * self.exponent_deviation
    }

    /// Half-width of the 95 % confidence interval of the restitution.
    pub fn restitution_half_width(&self) -> f64 {
        NORMAL_95 * self.restitution_deviation
    }

    /// Force of the law at times of the record, N.
    pub fn force_n(&self, time_s: &[f64]) -> Vec<f64> {
        let shape = PulseShape::new(self.exponent, self.units.damping);
        time_s
            .iter()
            .map(|t| self.units.unit_n * shape.at((t - self.units.start_s) / self.units.unit_s))
            .collect()
    }
}

/// Laws that a pulse allows, at 95 %.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum AllowedLaws {
    /// Neither the linear spring nor Hertz's law.
    Neither,
    /// The linear spring, not Hertz's law.
    Linear,
    /// Hertz's law, not the linear spring.
    Hertz,
    /// Both: the data do not distinguish them.
    Both,
}

impl AllowedLaws {
    /// Laws whose exponent is in the 95 % interval of the fitted one.
    pub(super) fn of(exponent: f64, deviation: f64) -> Self {
        let is_allowed = |value: f64| (exponent - value).abs() <= NORMAL_95 * deviation;
        match (is_allowed(1.0), is_allowed(1.5)) {
            (true, true) => Self::Both,
            (true, false) => Self::Linear,
            (false, true) => Self::Hertz,
            (false, false) => Self::Neither,
        }
    }
}

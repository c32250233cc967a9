//! Options of an estimate of the restitution.

use crate::error::Error;
use crate::options::{check_above_zero, defaults, si};
use jounce_spec::Quantity;
use serde::{Deserialize, Serialize};

/// Options of [`crate::restitution()`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RestitutionOptions {
    /// Material of the ball.
    #[arg(long)]
    pub material: String,
    /// Material of the stop.
    #[arg(long)]
    pub stop_material: String,
    /// Radius of the ball, as in 5mm; required.
    #[arg(long = "radius", value_name = "LENGTH", value_parser = si(Quantity::Length))]
    pub radius_m: Option<f64>,
    /// Radius of the stop at the contact, negative for a concave seat; by default the stop is flat.
    #[arg(long = "stop-radius", value_name = "LENGTH", allow_hyphen_values = true, value_parser = si(Quantity::Length))]
    pub stop_radius_m: Option<f64>,
    /// Mass of the ball, as in 4g; required.
    #[arg(long = "mass", value_name = "MASS", value_parser = si(Quantity::Mass))]
    pub mass_kg: Option<f64>,
    /// Mass of the stop; by default the stop is at rest.
    #[arg(long = "stop-mass", value_name = "MASS", value_parser = si(Quantity::Mass))]
    pub stop_mass_kg: Option<f64>,
    /// Speed of approach, as in "0.5 m/s"; required.
    #[arg(long = "speed", value_name = "SPEED", value_parser = si(Quantity::Speed))]
    pub speed_m_s: Option<f64>,
    /// Yield strength of the softer body, as in 250MPa; by default the range of the library.
    #[arg(long = "yield-strength", value_name = "PRESSURE", value_parser = si(Quantity::Pressure))]
    pub yield_strength_pa: Option<f64>,
}

impl Default for RestitutionOptions {
    fn default() -> Self {
        defaults()
    }
}

/// Values of a collision.
pub(super) struct Checked {
    /// Effective radius `1 / (1/R1 + 1/R2)`, m.
    pub(super) radius_m: f64,
    /// Effective mass `1 / (1/m1 + 1/m2)`, kg.
    pub(super) mass_kg: f64,
    pub(super) speed_m_s: f64,
}

impl RestitutionOptions {
    /// Checks the ranges and combines both bodies; returns the errors of all options.
    pub(super) fn checked(&self) -> Result<Checked, Vec<Error>> {
        let radius_m = required("radius", self.radius_m, "m", "5mm");
        let mass_kg = required("mass", self.mass_kg, "kg", "4g");
        let speed_m_s = required("speed", self.speed_m_s, "m/s", "\"0.5 m/s\"");
        let positive = |option, value: Option<f64>, unit| match value {
            Some(value) => check_above_zero(option, value, unit).map(f64::recip),
            None => Ok(0.0),
        };
        let strength = positive("yield_strength", self.yield_strength_pa, "Pa");
        let stop_mass = positive("stop_mass", self.stop_mass_kg, "kg");
        let radius_m = radius_m.and_then(|radius_m| self.effective_radius_m(radius_m));
        match (radius_m, mass_kg, speed_m_s, strength, stop_mass) {
            (Ok(radius_m), Ok(mass_kg), Ok(speed_m_s), Ok(_), Ok(stop_mass)) => Ok(Checked {
                radius_m,
                mass_kg: (1.0 / mass_kg + stop_mass).recip(),
                speed_m_s,
            }),
            (radius_m, mass_kg, speed_m_s, strength, stop_mass) => {
                let results = [radius_m, mass_kg, speed_m_s, strength, stop_mass];
                Err(results.into_iter().filter_map(Result::err).collect())
            }
        }
    }

    /// Returns `1 / (1/R1 + 1/R2)` for a radius of the ball.
    fn effective_radius_m(&self, radius_m: f64) -> Result<f64, Error> {
        let curvature = 1.0 / radius_m + self.stop_radius_m.map_or(0.0, f64::recip);
        if curvature.is_finite() && curvature > 0.0 {
            return Ok(curvature.recip());
        }
        let stop_radius_m = self.stop_radius_m.unwrap_or(f64::NAN);
        let expected = format!("a concave seat must be wider than the ball, {radius_m} m");
        Err(Error::option(
            "stop_radius",
            format!("{stop_radius_m} m"),
            expected,
        ))
    }
}

fn required(
    option: &'static str,
    value: Option<f64>,
    unit: &str,
    example: &str,
) -> Result<f64, Error> {
    match value {
        Some(value) => check_above_zero(option, value, unit),
        None => Err(Error::option(
            option,
            "missing",
            format!("give it, as in {example}"),
        )),
    }
}

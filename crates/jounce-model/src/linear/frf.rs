//! Frequency response functions of any output to a force on a point or an acceleration of the base.

use crate::plant::{Plant, PlantError};
use jounce_linalg::c64;
use std::f64::consts::TAU;

/// Excitation of a frequency response.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FrfInput {
    /// A force on a point, N.
    Force(String),
    /// An acceleration of the base, m/s^2; displacements, velocities and accelerations of points
    /// are relative to the base.
    BaseAcceleration,
}

/// Output of a frequency response.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FrfOutput {
    /// Displacement of a point, m.
    Displacement(String),
    /// Velocity of a point, m/s.
    Velocity(String),
    /// Acceleration of a point, m/s^2.
    Acceleration(String),
    /// Voltage of a patch, V.
    Voltage(String),
    /// Voltage across the resistor of a circuit, V.
    LoadVoltage(String),
}

/// One frequency response function.
#[derive(Debug, Clone, PartialEq)]
pub struct Frf {
    /// Output.
    pub response: FrfOutput,
    /// Value per newton, or per m/s^2 of the base, at each frequency.
    pub value: Vec<c64>,
}

impl FrfOutput {
    /// Returns the name for tables, with the unit as its suffix.
    pub fn name(&self) -> String {
        match self {
            FrfOutput::Displacement(point) => format!("{point}.displacement"),
            FrfOutput::Velocity(point) => format!("{point}.velocity"),
            FrfOutput::Acceleration(point) => format!("{point}.acceleration"),
            FrfOutput::Voltage(patch) => format!("{patch}.voltage"),
            FrfOutput::LoadVoltage(load) => format!("{load}.load_voltage"),
        }
    }

    /// Returns the unit per unit of the input.
    pub fn unit(&self, input: &FrfInput) -> &'static str {
        match (self, input) {
            (FrfOutput::Displacement(_), FrfInput::Force(_)) => "m/N",
            (FrfOutput::Velocity(_), FrfInput::Force(_)) => "m/(s N)",
            (FrfOutput::Acceleration(_), FrfInput::Force(_)) => "m/(s^2 N)",
            (FrfOutput::Voltage(_) | FrfOutput::LoadVoltage(_), FrfInput::Force(_)) => "V/N",
            (FrfOutput::Displacement(_), FrfInput::BaseAcceleration) => "m/(m/s^2)",
            (FrfOutput::Velocity(_), FrfInput::BaseAcceleration) => "(m/s)/(m/s^2)",
            (FrfOutput::Acceleration(_), FrfInput::BaseAcceleration) => "(m/s^2)/(m/s^2)",
            (FrfOutput::Voltage(_) | FrfOutput::LoadVoltage(_), FrfInput::BaseAcceleration) => {
                "V/(m/s^2)"
            }
        }
    }
}

/// Returns the responses to a unit amplitude of `input`, at each frequency.
///
/// # Errors
/// [`PlantError::UnknownName`] for an unknown point, patch or circuit,
/// [`PlantError::UndampedResonance`], [`PlantError::Switches`].
pub fn frf(
    plant: &Plant,
    input: &FrfInput,
    responses: &[FrfOutput],
    frequencies_hz: &[f64],
) -> Result<Vec<Frf>, PlantError> {
    frf_until(plant, input, responses, frequencies_hz, &|| false)
}

/// Returns the responses up to the frequency at which `is_stopped` is first true.
///
/// # Errors
/// As [`frf`].
pub fn frf_until(
    plant: &Plant,
    input: &FrfInput,
    responses: &[FrfOutput],
    frequencies_hz: &[f64],
    is_stopped: &dyn Fn() -> bool,
) -> Result<Vec<Frf>, PlantError> {
    if let Some(bridge) = plant.system.bridges.first() {
        return Err(PlantError::Switches {
            circuit: bridge.name.clone(),
        });
    }
    let force: Vec<c64> = match input {
        FrfInput::Force(point) => shape(plant, point)?
            .iter()
            .map(|s| c64::new(*s, 0.0))
            .collect(),
        FrfInput::BaseAcceleration => plant
            .system
            .modes
            .participation_sqrt_kg
            .iter()
            .map(|p| c64::new(-p, 0.0))
            .collect(),
    };
    let rows = responses
        .iter()
        .map(|response| row(plant, response))
        .collect::<Result<Vec<_>, _>>()?;
    let mut results: Vec<Frf> = responses
        .iter()
        .map(|r| Frf {
            response: r.clone(),
            value: Vec::new(),
        })
        .collect();
    for &frequency_hz in frequencies_hz.iter().take_while(|_| !is_stopped()) {
        let w = TAU * frequency_hz;
        let state = plant.steady_state(w, &force)?;
        for (result, row) in results.iter_mut().zip(&rows) {
            let value = crate::plant::dot(row, &state);
            let speeded = matches!(result.response, FrfOutput::Acceleration(_));
            result.value.push(if speeded {
                value * c64::new(0.0, w)
            } else {
                value
            });
        }
    }
    Ok(results)
}

fn row(plant: &Plant, response: &FrfOutput) -> Result<Vec<f64>, PlantError> {
    Ok(match response {
        FrfOutput::Displacement(point) => plant.displacement_row(shape(plant, point)?),
        FrfOutput::Velocity(point) | FrfOutput::Acceleration(point) => {
            plant.velocity_row(shape(plant, point)?)
        }
        FrfOutput::Voltage(patch) => {
            let patches: Vec<&String> = plant.system.modes.patch.keys().collect();
            let index = patches
                .iter()
                .position(|name| *name == patch)
                .ok_or_else(|| unknown("response", patch, &patches))?;
            plant.voltage_row(index)
        }
        FrfOutput::LoadVoltage(name) => {
            let loads = &plant.system.loads;
            let known: Vec<&String> = loads.iter().map(|load| &load.name).collect();
            let index = loads
                .iter()
                .position(|load| load.name == *name)
                .ok_or_else(|| unknown("response", name, &known))?;
            plant.load_voltage_row(index)
        }
    })
}

fn shape<'p>(plant: &'p Plant, point: &str) -> Result<&'p Vec<f64>, PlantError> {
    let shapes = &plant.system.modes.shape;
    shapes.get(point).ok_or_else(|| {
        unknown(
            "force or response",
            point,
            &shapes.keys().collect::<Vec<_>>(),
        )
    })
}

fn unknown(kind: &str, name: &str, known: &[&String]) -> PlantError {
    let known = known
        .iter()
        .map(|name| name.as_str())
        .collect::<Vec<_>>()
        .join(", ");
    PlantError::UnknownName {
        what: kind.to_owned(),
        name: name.to_owned(),
        known,
    }
}

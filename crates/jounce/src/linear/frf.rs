//! Frequency response functions of any output to a force on any point or to an acceleration of the base.

use crate::plant::{Plant, PlantError};
use faer::c64;
use std::f64::consts::TAU;

/// What shakes it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Input {
    /// A force on a point, N.
    Force(String),
    /// An acceleration of the base, m/s^2; displacements, velocities and accelerations of points are then relative to the base.
    BaseAcceleration,
}

/// What is looked at.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Response {
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
    /// What is looked at.
    pub response: Response,
    /// Value per newton, or per m/s^2 of the base, at each frequency.
    pub value: Vec<c64>,
}

impl Response {
    /// Name for tables, with the unit as its suffix.
    pub fn name(&self) -> String {
        match self {
            Response::Displacement(point) => format!("{point}.displacement"),
            Response::Velocity(point) => format!("{point}.velocity"),
            Response::Acceleration(point) => format!("{point}.acceleration"),
            Response::Voltage(patch) => format!("{patch}.voltage"),
            Response::LoadVoltage(load) => format!("{load}.load_voltage"),
        }
    }

    /// Unit per unit of the input.
    pub fn unit(&self, input: &Input) -> &'static str {
        match (self, input) {
            (Response::Displacement(_), Input::Force(_)) => "m/N",
            (Response::Velocity(_), Input::Force(_)) => "m/(s N)",
            (Response::Acceleration(_), Input::Force(_)) => "m/(s^2 N)",
            (Response::Voltage(_) | Response::LoadVoltage(_), Input::Force(_)) => "V/N",
            (Response::Displacement(_), Input::BaseAcceleration) => "m/(m/s^2)",
            (Response::Velocity(_), Input::BaseAcceleration) => "(m/s)/(m/s^2)",
            (Response::Acceleration(_), Input::BaseAcceleration) => "(m/s^2)/(m/s^2)",
            (Response::Voltage(_) | Response::LoadVoltage(_), Input::BaseAcceleration) => "V/(m/s^2)",
        }
    }
}

/// Responses to a unit amplitude of `input`, at each frequency.
///
/// # Errors
/// [`PlantError::UnknownName`] for a point, patch or circuit that is not there, [`PlantError::UndampedResonance`], [`PlantError::Switches`].
pub fn frf(plant: &Plant, input: &Input, responses: &[Response], frequencies_hz: &[f64]) -> Result<Vec<Frf>, PlantError> {
    frf_until(plant, input, responses, frequencies_hz, &|| false)
}

/// The same up to the frequency at which `is_stopped` is first true.
///
/// # Errors
/// As [`frf`].
pub fn frf_until(
    plant: &Plant,
    input: &Input,
    responses: &[Response],
    frequencies_hz: &[f64],
    is_stopped: &dyn Fn() -> bool,
) -> Result<Vec<Frf>, PlantError> {
    if let Some(bridge) = plant.system.bridges.first() {
        return Err(PlantError::Switches { circuit: bridge.name.clone() });
    }
    let force: Vec<c64> = match input {
        Input::Force(point) => shape(plant, point)?.iter().map(|s| c64::new(*s, 0.0)).collect(),
        Input::BaseAcceleration => plant.system.modes.participation_sqrt_kg.iter().map(|p| c64::new(-p, 0.0)).collect(),
    };
    let rows = responses.iter().map(|response| row(plant, response)).collect::<Result<Vec<_>, _>>()?;
    let mut answers: Vec<Frf> = responses.iter().map(|r| Frf { response: r.clone(), value: Vec::new() }).collect();
    for &frequency_hz in frequencies_hz.iter().take_while(|_| !is_stopped()) {
        let w = TAU * frequency_hz;
        let state = plant.steady_state(w, &force)?;
        for (answer, row) in answers.iter_mut().zip(&rows) {
            let value = crate::plant::dot(row, &state);
            let speeded = matches!(answer.response, Response::Acceleration(_));
            answer.value.push(if speeded { value * c64::new(0.0, w) } else { value });
        }
    }
    Ok(answers)
}

fn row(plant: &Plant, response: &Response) -> Result<Vec<f64>, PlantError> {
    Ok(match response {
        Response::Displacement(point) => plant.displacement_row(shape(plant, point)?),
        Response::Velocity(point) | Response::Acceleration(point) => plant.velocity_row(shape(plant, point)?),
        Response::Voltage(patch) => {
            let patches: Vec<&String> = plant.system.modes.patch.keys().collect();
            let index = patches.iter().position(|name| *name == patch).ok_or_else(|| unknown("response", patch, &patches))?;
            plant.voltage_row(index)
        }
        Response::LoadVoltage(name) => {
            let loads = &plant.system.loads;
            let known: Vec<&String> = loads.iter().map(|load| &load.name).collect();
            let index = loads.iter().position(|load| load.name == *name).ok_or_else(|| unknown("response", name, &known))?;
            plant.load_voltage_row(index)
        }
    })
}

fn shape<'p>(plant: &'p Plant, point: &str) -> Result<&'p Vec<f64>, PlantError> {
    let shapes = &plant.system.modes.shape;
    shapes.get(point).ok_or_else(|| unknown("force or response", point, &shapes.keys().collect::<Vec<_>>()))
}

fn unknown(what: &str, name: &str, known: &[&String]) -> PlantError {
    let known = known.iter().map(|name| name.as_str()).collect::<Vec<_>>().join(", ");
    PlantError::UnknownName { what: what.to_owned(), name: name.to_owned(), known }
}

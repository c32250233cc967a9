//! Adapts a model to a record: its drive and load, and one of its solutions as the start.

use jounce_analysis::run::StartState;
use jounce_spec::{DriveSignal, Spec};

use super::{Solution, SolutionError};

/// Sets the drive frequency of a model as in a record, and its load if known: `load` names the
/// circuit, by default the first.
pub fn as_recorded(
    spec: &mut Spec,
    drive_hz: f64,
    resistance_ohm: Option<f64>,
    load: Option<&str>,
) {
    for drive in spec.drive.values_mut() {
        if let DriveSignal::Sine { frequency_hz, .. } = &mut drive.signal {
            *frequency_hz = drive_hz;
        }
    }
    let circuit = match load {
        Some(name) => spec.circuit.get_mut(name),
        None => spec.circuit.values_mut().next(),
    };
    if let (Some(circuit), Some(resistance_ohm)) = (circuit, resistance_ohm) {
        circuit.resistance_ohm = resistance_ohm;
    }
}

/// Returns the initial state on the solution of an id.
///
/// # Errors
/// An id without solution, a solution without an orbit.
pub fn start_of(result: &[Solution], id: &str) -> Result<StartState, SolutionError> {
    let start = result
        .iter()
        .find(|solution| solution.id == id)
        .and_then(|solution| solution.start.clone());
    let known = || {
        result
            .iter()
            .map(|solution| solution.id.clone())
            .collect::<Vec<_>>()
            .join(", ")
    };
    start.ok_or_else(|| SolutionError::UnknownSolution {
        requested: id.to_owned(),
        known: known(),
    })
}

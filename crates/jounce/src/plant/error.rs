//! What can be wrong with a system before anything is computed.

/// A system that has no usable linear plant. Each carries its numbers.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum PlantError {
    /// A name in the spec leads nowhere.
    #[error("{what} refers to `{name}`, which is not there; there are: {known}")]
    UnknownName {
        /// The thing that refers.
        what: String,
        /// The name it uses.
        name: String,
        /// The names that exist.
        known: String,
    },
    /// Two circuits on one patch.
    #[error(
        "patch `{patch}` carries two circuits, `{first}` and `{second}`; give each patch one circuit"
    )]
    TwoCircuits {
        /// The patch.
        patch: String,
        /// First circuit.
        first: String,
        /// Second circuit.
        second: String,
    },
    /// Two eigenvectors coincide, so the plant cannot be diagonalised.
    #[error(
        "the modes of the coupled system are defective (condition number of the eigenvectors {condition:.1e}, allowed {allowed:.0e}); change a damping ratio or the resistance slightly"
    )]
    Defective {
        /// Condition number found.
        condition: f64,
        /// Largest condition number allowed.
        allowed: f64,
    },
    /// A circuit that switches has no frequency response.
    #[error(
        "circuit.{circuit}.interface is not linear, so that there is no frequency response; give interface = \"resistor\", or ask for the open circuit"
    )]
    Switches {
        /// The circuit.
        circuit: String,
    },
    /// The eigenvalue solver did not converge.
    #[error("the eigenvalues of the coupled system of {states} states could not be computed")]
    NoEigenvalues {
        /// Number of states.
        states: usize,
    },
    /// A circuit that settles or swings too far beyond the modes.
    #[error(
        "circuit.{circuit}.{key}: with {value:e} {unit} across {capacitance_f:e} F this circuit follows its voltage within {time_s:.1e} s, beyond {most:.0e} times faster than the fastest mode kept, {mode_hz:.4} Hz, where the eigenvalues drown in roundoff; give at least {least:.1e} {unit}, or a larger capacitance"
    )]
    TooFast {
        /// The circuit.
        circuit: String,
        /// Its key.
        key: &'static str,
        /// What the key says.
        value: f64,
        /// Its unit.
        unit: &'static str,
        /// Capacitance that it acts on, F.
        capacitance_f: f64,
        /// Time constant, s.
        time_s: f64,
        /// Largest ratio to the fastest mode that can be computed.
        most: f64,
        /// Frequency of the fastest mode kept, Hz.
        mode_hz: f64,
        /// Least value of the key that can be computed.
        least: f64,
    },
    /// The drive hits an undamped eigenvalue, so there is no steady state.
    #[error(
        "the drive at {frequency_hz} Hz is in resonance with an undamped mode at {mode_hz} Hz, so no steady state exists; give the mode some damping or move the drive"
    )]
    UndampedResonance {
        /// Drive frequency, Hz.
        frequency_hz: f64,
        /// Frequency of the mode, Hz.
        mode_hz: f64,
    },
    /// A mean power is asked of a mode that never decays.
    #[error(
        "{what} cannot be integrated: the mode at {mode_hz} Hz has no damping at all; give it a damping ratio"
    )]
    Undamped {
        /// The energy meter.
        what: String,
        /// Frequency of the mode, Hz.
        mode_hz: f64,
    },
    /// A stop whose port has no mobility.
    #[error(
        "stop `{stop}`: the striking point and the stop move together in every mode, so they can never meet"
    )]
    ImmobilePort {
        /// The stop.
        stop: String,
    },
}

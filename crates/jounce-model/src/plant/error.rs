//! Errors of a system that are found before any computation.

use jounce_spec::Quantity;

/// Reason why a system has no usable linear plant, with the numbers.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum PlantError {
    /// A name in the spec does not exist.
    #[error("{what} refers to `{name}`, which does not exist; available: {known}")]
    UnknownName {
        /// Element that refers.
        what: String,
        /// Name that it uses.
        name: String,
        /// Existing names.
        known: String,
    },
    /// A patch has two circuits.
    #[error(
        "patch `{patch}` has two circuits, `{first}` and `{second}`; give each patch one circuit"
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
    /// The derivative by a key is not known in closed form.
    #[error("the derivative of {part} has no closed form")]
    NoDerivative {
        /// The part.
        part: String,
    },
    /// A circuit with a switch has no frequency response.
    #[error(
        "circuit.{circuit}.interface is not linear, so it has no frequency response; set interface = \"resistor\", or request the open circuit"
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
    /// The rate of a circuit is too far above those of the modes.
    #[error(
        "circuit.{circuit}.{key} is {value:e} {unit}; with {} its time constant is {}, more than {most:.0e} times faster than the fastest retained mode, {}, so roundoff would hide the eigenvalues; if the mode is too slow, correct the lengths and materials of the structure; else give at least {least:.1e} {unit}, or a larger capacitance",
        Quantity::Capacitance.write_rounded(*capacitance_f, 4),
        Quantity::Time.write_rounded(*time_s, 2),
        Quantity::Frequency.write_rounded(*mode_hz, 4)
    )]
    TooFast {
        /// The circuit.
        circuit: String,
        /// Key of the circuit.
        key: &'static str,
        /// Value of the key.
        value: f64,
        /// Unit of the key.
        unit: &'static str,
        /// Capacitance across the circuit, F.
        capacitance_f: f64,
        /// Time constant, s.
        time_s: f64,
        /// Largest allowed ratio to the rate of the fastest mode.
        most: f64,
        /// Frequency of the fastest retained mode, Hz.
        mode_hz: f64,
        /// Smallest allowed value of the key.
        least: f64,
    },
    /// The drive is in resonance with an undamped eigenvalue, so there is no steady state.
    #[error(
        "the drive at {frequency_hz} Hz is in resonance with an undamped mode at {mode_hz} Hz, so no steady state exists; give the mode damping, or change the drive frequency"
    )]
    UndampedResonance {
        /// Drive frequency, Hz.
        frequency_hz: f64,
        /// Frequency of the mode, Hz.
        mode_hz: f64,
    },
    /// A mean power is requested of an undamped mode.
    #[error(
        "{what} cannot be integrated: the mode at {mode_hz} Hz has no damping; give it a damping ratio"
    )]
    Undamped {
        /// Energy meter.
        what: String,
        /// Frequency of the mode, Hz.
        mode_hz: f64,
    },
    /// The points of a force table are no force law.
    #[error(
        "stop.{stop}: the points of its table must ascend in penetration and force; correct penetration_m and force_n"
    )]
    NoForceCurve {
        /// The stop.
        stop: String,
    },
    /// The port of a stop has no mobility.
    #[error(
        "stop `{stop}`: the striking point and the stop move together in every mode, so they never touch; choose another `at` or `frame`"
    )]
    ImmobilePort {
        /// The stop.
        stop: String,
    },
}

//! Errors that end an integration early.

use jounce_units::Quantity;

/// Error that ends an integration early.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum IntegrationError {
    /// The contact force did not converge on any step length.
    #[error(
        "at t = {time_s} s the contact force of stop `{stop}` did not converge, even on a step of {} (penetration {}); check its stiffness and damping",
        Quantity::Time.write_rounded(*step_s, 3),
        Quantity::Length.write_rounded(*penetration_m, 4)
    )]
    ContactDiverged {
        /// Time, s.
        time_s: f64,
        /// Name of the stop.
        stop: String,
        /// Shortest step tried, s.
        step_s: f64,
        /// Penetration at its start, m.
        penetration_m: f64,
    },
    /// The plant cannot be built in another conduction state of its rectifiers.
    #[error(transparent)]
    ConductionState(#[from] jounce_model::plant::PlantError),
    /// The diodes or switches of a rectifier change repeatedly without advance in time.
    #[error(
        "at t = {time_s} s circuit `{circuit}` changed {changes} times at one instant; check its diodes, its storage and its drive"
    )]
    ChangesWithoutEnd {
        /// Time, s.
        time_s: f64,
        /// Name of the circuit.
        circuit: String,
        /// Number of changes.
        changes: usize,
    },
    /// The state is not finite.
    #[error(
        "at t = {time_s} s the state is not finite; check the amplitude of the drive and the contact law"
    )]
    NotFinite {
        /// Time, s.
        time_s: f64,
    },
    /// The integration was stopped, see [`jounce_control::Control::stop`].
    #[error("the integration was stopped at t = {time_s} s")]
    Stopped {
        /// Time, s.
        time_s: f64,
    },
    /// Sticking to rigid stops that constrain the same motion: their forces are not unique.
    #[error(
        "at t = {time_s} s the harvester sticks to the rigid stops {} at once, which constrain the same motion, so that their forces are not unique; give one of them a compliant law or another gap",
        .stops.join(", ")
    )]
    RestsTwice {
        /// Time, s.
        time_s: f64,
        /// Names of the stops.
        stops: Vec<String>,
    },
    /// Impacts and releases follow without advance in time.
    #[error(
        "at t = {time_s} s the stops {} had {impacts} impacts and releases without advance in time; give one of them a compliant law, another gap or a smaller restitution",
        .stops.join(", ")
    )]
    ImpactsWithoutEnd {
        /// Time, s.
        time_s: f64,
        /// Names of the stops.
        stops: Vec<String>,
        /// Number of impacts resolved.
        impacts: usize,
    },
}

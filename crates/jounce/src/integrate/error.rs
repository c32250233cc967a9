//! What ends a march before its time.

/// A march that could not go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum IntegrationError {
    /// The contact force did not converge on any step length.
    #[error(
        "at t = {time_s} s the contact force of stop `{stop}` did not converge, even on a step of {step_s:e} s (penetration {penetration_m:e} m); check its stiffness and damping"
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
    /// The plant in another regime of its rectifiers.
    #[error(transparent)]
    Regime(#[from] crate::plant::PlantError),
    /// A rectifier whose diodes or switch change without time going on.
    #[error(
        "at t = {time_s} s circuit `{circuit}` changed {changes} times at one instant; check its diodes, its storage and its drive"
    )]
    ChangesWithoutEnd {
        /// Time, s.
        time_s: f64,
        /// Name of the circuit.
        circuit: String,
        /// How often.
        changes: usize,
    },
    /// The state is no longer a number.
    #[error(
        "at t = {time_s} s the state is not finite; check the amplitude of the drive and the contact law"
    )]
    NotFinite {
        /// Time, s.
        time_s: f64,
    },
    /// Somebody asked for it, see [`super::Control::stop`].
    #[error("the march was stopped at t = {time_s} s")]
    Stopped {
        /// Time, s.
        time_s: f64,
    },
    /// Rest on rigid stops that hold the same motion: their forces have no unique share.
    #[error(
        "at t = {time_s} s the harvester rests on the rigid stops {} at once, which hold the same motion, so that their forces are not determined; give one of them a compliant law or another gap",
        .stops.join(", ")
    )]
    RestsTwice {
        /// Time, s.
        time_s: f64,
        /// Names of the stops.
        stops: Vec<String>,
    },
    /// Rigid stops touched at once that hand an impact to and fro.
    #[error(
        "at t = {time_s} s the rigid stops {} are touched at once and {impacts} impacts between them did not end; give one of them a compliant law, another gap or a smaller restitution",
        .stops.join(", ")
    )]
    ImpactsWithoutEnd {
        /// Time, s.
        time_s: f64,
        /// Names of the stops.
        stops: Vec<String>,
        /// Impacts resolved.
        impacts: usize,
    },
}

//! What ends a march before its time.

/// A march that could not go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MarchError {
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
    /// The state is no longer a number.
    #[error("at t = {time_s} s the state is not finite; check the amplitude of the drive and the contact law")]
    NotFinite {
        /// Time, s.
        time_s: f64,
    },
    /// Several stops at once.
    #[error("the harvester has {stops} stops; marching takes one stop today")]
    SeveralStops {
        /// Number of stops.
        stops: usize,
    },
}

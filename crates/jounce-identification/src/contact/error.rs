//! Errors of fitting a contact law.

/// Error of a pulse to which no law can be fitted.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum ContactError {
    /// Fewer samples than unknowns.
    #[error(
        "the pulse has {samples} samples around its peak; a law needs at least {needed}: sample faster or strike softer"
    )]
    Coarse {
        /// Samples of the pulse.
        samples: usize,
        /// Samples needed.
        needed: usize,
    },
    /// The hammer mass is not positive.
    #[error("the mass of the hammer is {mass_kg} kg; it must be a finite number > 0")]
    Mass {
        /// Mass, kg.
        mass_kg: f64,
    },
    /// The fit does not converge.
    #[error(
        "no contact law fits this pulse: the fit does not converge; is the pulse a single hit?"
    )]
    NoFit,
    /// Mass and speed do not match the impulse.
    #[error(
        "the impulse of {impulse_n_s:.4e} N s is not 1 to 2 times the momentum of the hammer, {momentum_n_s:.4e} N s; correct its mass, its speed or the scale of the force"
    )]
    Momentum {
        /// Impulse of the pulse, N s.
        impulse_n_s: f64,
        /// Momentum of the hammer before the contact, N s.
        momentum_n_s: f64,
    },
    /// The force does not ascend.
    #[error("the force does not ascend while the hammer is pressed in; is the pulse a single hit?")]
    NoLoading,
}

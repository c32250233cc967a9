//! Why a pulse tells nothing.

/// A pulse that no law is fitted to.
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
    /// A hammer without mass.
    #[error("the mass of the hammer is {mass_kg} kg; it must be a finite number > 0")]
    Mass {
        /// The mass, kg.
        mass_kg: f64,
    },
    /// The fit does not converge.
    #[error(
        "no law of contact follows this pulse: the fit does not converge; is the pulse one single hit?"
    )]
    NoFit,
}

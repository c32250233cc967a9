//! Kernel for an integration from a given state.

use jounce_dynamics::Kernel;
use std::ops::Deref;

/// Kernel of the model if its drives already start at the phase angles of the state; otherwise a
/// kernel with shifted drives.
#[derive(Debug)]
pub enum ModelAtStart<'k> {
    /// Kernel of the model.
    Same(&'k Kernel),
    /// Separate kernel with shifted drives.
    Turned(Box<Kernel>),
}

impl Deref for ModelAtStart<'_> {
    type Target = Kernel;

    fn deref(&self) -> &Kernel {
        match self {
            Self::Same(kernel) => kernel,
            Self::Turned(kernel) => kernel,
        }
    }
}

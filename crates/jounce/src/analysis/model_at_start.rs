//! A kernel to march from a state.

use crate::integrate::Kernel;
use std::ops::Deref;

/// The kernel of a harvester where its drives start at the angles of the state already, or else one whose drives do.
#[derive(Debug)]
pub enum ModelAtStart<'k> {
    /// That of the harvester.
    Same(&'k Kernel),
    /// One of its own.
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

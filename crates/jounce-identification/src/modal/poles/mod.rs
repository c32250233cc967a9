//! Poles of a band: least-squares search over a range of orders, and selection of the stable ones.
mod close_modes;
mod complex_plscf;
mod multi_band;
pub(super) mod plscf;
mod pole;
mod stabilisation;
mod sums;

pub use plscf::poles;
pub use pole::Pole;
pub use stabilisation::{Stability, StablePole, diagram};

pub(super) use close_modes::split_close_modes;
pub(super) use multi_band::stable;
pub(super) use stabilisation::MAX_DAMPING;

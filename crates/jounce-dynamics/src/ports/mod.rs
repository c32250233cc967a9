//! Values that the integration stores for each port, and for each port in contact.

pub(crate) mod per_port;
pub(crate) mod phasor;
pub(crate) mod small_list;
pub(crate) mod state;
pub(crate) mod vectors;

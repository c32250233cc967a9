//! Impacts on rigid stops, and the limit on impacts without advance in time.

pub(crate) mod acceleration;
mod rigid;
pub(crate) mod zeno_guard;

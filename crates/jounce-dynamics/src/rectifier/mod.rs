//! Rectifiers in an integration: changes of the conduction state and their energies.

mod charge_balance;
pub(crate) mod energies;
pub(crate) mod regulation;
pub(crate) mod switch_map;
pub(crate) mod switching;

//! Contacts with stops and between masses: compliant, rigid, sticking, several at once.

mod collisions;
mod cradle;
mod friction;
mod grazing;
mod instants;
pub mod ports;
mod rigid;
mod statistics;
mod sticking;
mod swings;

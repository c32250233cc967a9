//! Contacts with stops and between masses: compliant, rigid, sticking, several at once.

mod collisions;
mod cradle;
mod dashpots;
mod free_bodies;
mod friction;
mod grazing;
mod instants;
mod ports;
mod pressed;
mod rigid;
pub mod several_stops;
mod statistics;
mod sticking;
mod stiff_springs;
mod swings;
mod tables;

//! The model of a harvester: from its spec to a linear system with ports, in diagonal form.
//!
//! ```text
//! Spec -> Modes -> System -> Plant
//!         structure  plant
//! ```
//!
//! [`structure`] reduces beams, patches and masses to mass-normalised modes; [`plant`] couples them
//! with the circuits and finds the steady state under each drive; [`contact`] holds one file per
//! contact law, [`drive`] the time signals of drives, [`linear`] the responses without contact in
//! closed form, [`exchange`] matrices and circuits of other programs, and [`reference`](mod@reference)
//! problems with exact solutions.

pub mod contact;
pub mod drive;
pub mod exchange;
pub mod linear;
pub mod plant;
pub mod reference;
pub mod structure;

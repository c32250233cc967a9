//! Questions about a harvester, a file for each: its options as JSON, its result as a dictionary.

pub mod basins;
pub mod bifurcations;
pub mod branch;
pub mod cite;
pub mod design;
pub mod diagram;
pub mod ensemble;
pub mod exchange;
pub mod fit;
pub mod frf;
pub mod modes;
pub mod noise;
pub mod reproduce;
pub mod restitution;
pub mod rig;
pub mod run;
pub mod sensitivity;
pub mod study;
pub mod sweep;

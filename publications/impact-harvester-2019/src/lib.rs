//! Reproduction of the paper: Table 2, figures 4 to 9, a verdict on every claim, and the effect of
//! each assumption.
//!
//! Source: "Experimental validation of an impact off-resonance energy harvester" (2019), sections 2
//! to 4. The spec of its harvester is built in. Figures 10 to 13 are measured: [`experiment`]
//! makes them from the virtual rig, as a [`Chapter`].
//!
//! ```no_run
//! let control = jounce_control::Control::default();
//! let reproduction = impact_harvester_2019::reproduce(&control, &|stage| eprintln!("{stage}"))?;
//! let written = reproduction.write(std::path::Path::new("reproduction"))?;
//! println!("{}", written.report.display());
//! # Ok::<(), impact_harvester_2019::ReproduceError>(())
//! ```
mod chapter;
mod claim;
mod claims;
mod computed;
mod error;
pub mod experiment;
mod harvester;
mod impact;
mod named;
mod page;
mod reproduction;
mod results;

pub use chapter::Chapter;
pub use claim::Claim;
pub use error::ReproduceError;
pub use harvester::{paper_file, paper_spec};
pub use named::{NamedFigure, NamedTable};
pub use reproduction::{Reproduction, Written, folders, reproduce};

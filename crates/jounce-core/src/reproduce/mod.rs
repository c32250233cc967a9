//! Reproduction of the paper: Table 2, figures 4 to 9, a verdict on every claim, and the effect of
//! each assumption.
//!
//! Source: "Experimental validation of an impact off-resonance energy harvester" (2019), sections 2
//! to 4. The spec of its harvester is built in. Figures 10 to 13 are measured: `jounce-measure`
//! uses this library and adds them as a [`Chapter`].
//!
//! ```no_run
//! let control = jounce_core::integrate::Control::default();
//! let reproduction = jounce_core::reproduce::reproduce(&control, &|stage| eprintln!("{stage}"))?;
//! let written = reproduction.write(std::path::Path::new("reproduction"))?;
//! println!("{}", written.report.display());
//! # Ok::<(), jounce_core::reproduce::ReproduceError>(())
//! ```
mod assumptions;
mod chapter;
mod claim;
mod claims;
mod coexistence;
mod computed;
mod error;
mod frequency_responses;
mod harvester;
mod impact;
mod named;
mod orbits;
mod page;
mod power_over_frequency;
mod power_over_resistance;
mod reproduction;
mod runs;
mod stepped;
mod table_2;
mod voltage;

pub use chapter::Chapter;
pub use claim::Claim;
pub use error::ReproduceError;
pub use harvester::{paper_file, paper_spec};
pub use named::{NamedFigure, NamedTable};
pub use reproduction::{Reproduction, Written, folders, reproduce};

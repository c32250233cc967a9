//! Materials, chips of regulators, starter specs, and the keys of a spec.

use crate::error::Error;
use jounce_spec as spec;
use jounce_spec::material::{LIBRARY, Material};
use jounce_spec::starter::{STARTERS, Starter};
use jounce_spec::{CHIP_LIBRARY, Chip};

/// Returns the materials that a spec can name, with their sources.
///
/// ```
/// assert!(jounce::materials().iter().any(|material| material.name == "PZT-5A"));
/// ```
pub fn materials() -> &'static [Material] {
    LIBRARY
}

/// Returns the integrated circuits that the regulator of a spec can name, with their sources.
///
/// ```
/// let chips = jounce::chips();
/// assert!(chips.iter().any(|chip| chip.name == "BQ25570" && chip.regulator.stop_v == 2.39));
/// ```
pub fn chips() -> &'static [Chip] {
    CHIP_LIBRARY
}

/// Returns the commented starter specs, one per kind of harvester.
///
/// ```
/// let starter = jounce::starters()[0];
/// let harvester = jounce::Harvester::from_text(starter.spec, ".")?;
/// # Ok::<(), jounce::Error>(())
/// ```
pub fn starters() -> &'static [Starter] {
    STARTERS
}

/// Returns the starter spec of a kind of harvester.
///
/// # Errors
/// [`Error::Starter`] for an unknown kind; the message suggests the nearest one.
///
/// ```
/// assert!(jounce::starter("ball")?.summary.contains("bounces"));
/// # Ok::<(), jounce::Error>(())
/// ```
pub fn starter(kind: &str) -> Result<&'static Starter, Error> {
    Ok(Starter::of(kind)?)
}

/// Returns the JSON Schema (draft-07) of a spec.
///
/// ```
/// assert!(jounce::schema()["properties"]["beam"].is_object());
/// ```
pub fn schema() -> serde_json::Value {
    spec::schema()
}

/// Returns the reference of all keys of a spec, in Markdown.
///
/// ```
/// assert!(jounce::key_reference().contains("gap"));
/// ```
pub fn key_reference() -> String {
    spec::reference_markdown()
}

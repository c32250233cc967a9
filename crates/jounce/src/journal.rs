//! Journals of finished points, from which an interrupted analysis continues.

use crate::error::Error;
use crate::harvester::Harvester;
use crate::record::text_sha256;
use jounce_analysis::Journal;
use jounce_analysis::run::identity_text;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::path::Path;

/// Opens the journal of a question in a folder. The spec with its recordings and its start
/// state, the options and the version of jounce identify it; `options` holds no option on which the result does not depend.
///
/// # Errors
/// [`Error::Journal`].
pub fn open<P: Serialize + DeserializeOwned>(
    folder: &Path,
    harvester: &Harvester,
    (question, options): (&str, &impl Serialize),
) -> Result<Journal<P>, Error> {
    let options = serde_json::to_string(options).unwrap_or_default();
    let spec = identity_text(harvester.spec(), harvester.folder());
    let version = env!("CARGO_PKG_VERSION");
    let key = text_sha256(&format!("{spec} {question} {options} {version}"));
    Ok(Journal::open(folder, &key)?)
}

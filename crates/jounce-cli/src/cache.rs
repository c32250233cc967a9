//! Folder of the stored points of long work.

use crate::failure::Failure;
use crate::output;
use jounce::Error;
use jounce::parts::Journal;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::path::PathBuf;

/// Returns the folder of journals: `JOUNCE_CACHE`, else the user's cache folder, else the temporary
/// one.
pub fn folder() -> PathBuf {
    if let Some(folder) = std::env::var_os("JOUNCE_CACHE") {
        return PathBuf::from(folder);
    }
    let cache = std::env::var_os("XDG_CACHE_HOME").map(PathBuf::from);
    let home = || {
        std::env::var_os("HOME")
            .or_else(|| std::env::var_os("USERPROFILE"))
            .map(|home| PathBuf::from(home).join(".cache"))
    };
    cache
        .or_else(home)
        .unwrap_or_else(std::env::temp_dir)
        .join("jounce")
}

/// Removes the journal of a result that is completely written.
///
/// # Errors
/// A result that could not be printed, whose journal remains; a journal that cannot be removed.
pub fn finish<P: Serialize + DeserializeOwned>(journal: Journal<P>) -> Result<(), Failure> {
    output::check_printed()?;
    Ok(journal.finish().map_err(Error::from)?)
}

//! Where finished points of long work are kept, and under which name.

use sha2::{Digest, Sha256};
use std::path::PathBuf;

/// Where journals live: `JOUNCE_CACHE`, else the user's cache folder, else the temporary one.
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

/// Tells one piece of work from another: the spec's own digest, the options and the version.
pub fn key(spec_hash_hex: &str, options: &str) -> String {
    let digest = Sha256::digest(format!(
        "{spec_hash_hex} {options} {}",
        env!("CARGO_PKG_VERSION")
    ));
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}

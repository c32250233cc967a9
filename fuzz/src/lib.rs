//! Fuzzing of the readers of jounce: each input must give a result or an error, never a panic, a hang or much memory. What was
//! read must also have the properties that the functions in `readers/` check. See README.md.

pub mod readers;
mod scratch;
mod seeds;

use readers::Reader;
use std::process::exit;
use std::sync::OnceLock;

static CHOSEN: OnceLock<fn(&[u8])> = OnceLock::new();

/// Chooses the reader that the variable READER names.
pub fn choose(readers: &[Reader]) {
    let name = std::env::var("READER").unwrap_or_default();
    let Some((_, read)) = readers.iter().find(|reader| reader.0 == name) else {
        let names: Vec<&str> = readers.iter().map(|reader| reader.0).collect();
        eprintln!(
            "READER is \"{name}\"; it must be one of {}",
            names.join(" ")
        );
        exit(2);
    };
    CHOSEN.get_or_init(|| *read);
}

/// Writes the first inputs and ends the process, if the variable READER is `seeds`.
pub fn seeds_if_chosen() {
    if std::env::var("READER").is_ok_and(|name| name == "seeds") {
        seeds::write();
        exit(0);
    }
}

/// Reads one input.
pub fn read(data: &[u8]) {
    if let Some(read) = CHOSEN.get() {
        read(data);
    }
}

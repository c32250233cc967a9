//! Warnings about exceeded limits of patches.

use jounce_core::run::{ExceededLimit, WorstExcess};

/// Prints one line on stderr for each limit, with the place of the worst excess.
pub fn warn(exceeded: &[&[ExceededLimit]], items: &str, label: impl Fn(usize) -> String) {
    WorstExcess::messages(exceeded, items, label)
        .iter()
        .for_each(|text| eprintln!("warning: {text}"));
}

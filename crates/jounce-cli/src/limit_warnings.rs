//! Warnings about exceeded limits of patches.

use jounce_core::run::{ExceededLimit, WorstExcess};

/// Prints one line on stderr for each limit, with the place of the worst of the `answers`.
pub fn warn(answers: &[&[ExceededLimit]], what: &str, place: impl Fn(usize) -> String) {
    WorstExcess::messages(answers, what, place)
        .iter()
        .for_each(|text| eprintln!("warning: {text}"));
}

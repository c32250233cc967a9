//! Limits of patches that some of many answers pass.

use jounce::run::{Exceeded, Worst};

/// One line on stderr for each limit, with the place of the worst of the `answers`.
pub fn warn(answers: &[&[Exceeded]], what: &str, place: impl Fn(usize) -> String) {
    Worst::told(answers, what, place).iter().for_each(|text| eprintln!("warning: {text}"));
}

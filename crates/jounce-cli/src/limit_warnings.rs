//! Limits of patches that some of many answers pass.

use jounce::run::{Exceeded, Worst};

/// One line on stderr for each limit, with the place of the worst of the `answers`.
pub fn warn(answers: &[&[Exceeded]], what: &str, place: impl Fn(usize) -> String) {
    for worst in Worst::of(answers.iter().copied()) {
        let (count, of) = (worst.answers, answers.len());
        eprintln!("warning: {}; {count} of {of} {what} pass the limit, worst at {}", worst.exceeded, place(worst.place));
    }
}

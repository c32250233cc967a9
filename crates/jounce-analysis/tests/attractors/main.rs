//! Attractors of the starts of a cloud: the library's basin analysis against brute force, which
//! shares no code with it.
#![allow(clippy::unwrap_used, reason = "tests")]

mod agreement;
mod brute;
mod checks;
mod coverage;
mod drawn;
mod endings;
mod harvesters;
mod library;
mod random_specs;
mod stored;
mod transients;

use jounce_allocator as _;

//! The server over real sockets.
#![allow(clippy::unwrap_used, reason = "tests")]

mod attacks;
mod client;
mod excitation;
mod plates;
mod responses;

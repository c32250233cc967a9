//! The server over real sockets.
#![allow(clippy::unwrap_used, reason = "tests")]

mod answers;
mod attacks;
mod client;
mod shaken;

//! The server over real sockets.
#![allow(clippy::unwrap_used, reason = "tests")]

mod attacks;
mod client;
mod design;
mod excitation;
mod link;
mod many_pages;
mod operating_point;
mod plates;
mod responses;

//! Files and tables as other crates write and read them.
#![allow(clippy::unwrap_used, reason = "tests")]

mod formats;
mod store;
mod stored;
mod tables;

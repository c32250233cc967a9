//! The live page: `jounce explore SPEC` serves it on this machine, and every curve on it follows the sliders.
//!
//! # Contract
//!
//! One server belongs to one spec: a file, or a text that no file holds ([`Source`]). Its page holds the design as a list of overrides
//! (`key`, `value`, as in `--set`); the server keeps nothing between requests but what makes the next answer faster, and computes
//! everything with the library.
//!
//! ```text
//! GET /TOKEN/            the page; /TOKEN/app.js, /TOKEN/app.css, /TOKEN/icon.svg      nothing else is served
//! GET /TOKEN/socket      the websocket: requests in JSON, answers in binary frames
//!
//! request   {"id": 7, "ask": "response", "set": [["stop.tip.gap", "0.9 mm"]], "over": "drive.shaker.frequency", "from": 12, "to": 14}
//! frame     u32 length of the head, little endian | head, JSON, padded with spaces | Float64 arrays, little endian, 8-byte aligned
//! head      {"id": 7, "ask": "response", "stage": "coarse", ..., "arrays": [["parameter", 0, 120], ["power", 120, 120]]}
//! ```
//!
//! *Order.* Each socket has one lane per kind of request. A new request of a kind stops the one before it: its computation ends within
//! one march of a period, and its answer is never sent. A response comes first as `coarse` (branches chased from the orbits of the
//! design before), then as `fine` (the search of `jounce branch`). Work that takes longer than [`ServerLimits::longest`] is stopped and says so.
//!
//! *Safety.* The server listens on the loopback interface unless told otherwise. Every request and every socket must carry the token
//! (128 random bits) in its path, a `Host` that names this server, and, where the browser tells one, an `Origin` that is this server.
//! The token reaches the browser through a file that only its owner may read, never through the command line of a process. The page
//! runs under a content-security policy that allows nothing from elsewhere. Overrides may set numbers only, never the path of a file.
//! Bodies, frames, sockets and computation time are limited.
//!
//! *Return.* Port and token are kept in a file that only its owner may read, and taken again by the next server of the same spec: a page
//! that has lost its server comes back with it.
//!
//! *Failure.* What is wrong with a design comes back as faults in the words of the command line, by key. The file may change: the page is
//! told and asks again.

mod assets;
mod authenticator;
mod basins;
mod branches;
mod cancellation;
mod controls;
mod design;
mod drawing;
mod excitation;
mod file_watch;
mod frame;
mod latest_requests;
mod launch;
mod linear;
mod load_sweep;
mod orbit;
mod request;
mod responses;
mod saved_address;
mod server;
mod session;
mod socket;
mod source;
mod sweep;
mod upload;

pub use launch::open_in_browser;
pub use saved_address::state_folder;
pub use server::{ExploreError, Explorer, ServerLimits, ServerOptions, Stopper};
pub use source::Source;

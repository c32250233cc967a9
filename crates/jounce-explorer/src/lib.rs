//! Interactive page: `jounce explore SPEC` serves it on this machine, and every curve on it follows
//! the sliders. [`study_page`] writes the charts of a study into a file that needs no server.
//!
//! # Contract
//!
//! One server belongs to one spec: a file, or a text without a file ([`Source`]). Its page holds
//! the design as a list of overrides (`key`, `value`, as in `--set`). The server reads requests,
//! calls the library ([`jounce::live`]) and sends frames; it computes nothing itself. Between
//! requests it stores only data that speed up the next response. Requests have the names of the
//! options of the library, such as `tolerance`, `starts` and `longest_period`; omitted options have
//! their defaults.
//!
//! ```text
//! GET /TOKEN/            the page; /TOKEN/app.js, /TOKEN/app.css, /TOKEN/icon.svg      nothing else is served
//! GET /TOKEN/socket      the websocket: requests in JSON, responses in binary frames
//!
//! request   {"id": 7, "ask": "response", "set": [["stop.tip.gap", "0.9 mm"]], "over": "drive.shaker.frequency", "from": 12, "to": 14}
//! frame     u32 length of the head, little endian | head, JSON, padded with spaces | Float64 arrays, little endian, 8-byte aligned
//! head      {"id": 7, "ask": "response", "stage": "coarse", ..., "arrays": [["parameter", 0, 120], ["power", 120, 120]]}
//! ```
//!
//! *Order.* Each socket runs one request of each kind. A new request of a kind cancels the previous
//! one: its computation ends within the integration of one period, unless another page has requested the
//! same and shares it; its response is never sent.
//! The first response over a key is preceded by `first` (the harvester without contact). Each response
//! is sent as `coarse` (branches continued from the orbits of the previous design), then as `fine`
//! (the search of `jounce branch`). Work that takes longer than
//! [`ServerLimits::max_computation_time`] is cancelled with a message; a search for a design may take
//! [`ServerLimits::max_search_time`].
//!
//! *Safety.* By default the server listens on the loopback interface. Every request and every
//! socket must have the token (128 random bits) in its path and a `Host` that names this server.
//! Where the browser sends an `Origin`, it must be this server. The browser receives the token
//! through a file that only its owner may read, never through the command line of a process. The
//! page runs under a content-security policy that permits no foreign content. Overrides may set
//! numbers only, never the path of a file. The page writes only these numbers, and only into the file of
//! its spec. Bodies, frames, sockets and computation time are
//! limited.
//!
//! *Return.* Port and token are saved in a file that only its owner may read. The next server of
//! the same spec uses them again, so a page that has lost its server reconnects.
//!
//! *Share.* The response of `export` has a [`Link`] with the changed keys, the axis and the spec, from which
//! another machine serves the same page. It holds neither address nor token.
//!
//! *Failure.* Faults of a design are returned by key, with the messages of the command line. If the
//! file changes, the server notifies the page, which repeats its requests.

mod handlers;
mod link;
mod server;
mod session;
mod source;
mod study_page;

pub use link::{Link, LinkError};
pub use server::{
    ExploreError, Explorer, ProxyOrigin, ServerLimits, ServerOptions, Stopper, open_in_browser,
    state_folder,
};
pub use source::Source;
pub use study_page::study_page;

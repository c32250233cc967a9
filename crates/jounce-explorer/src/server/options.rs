//! Options and limits of a server.

use super::ProxyOrigin;
use crate::source::Source;
use jounce::live::KeySpan;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::time::Duration;

/// Options of a server.
#[derive(Debug, Clone)]
pub struct ServerOptions {
    /// The spec.
    pub spec: Source,
    /// Initial overrides of the page, as in `--set`.
    pub set: Vec<(String, String)>,
    /// Initial axis of the page; by default the page chooses one.
    pub view: Option<KeySpan>,
    /// Other fields of a link, which the page reads.
    pub page: Vec<(String, String)>,
    /// Address to listen on; by default a free port of the loopback interface.
    pub listen: Option<SocketAddr>,
    /// Proxy through which browsers reach the server: requests to it, by its pages, are accepted too.
    pub proxy: Option<ProxyOrigin>,
    /// Allows pages of this machine, and of the proxy, to embed the page in a frame.
    pub frames: bool,
    /// Folder in which the address is saved for the next server of this file. Without it, or for a
    /// spec without a file, nothing is saved.
    pub state_folder: Option<PathBuf>,
    /// Limits.
    pub limits: ServerLimits,
}

/// Limits of a server.
#[derive(Debug, Clone)]
pub struct ServerLimits {
    /// Largest number of open pages.
    pub sockets: usize,
    /// Largest message from a page, bytes.
    pub message_bytes: usize,
    /// Longest time of one computation.
    pub max_computation_time: Duration,
    /// Longest time of a search for a design.
    pub max_search_time: Duration,
    /// Longest time in which a connection must send the headers of a request.
    pub max_header_time: Duration,
}

impl Default for ServerLimits {
    fn default() -> Self {
        Self {
            sockets: 64,
            message_bytes: 16 << 20,
            max_computation_time: Duration::from_secs(120),
            max_search_time: Duration::from_secs(600),
            max_header_time: Duration::from_secs(5),
        }
    }
}

//! Server of one spec at one address.

mod assets;
mod authenticator;
mod connections;
mod file_watch;
mod launch;
mod options;
mod proxy_origin;
mod saved_address;
mod socket;

pub use launch::open_in_browser;
pub use options::{ServerLimits, ServerOptions};
pub use proxy_origin::ProxyOrigin;
pub use saved_address::state_folder;

use crate::handlers::operating_point::OperatingPointKey;
use crate::handlers::response::{ResponseKey, SharedResponse};
use crate::session::shared::SharedComputations;
use assets::{refusal, serve};
use authenticator::{Authenticator, RequestRefusal};
use axum::Router;
use axum::extract::State;
use axum::extract::ws::WebSocketUpgrade;
use axum::extract::ws::rejection::WebSocketUpgradeRejection;
use axum::http::{HeaderMap, Method, StatusCode, Uri};
use axum::response::{IntoResponse as _, Redirect, Response};
use jounce::live::{Bandwidth, OperatingPoint};
use rayon::{ThreadPool, ThreadPoolBuilder};
use saved_address::SavedAddress;
use std::net::{Ipv4Addr, SocketAddr};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::{Semaphore, watch};

/// Short computations per core at the same time: some of them only wait until a slider rests.
const QUICK_PER_CORE: usize = 3;

/// Error of starting the server.
#[derive(Debug, thiserror::Error)]
pub enum ExploreError {
    /// The spec cannot be read.
    #[error(transparent)]
    Spec(jounce::Error),
    /// The server cannot listen on the address.
    #[error(
        "cannot listen on {address}: {cause}; give another --listen ADDRESS:PORT, or omit --listen for a free port of this machine"
    )]
    Address {
        /// The address.
        address: SocketAddr,
        /// Reason of the failure.
        cause: std::io::Error,
    },
    /// The system provides no random numbers or no threads.
    #[error("the server cannot be started: {0}")]
    System(String),
}

/// Server that is ready to run.
#[derive(Debug)]
pub struct Explorer {
    listener: std::net::TcpListener,
    address: SocketAddr,
    authenticator: Authenticator,
    options: ServerOptions,
    stop: watch::Sender<bool>,
}

/// Handle that stops a running server from any thread.
#[derive(Debug, Clone)]
pub struct Stopper(watch::Sender<bool>);

impl Stopper {
    /// Stops the server: pages are notified, computations cancelled.
    pub fn stop(&self) {
        self.0.send_replace(true);
    }
}

/// Data shared by all connections.
#[derive(Debug)]
pub struct Host {
    /// Authentication of requests.
    pub authenticator: Authenticator,
    /// Options of the server.
    pub options: ServerOptions,
    /// One permit for each further page.
    pub sockets: Arc<Semaphore>,
    /// One permit for each further computation that a page waits for.
    pub quick_permits: Arc<Semaphore>,
    /// One permit for each further operating point whose attractors are sought.
    pub operating_point_permits: Arc<Semaphore>,
    /// One permit for each further search for branches.
    pub branch_search_permits: Arc<Semaphore>,
    /// Threads of these searches: drafts of other pages do not wait for them.
    pub branch_search_pool: ThreadPool,
    /// Drafts and searched responses that several pages can share.
    pub responses: SharedComputations<ResponseKey, SharedResponse>,
    /// Bandwidths of searched responses.
    pub bandwidths: SharedComputations<ResponseKey, Option<Bandwidth>>,
    /// Attractors of operating points.
    pub operating_points: SharedComputations<OperatingPointKey, OperatingPoint>,
    /// One permit for each further computation of many integrations, which take all cores.
    pub long_permits: Arc<Semaphore>,
    /// Permits for searches for a design, of which one runs at a time.
    pub search_permits: Arc<Semaphore>,
    /// Count of the states of the file.
    pub versions: watch::Receiver<u64>,
    /// True when the server must stop.
    pub stop_signal: watch::Receiver<bool>,
}

impl Explorer {
    /// Reads the spec once, so that a missing file is reported at once, and binds the address. The
    /// page shows the faults of a spec.
    ///
    /// # Errors
    /// [`ExploreError`].
    pub fn bind(options: ServerOptions) -> Result<Self, ExploreError> {
        if let Err(error @ jounce::Error::Read(_)) = options.spec.read() {
            return Err(ExploreError::Spec(error));
        }
        let location = options.state_folder.as_deref().zip(options.spec.file());
        let last_address = location.and_then(|(folder, spec)| SavedAddress::read(folder, spec));
        let listener = listen(
            &options,
            last_address.as_ref().map(|last_address| last_address.port),
        )?;
        let address = listener
            .local_addr()
            .map_err(|error| ExploreError::System(error.to_string()))?;
        let previous_token = last_address
            .filter(|last_address| last_address.port == address.port())
            .map(|last_address| last_address.token);
        let authenticator = Authenticator::new(address, options.proxy.clone(), previous_token)
            .map_err(|error| ExploreError::System(error.to_string()))?;
        if let Some((folder, spec)) = location {
            // If this fails the page still works until the server stops.
            let _ = SavedAddress {
                port: address.port(),
                token: authenticator.token().to_owned(),
            }
            .write(folder, spec);
        }
        Ok(Self {
            listener,
            address,
            authenticator,
            options,
            stop: watch::Sender::new(false),
        })
    }

    /// Returns the address of the page, with its token.
    pub fn page(&self) -> String {
        let address = if self.address.ip().is_unspecified() {
            SocketAddr::from((Ipv4Addr::LOCALHOST, self.address.port()))
        } else {
            self.address
        };
        format!("http://{address}/{}/", self.authenticator.token())
    }

    /// Returns a handle that stops the server.
    pub fn stopper(&self) -> Stopper {
        Stopper(self.stop.clone())
    }

    /// Serves until it is stopped.
    ///
    /// # Errors
    /// [`ExploreError::System`].
    pub fn run(self) -> Result<(), ExploreError> {
        let system = |error: std::io::Error| ExploreError::System(error.to_string());
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .enable_all()
            .build()
            .map_err(system)?;
        let result = runtime.block_on(self.serve()).map_err(system);
        runtime.shutdown_timeout(Duration::from_secs(2));
        result
    }

    async fn serve(self) -> std::io::Result<()> {
        let cores = std::thread::available_parallelism().map_or(2, usize::from);
        let mut stop_signal = self.stop.subscribe();
        let max_header_time = self.options.limits.max_header_time;
        let host = Host {
            authenticator: self.authenticator,
            sockets: Arc::new(Semaphore::new(self.options.limits.sockets)),
            quick_permits: Arc::new(Semaphore::new(QUICK_PER_CORE * cores.max(2))),
            operating_point_permits: Arc::new(Semaphore::new(cores)),
            branch_search_permits: Arc::new(Semaphore::new(cores)),
            branch_search_pool: ThreadPoolBuilder::new()
                .build()
                .map_err(std::io::Error::other)?,
            responses: SharedComputations::default(),
            bandwidths: SharedComputations::default(),
            operating_points: SharedComputations::default(),
            long_permits: Arc::new(Semaphore::new(1)),
            search_permits: Arc::new(Semaphore::new(1)),
            versions: file_watch::start(self.options.spec.file().map(Path::to_path_buf)),
            stop_signal: self.stop.subscribe(),
            options: self.options,
        };
        let router = Router::new()
            .fallback(handle_request)
            .with_state(Arc::new(host));
        let listener = tokio::net::TcpListener::from_std(self.listener)?;
        // Connections that a browser leaves open would delay a graceful shutdown.
        tokio::select! {
            () = connections::serve(listener, router, max_header_time) => Ok(()),
            _ = stop_signal.wait_for(|stop_signal| *stop_signal) => {
                tokio::time::sleep(Duration::from_millis(100)).await;
                Ok(())
            }
        }
    }
}

/// Binds the requested address; by default the port of the previous server, or a free one.
fn listen(
    options: &ServerOptions,
    previous_port: Option<u16>,
) -> Result<std::net::TcpListener, ExploreError> {
    let loopback = |port| SocketAddr::from((Ipv4Addr::LOCALHOST, port));
    let requested_address = options.listen.unwrap_or_else(|| loopback(0));
    let previous_listener = previous_port
        .filter(|_| options.listen.is_none())
        .and_then(|port| std::net::TcpListener::bind(loopback(port)).ok());
    let listener =
        previous_listener.map_or_else(|| std::net::TcpListener::bind(requested_address), Ok);
    let listener = listener.and_then(|listener| listener.set_nonblocking(true).map(|()| listener));
    listener.map_err(|cause| ExploreError::Address {
        address: requested_address,
        cause,
    })
}

/// Handles every request; the path is compared with known names and opens no file.
async fn handle_request(
    State(host): State<Arc<Host>>,
    method: Method,
    uri: Uri,
    headers: HeaderMap,
    upgrade: Result<WebSocketUpgrade, WebSocketUpgradeRejection>,
) -> Response {
    let path = uri.path().strip_prefix('/').unwrap_or_default();
    let (token, name) = path.split_once('/').unwrap_or((path, ""));
    match host.authenticator.check(token, &headers, name == "socket") {
        Err(RequestRefusal::Host) => {
            return refusal(
                StatusCode::MISDIRECTED_REQUEST,
                "the request names another host; use the address that `jounce explore` printed",
            );
        }
        Err(RequestRefusal::Origin) => {
            return refusal(
                StatusCode::FORBIDDEN,
                "this server accepts requests of its own page only",
            );
        }
        Err(RequestRefusal::Token) => {
            return refusal(
                StatusCode::FORBIDDEN,
                "use the address that `jounce explore` printed, with its token",
            );
        }
        Ok(()) => {}
    }
    if method != Method::GET {
        return refusal(StatusCode::METHOD_NOT_ALLOWED, "only GET is allowed");
    }
    if !path.contains('/') {
        // Relative, since a proxy may have put a prefix before the path.
        return Redirect::permanent(&format!("{token}/")).into_response();
    }
    if name != "socket" {
        return serve(name, host.options.frames);
    }
    let Ok(upgrade) = upgrade else {
        return refusal(StatusCode::BAD_REQUEST, "this path needs a websocket");
    };
    let Ok(permit) = Arc::clone(&host.sockets).try_acquire_owned() else {
        return refusal(
            StatusCode::SERVICE_UNAVAILABLE,
            "too many pages are open; close one",
        );
    };
    let max_bytes = host.options.limits.message_bytes;
    upgrade
        .max_message_size(max_bytes)
        .max_frame_size(max_bytes)
        .on_upgrade(move |socket| async move {
            socket::serve_page(socket, host).await;
            drop(permit);
        })
}

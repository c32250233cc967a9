//! Live page of a harvester, served from a thread of this process.

use crate::conversion::failure::Failure;
use crate::input::spec::Spec;
use jounce_explorer::{
    ExploreError, Explorer as Server, ProxyOrigin, ServerLimits, ServerOptions, Source, Stopper,
    open_in_browser, state_folder,
};
use pyo3::prelude::*;
use std::any::Any;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

/// Time between two checks for Ctrl-C.
const POLL_INTERVAL: Duration = Duration::from_millis(20);

/// A running server.
#[pyclass(frozen, module = "jounce._core")]
pub struct Explorer {
    address: String,
    stopper: Stopper,
    running: Mutex<Option<JoinHandle<Result<(), ExploreError>>>>,
    /// File that leads the browser to the page; it is deleted with this value.
    page_file: Mutex<Option<Box<dyn Any + Send>>>,
}

#[pymethods]
impl Explorer {
    /// Serves a spec as it is, or a file with its later changes; `proxy` is the origin of a proxy.
    #[new]
    #[pyo3(signature = (*, spec = None, path = None, listen = None, proxy = None, frames = false))]
    fn new(
        spec: Option<&Spec>,
        path: Option<PathBuf>,
        listen: Option<&str>,
        proxy: Option<&str>,
        frames: bool,
    ) -> Result<Self, Failure> {
        let source = match (spec, path) {
            (Some(spec), None) => Source::Text {
                text: spec.harvester.text(),
                folder: spec.folder(),
            },
            (None, Some(path)) => Source::File(path),
            _ => {
                return Err(Failure::new(
                    "ArgumentError",
                    "give either a spec or the path of one",
                ));
            }
        };
        let message =
            |text: &str| format!("listen is \"{text}\"; write ADDRESS:PORT, as in 127.0.0.1:8080");
        let parse = |text: &str| {
            text.parse::<SocketAddr>()
                .map_err(|_| Failure::new("ArgumentError", message(text)))
        };
        let listen = listen.map(parse).transpose()?;
        let parse_proxy = |text: &str| {
            let message = format!(
                "proxy is at \"{text}\"; give the address that the browser shows, as in \
                https://hub.example.org/user/me/proxy/{{port}}/"
            );
            ProxyOrigin::parse(text).ok_or_else(|| Failure::new("ArgumentError", message))
        };
        let proxy = proxy.map(parse_proxy).transpose()?;
        let server = Server::bind(ServerOptions {
            spec: source,
            set: Vec::new(),
            view: None,
            page: Vec::new(),
            listen,
            proxy,
            frames,
            state_folder: state_folder(),
            limits: ServerLimits::default(),
        })?;
        let (address, stopper) = (server.page(), server.stopper());
        let running = Mutex::new(Some(std::thread::spawn(move || server.run())));
        Ok(Self {
            address,
            stopper,
            running,
            page_file: Mutex::new(None),
        })
    }

    /// Returns the address of the page, with its token.
    #[getter]
    fn address(&self) -> &str {
        &self.address
    }

    /// True while the page is served.
    #[getter]
    fn running(&self) -> bool {
        self.running
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .as_ref()
            .is_some_and(|thread| !thread.is_finished())
    }

    /// Opens the page in the browser.
    fn open(&self, py: Python<'_>) -> PyResult<()> {
        let file = py.detach(|| open_in_browser(&self.address))?;
        *self
            .page_file
            .lock()
            .unwrap_or_else(PoisonError::into_inner) = Some(Box::new(file));
        Ok(())
    }

    /// Stops the server; it may have stopped before.
    fn stop(&self, py: Python<'_>) -> PyResult<()> {
        self.stopper.stop();
        let thread_result = py.detach(|| {
            self.page_file
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .take();
            let thread = self
                .running
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .take();
            thread.map(JoinHandle::join)
        });
        match thread_result {
            Some(Ok(Err(error))) => Err(Failure::from(error).into_exception(py)),
            Some(Err(panic)) => std::panic::resume_unwind(panic),
            Some(Ok(Ok(()))) | None => Ok(()),
        }
    }

    /// Waits until the server has stopped; raises the exception of a signal.
    fn wait(&self, py: Python<'_>) -> PyResult<()> {
        while self.running() {
            py.detach(|| std::thread::sleep(POLL_INTERVAL));
            py.check_signals()?;
        }
        self.stop(py)
    }
}

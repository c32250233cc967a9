//! Session of one page: its requests, and data that speed up the next response.

pub(super) mod cancellation;
pub(super) mod fault;
pub(super) mod frame;
mod latest_requests;
pub(super) mod request;

use crate::handlers::export::export;
use crate::handlers::save::save;
use crate::handlers::{
    band, basins, design, design_search, excitation, load, operating_point, orbit, response,
    strain, sweep,
};
use crate::server::Host;
use cancellation::Cancellation;
use fault::RequestFault;
use frame::Frame;
use jounce::live::{Design, LiveAnalysis};
use latest_requests::LatestRequests;
use request::{Request, RequestKind};
use serde_json::json;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::{Semaphore, mpsc};

/// Session of a page.
pub struct Session {
    host: Arc<Host>,
    sender: mpsc::Sender<Vec<u8>>,
    latest_requests: LatestRequests,
    /// Computations, with data that speed up the next one.
    pub analysis: LiveAnalysis,
}

impl Session {
    /// Creates the session of a new page.
    pub fn new(host: Arc<Host>, sender: mpsc::Sender<Vec<u8>>) -> Self {
        Self {
            host,
            sender,
            latest_requests: LatestRequests::default(),
            analysis: LiveAnalysis::default(),
        }
    }

    /// Sends a frame.
    pub async fn send_async(&self, frame: Frame) {
        let _ = self.sender.send(frame.encode()).await;
    }

    /// Sends a frame from a computing thread, unless it is cancelled.
    pub fn send(&self, cancellation: &Cancellation, frame: Frame) {
        if !cancellation.is_stopped() {
            let _ = self.sender.blocking_send(frame.encode());
        }
    }

    /// Sends a frame that may be lost, such as progress.
    pub fn try_send(&self, cancellation: &Cancellation, frame: Frame) {
        if !cancellation.is_stopped() {
            let _ = self.sender.try_send(frame.encode());
        }
    }

    /// Sends the description of this server.
    pub async fn send_hello(&self) {
        let mut frame = Frame::new(0, "hello", "done");
        let options = &self.host.options;
        frame
            .put("file", options.spec.name().display().to_string())
            .put("set", json!(options.set))
            .put("view", json!(options.view))
            .put("jounce", env!("CARGO_PKG_VERSION"));
        self.send_async(frame).await;
    }

    /// Cancels all requests of the page.
    pub fn cancel_all(&self) {
        self.latest_requests.stop_all();
    }

    /// Returns the permits for which a request waits, and its longest time.
    fn share(&self, kind: &RequestKind) -> (&Arc<Semaphore>, Duration) {
        let (host, limits) = (&self.host, &self.host.options.limits);
        match kind {
            RequestKind::DesignSearch(_) => (&host.search_permits, limits.max_search_time),
            RequestKind::Sweep { .. }
            | RequestKind::Load(_)
            | RequestKind::Basins(_)
            | RequestKind::Band(_)
            | RequestKind::Shake { .. } => (&host.long_permits, limits.max_computation_time),
            _ => (&host.quick_permits, limits.max_computation_time),
        }
    }

    /// Handles a request.
    pub fn handle_request(self: &Arc<Self>, request: Request) {
        if let RequestKind::Stop { what } = &request.kind {
            return self.latest_requests.stop(what);
        }
        let cancellation = self.latest_requests.register(request.kind.name());
        let session = Arc::clone(self);
        tokio::spawn(async move {
            let (permits, max_time) = session.share(&request.kind);
            let Ok(_permit) = Arc::clone(permits).acquire_owned().await else {
                return;
            };
            if cancellation.is_stopped() {
                return;
            }
            let timeout_cancellation = cancellation.clone();
            let timer = tokio::spawn(async move {
                tokio::time::sleep(max_time).await;
                timeout_cancellation.stop_on_timeout();
            });
            let (id, name, removed) = (request.id, request.kind.name(), request.removed_keys());
            let (worker, worker_cancellation) = (Arc::clone(&session), cancellation.clone());
            let outcome =
                tokio::task::spawn_blocking(move || worker.compute(&request, &worker_cancellation))
                    .await;
            timer.abort();
            let fault = match outcome {
                _ if cancellation.is_timed_out() => Some(RequestFault::Text(format!(
                    "this took longer than {} s and was stopped; request less",
                    max_time.as_secs()
                ))),
                Ok(Ok(())) => None,
                Ok(Err(fault)) => Some(fault),
                Err(_) => Some(RequestFault::Text(
                    "the computation failed unexpectedly; please report the spec that caused it"
                        .to_owned(),
                )),
            };
            if let Some(fault) =
                fault.filter(|_| !cancellation.is_stopped() || cancellation.is_timed_out())
            {
                let mut frame = Frame::new(id, name, "fault");
                let path = session.host.options.spec.name();
                frame.put("faults", fault.list(path, &removed));
                session.send_async(frame).await;
            }
        });
    }

    fn compute(&self, request: &Request, cancellation: &Cancellation) -> Result<(), RequestFault> {
        let source = &self.host.options.spec;
        let design = &Design::new(&source.read()?, &request.set)?;
        let id = request.id;
        match &request.kind {
            RequestKind::Design => {
                self.send(cancellation, design::describe(id, design, source));
                Ok(())
            }
            RequestKind::Modes => {
                let mut frame = Frame::new(id, "modes", "done");
                frame.put("figures", json!(design.mode_figures()?));
                self.send(cancellation, frame);
                Ok(())
            }
            RequestKind::Response { span, options } => {
                response::respond(self, id, design, (span, options), cancellation)
            }
            RequestKind::Orbit(place) => orbit::respond(self, id, place, cancellation),
            RequestKind::Strain { response } => strain::respond(self, id, *response, cancellation),
            RequestKind::Sweep { span, points } => {
                sweep::respond(self, id, design, (span, *points), cancellation)
            }
            RequestKind::Load(options) => load::respond(self, id, design, options, cancellation),
            RequestKind::Basins(options) => {
                basins::respond(self, id, design, options, cancellation)
            }
            RequestKind::OperatingPoint(options) => {
                operating_point::respond(self, id, design, options, cancellation)
            }
            RequestKind::DesignOffer => {
                let frame = design::offer(self, id, design, cancellation)?;
                self.send(cancellation, frame);
                Ok(())
            }
            RequestKind::DesignSearch(fields) => {
                let problem = (fields, source.name());
                design_search::respond(self, id, design, problem, cancellation)
            }
            RequestKind::Band(options) => band::respond(self, id, design, options, cancellation),
            RequestKind::Shake { by } => excitation::respond(self, id, design, by, cancellation),
            RequestKind::Export(span) => {
                let frame = export(id, design, span, &request.set, source)?;
                self.send(cancellation, frame);
                Ok(())
            }
            RequestKind::Save { before } => {
                let frame = save(id, design, before, source)?;
                self.send(cancellation, frame);
                Ok(())
            }
            RequestKind::Stop { .. } => Ok(()),
        }
    }
}

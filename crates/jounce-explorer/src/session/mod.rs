//! Session of one page: its requests, and data that speed up the next response.

pub(super) mod blocking;
pub(super) mod cancellation;
pub(super) mod fault;
pub(super) mod frame;
mod latest_requests;
pub(super) mod request;
pub(super) mod shared;

use crate::handlers::export::export;
use crate::handlers::progress::progress;
use crate::handlers::save::save;
use crate::handlers::{
    aperiodic_motion, band, basins, branch_points, design, design_search, ensemble, excitation,
    load, operating_point, orbit, response, strain, sweep,
};
use crate::server::Host;
use blocking::Share;
use cancellation::Cancellation;
use fault::RequestFault;
use frame::Frame;
use jounce::Control;
use jounce::live::{Design, LiveAnalysis};
use latest_requests::LatestRequests;
use request::{Request, RequestKind};
use serde_json::json;
use shared::Computation;
use std::any::Any;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;
use tokio::sync::mpsc;

/// Session of a page.
pub struct Session {
    /// Data of all pages.
    pub host: Arc<Host>,
    sender: mpsc::Sender<Vec<u8>>,
    latest_requests: LatestRequests,
    /// Last shared computation of each stage: other pages find it.
    held: Mutex<HashMap<&'static str, Arc<dyn Any + Send + Sync>>>,
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
            held: Mutex::default(),
            analysis: LiveAnalysis::default(),
        }
    }

    /// Sends a frame.
    pub async fn send_async(&self, frame: Frame) {
        let _ = self.sender.send(frame.encode()).await;
    }

    /// Sends a frame, unless its request is cancelled.
    pub async fn send_unless_stopped(&self, cancellation: &Cancellation, frame: Frame) {
        if !cancellation.is_stopped() {
            self.send_async(frame).await;
        }
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
            .put("page", json!(options.page))
            .put("jounce", env!("CARGO_PKG_VERSION"));
        self.send_async(frame).await;
    }

    /// Cancels all requests of the page.
    pub fn cancel_all(&self) {
        self.latest_requests.stop_all();
    }

    /// Returns the share of the processors of short computations for which a page waits.
    pub fn quick_share(&self) -> Share {
        Share {
            permits: Arc::clone(&self.host.quick_permits),
            max_time: self.host.options.limits.max_computation_time,
        }
    }

    /// Returns the share of the processors of an operating point: drafts do not wait for it.
    pub fn operating_point_share(&self) -> Share {
        Share {
            permits: Arc::clone(&self.host.operating_point_permits),
            ..self.quick_share()
        }
    }

    /// Returns the share of the processors of a search for branches.
    pub fn branch_search_share(&self) -> Share {
        Share {
            permits: Arc::clone(&self.host.branch_search_permits),
            ..self.quick_share()
        }
    }

    /// Returns the share of the processors of a request.
    fn share(&self, kind: &RequestKind) -> Share {
        let host = &self.host;
        match kind {
            RequestKind::DesignSearch(_) => Share {
                permits: Arc::clone(&host.search_permits),
                max_time: host.options.limits.max_search_time,
            },
            RequestKind::Sweep { .. }
            | RequestKind::Load(_)
            | RequestKind::Basins(_)
            | RequestKind::Ensemble(_)
            | RequestKind::Band(_)
            | RequestKind::Shake { .. } => Share {
                permits: Arc::clone(&host.long_permits),
                ..self.quick_share()
            },
            _ => self.quick_share(),
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
            let (id, name, removed) = (request.id, request.kind.name(), request.removed_keys());
            let outcome = session.respond(request, &cancellation).await;
            if let Err(fault) = outcome
                && (!cancellation.is_stopped() || cancellation.is_timed_out())
            {
                let mut frame = Frame::new(id, name, "fault");
                let path = session.host.options.spec.name();
                frame.put("faults", fault.list(path, &removed));
                session.send_async(frame).await;
            }
        });
    }

    async fn respond(
        self: &Arc<Self>,
        request: Request,
        cancellation: &Cancellation,
    ) -> Result<(), RequestFault> {
        match request.kind {
            RequestKind::Response { .. } => response::respond(self, request, cancellation).await,
            RequestKind::OperatingPoint(_) => {
                operating_point::respond(self, request, cancellation).await
            }
            _ => {
                let (session, share) = (Arc::clone(self), self.share(&request.kind));
                let compute =
                    move |cancellation: &Cancellation| session.compute(&request, cancellation);
                let outcome = share.compute(cancellation, compute).await;
                outcome.unwrap_or(Ok(()))
            }
        }
    }

    /// Waits for a shared computation and sends its progress, then holds it for other pages until
    /// the next one of its stage; `None` where the request is cancelled first.
    pub async fn shared<T: Send + Sync + 'static>(
        &self,
        (id, kind, stage): (u64, &str, &'static str),
        computation: Arc<Computation<T>>,
        cancellation: &Cancellation,
    ) -> Result<Option<Arc<T>>, RequestFault> {
        let start_time = Instant::now();
        let report = |control: &Control| {
            if let Some(frame) = progress((id, kind), control, start_time) {
                self.try_send(cancellation, frame);
            }
        };
        let Some(outcome) = computation.result(cancellation, report).await else {
            return Ok(None);
        };
        let mut held = self.held.lock().unwrap_or_else(PoisonError::into_inner);
        held.insert(stage, computation);
        outcome.map(Some)
    }

    /// Returns the design of a request.
    pub fn design(&self, request: &Request) -> Result<Design, RequestFault> {
        Ok(Design::new(&self.host.options.spec.read()?, &request.set)?)
    }

    fn compute(&self, request: &Request, cancellation: &Cancellation) -> Result<(), RequestFault> {
        let source = &self.host.options.spec;
        let design = &self.design(request)?;
        let id = request.id;
        match &request.kind {
            RequestKind::Design { width, height } => {
                let room = (*width, *height);
                self.send(cancellation, design::describe(id, design, room, source));
                Ok(())
            }
            RequestKind::Modes => {
                let mut frame = Frame::new(id, "modes", "done");
                frame.put("figures", json!(design.mode_figures()?));
                self.send(cancellation, frame);
                Ok(())
            }
            RequestKind::Orbit(place) => orbit::respond(self, id, place, cancellation),
            RequestKind::AperiodicMotion(place) => {
                aperiodic_motion::respond(self, id, place, cancellation)
            }
            RequestKind::BranchPoints { response, orbits } => {
                branch_points::respond(self, id, *response, orbits, cancellation)
            }
            RequestKind::Strain { response } => strain::respond(self, id, *response, cancellation),
            RequestKind::Sweep { span, points } => {
                sweep::respond(self, id, design, (span, *points), cancellation)
            }
            RequestKind::Load(options) => load::respond(self, id, design, options, cancellation),
            RequestKind::Basins(options) => {
                basins::respond(self, id, design, options, cancellation)
            }
            RequestKind::Ensemble(options) => {
                ensemble::respond(self, id, design, options, cancellation)
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
            RequestKind::Export { span, page } => {
                let frame = export(id, design, span, &request.set, page, source)?;
                self.send(cancellation, frame);
                Ok(())
            }
            RequestKind::Save { before } => {
                let frame = save(id, design, before, source)?;
                self.send(cancellation, frame);
                Ok(())
            }
            // These three are handled before.
            RequestKind::Response { .. }
            | RequestKind::OperatingPoint(_)
            | RequestKind::Stop { .. } => Ok(()),
        }
    }
}

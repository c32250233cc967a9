//! Session of one page: its requests, and data that speed up the next response.

use crate::cancellation::Cancellation;
use crate::controls::controls;
use crate::design::{Design, DesignFault};
use crate::drawing::drawing;
use crate::frame::Frame;
use crate::latest_requests::LatestRequests;
use crate::linear::LastLinear;
use crate::request::{KeySpan, Request, RequestKind};
use crate::responses::{Responses, StoredResponse};
use crate::server::Host;
use crate::{basins, branches, excitation, load_sweep, orbit, sweep};
use jounce_core::analysis::{AnalysisError, Model};
use jounce_core::spec::Spec;
use jounce_core::structure::{BeamShape, shapes_along_beams};
use serde_json::json;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};
use tokio::sync::mpsc;

/// Number of positions along a beam at which its motion is drawn.
const BEAM_POSITIONS: usize = 49;

/// Shapes of the modes along each beam.
pub type Shapes = Arc<BTreeMap<String, BeamShape>>;

/// Session of a page.
pub struct Session {
    host: Arc<Host>,
    sender: mpsc::Sender<Vec<u8>>,
    latest_requests: LatestRequests,
    last_model: Mutex<Option<Arc<Model>>>,
    shapes: Mutex<Option<(Spec, Shapes)>>,
    /// Responses sent so far.
    pub responses: Responses,
    /// Last curve of the harvester without contact.
    pub linear: LastLinear,
}

impl Session {
    /// Creates the session of a new page.
    pub fn new(host: Arc<Host>, sender: mpsc::Sender<Vec<u8>>) -> Self {
        let (last_model, shapes) = (Mutex::new(None), Mutex::new(None));
        Self {
            host,
            sender,
            latest_requests: LatestRequests::default(),
            last_model,
            shapes,
            responses: Responses::default(),
            linear: LastLinear::default(),
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
            .put("jounce", env!("CARGO_PKG_VERSION"));
        self.send_async(frame).await;
    }

    /// Cancels all requests of the page.
    pub fn cancel_all(&self) {
        self.latest_requests.stop_all();
    }

    /// Handles a request.
    pub fn handle_request(self: &Arc<Self>, request: Request) {
        if let RequestKind::Stop { what } = &request.kind {
            return self.latest_requests.stop(what);
        }
        let cancellation = self.latest_requests.register(request.kind.name());
        let session = Arc::clone(self);
        tokio::spawn(async move {
            let is_long = matches!(
                request.kind,
                RequestKind::Sweep { .. }
                    | RequestKind::Load { .. }
                    | RequestKind::Basins { .. }
                    | RequestKind::Shake { .. }
            );
            let permits = if is_long {
                &session.host.long_permits
            } else {
                &session.host.quick_permits
            };
            let Ok(_permit) = Arc::clone(permits).acquire_owned().await else {
                return;
            };
            if cancellation.is_stopped() {
                return;
            }
            let max_time = session.host.options.limits.max_computation_time;
            let timeout_cancellation = cancellation.clone();
            let timer = tokio::spawn(async move {
                tokio::time::sleep(max_time).await;
                timeout_cancellation.stop_on_timeout();
            });
            let (id, name) = (request.id, request.kind.name());
            let (worker, worker_cancellation) = (Arc::clone(&session), cancellation.clone());
            let outcome =
                tokio::task::spawn_blocking(move || worker.compute(&request, &worker_cancellation))
                    .await;
            timer.abort();
            let fault = match outcome {
                _ if cancellation.is_timed_out() => Some(DesignFault::Text(format!(
                    "this took longer than {} s and was stopped; request less",
                    max_time.as_secs()
                ))),
                Ok(Ok(())) => None,
                Ok(Err(fault)) => Some(fault),
                Err(_) => Some(DesignFault::Text(
                    "the computation failed unexpectedly; please report the spec that caused it"
                        .to_owned(),
                )),
            };
            if let Some(fault) =
                fault.filter(|_| !cancellation.is_stopped() || cancellation.is_timed_out())
            {
                let mut frame = Frame::new(id, name, "fault");
                frame.put("faults", fault.fault_list(session.host.options.spec.name()));
                session.send_async(frame).await;
            }
        });
    }

    fn compute(&self, request: &Request, cancellation: &Cancellation) -> Result<(), DesignFault> {
        let design = Design::read(&self.host.options.spec, &request.set)?;
        let id = request.id;
        match &request.kind {
            RequestKind::Design => {
                let mut frame = Frame::new(id, "design", "done");
                let title = self
                    .host
                    .options
                    .spec
                    .name()
                    .file_stem()
                    .unwrap_or_default()
                    .to_string_lossy()
                    .into_owned();
                frame
                    .put("drawing", drawing(&title, &design))
                    .put("controls", controls(&design));
                frame.put(
                    "drives",
                    design.spec.drive.keys().cloned().collect::<Vec<_>>(),
                );
                self.send(cancellation, frame);
                Ok(())
            }
            RequestKind::Response(span) => branches::respond(self, id, design, span, cancellation),
            RequestKind::Orbit {
                response,
                branch,
                point,
            } => orbit::respond(self, id, (*response, *branch, *point), cancellation),
            RequestKind::Sweep { range, points } => {
                sweep::respond(self, id, &design, range, *points, cancellation)
            }
            RequestKind::Load { over, points } => {
                load_sweep::respond(self, id, &design, over, *points, cancellation)
            }
            RequestKind::Basins { side } => basins::respond(self, id, &design, *side, cancellation),
            RequestKind::Shake { by } => excitation::respond(
                self,
                id,
                &design,
                by,
                self.host.options.spec.folder(),
                cancellation,
            ),
            RequestKind::Export(span) => {
                self.send(cancellation, self.export(id, &design, span, &request.set)?);
                Ok(())
            }
            RequestKind::Stop { .. } => Ok(()),
        }
    }

    /// Sends the spec as text, and the commands that give the response on the screen.
    fn export(
        &self,
        id: u64,
        design: &Design,
        span: &KeySpan,
        set: &[(String, String)],
    ) -> Result<Frame, DesignFault> {
        let key = design.range(&span.over, span.from, span.to)?;
        let path = self.host.options.spec.name().display().to_string();
        let range = format!("{}:{}", key.show(span.from), key.show(span.to));
        let set_options: String = set
            .iter()
            .map(|(key, value)| format!(" --set {}", shell_quoted(&format!("{key}={value}"))))
            .collect();
        let shell = format!(
            "jounce branch {} --over {}{set_options}",
            shell_quoted(&path),
            shell_quoted(&format!("{}={range}", key.path()))
        );
        let changes: String = set
            .iter()
            .map(|(key, value)| format!("harvester[{key:?}] = {value:?}\n"))
            .collect();
        let python = format!(
            "import jounce\n\nharvester = jounce.read({path:?})\n{changes}print(harvester.branch({:?}, {range:?}))\n",
            key.path()
        );
        let mut frame = Frame::new(id, "export", "done");
        frame
            .put("spec", design.file.text())
            .put("shell", shell)
            .put("python", python);
        Ok(frame)
    }

    /// Returns the model of a design under a control; parts shared with the previous model are
    /// reused.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn model(&self, spec: &Spec, cancellation: &Cancellation) -> Result<Model, AnalysisError> {
        let previous = self
            .last_model
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone();
        let model = match previous {
            Some(previous) if previous.spec == *spec => previous,
            previous => {
                let model = Arc::new(match previous {
                    Some(previous) => previous.changed(spec.clone())?,
                    None => Model::new(spec.clone())?,
                });
                *self
                    .last_model
                    .lock()
                    .unwrap_or_else(PoisonError::into_inner) = Some(Arc::clone(&model));
                model
            }
        };
        model.with_control(cancellation.control())
    }

    /// Returns the shapes of the modes along the beams of a design.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn shapes(&self, spec: &Spec) -> Result<Shapes, AnalysisError> {
        let has_same_shapes = |cached_spec: &Spec| {
            (
                &cached_spec.beam,
                &cached_spec.patch,
                &cached_spec.mass,
                &cached_spec.modal,
            ) == (&spec.beam, &spec.patch, &spec.mass, &spec.modal)
                && cached_spec.reduction == spec.reduction
        };
        let mut cached = self.shapes.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, shapes)) = cached
            .as_ref()
            .filter(|(cached_spec, _)| has_same_shapes(cached_spec))
        {
            return Ok(Arc::clone(shapes));
        }
        let shapes = Arc::new(shapes_along_beams(spec, &[], BEAM_POSITIONS)?);
        *cached = Some((spec.clone(), Arc::clone(&shapes)));
        Ok(shapes)
    }

    /// Returns an earlier response.
    ///
    /// # Errors
    /// [`DesignFault::Text`] where it is too old.
    pub fn stored_response(&self, id: u64) -> Result<Arc<StoredResponse>, DesignFault> {
        self.responses.find(id).ok_or_else(|| {
            DesignFault::Text(
                "this response is no longer stored; move a slider to compute it again".to_owned(),
            )
        })
    }
}

/// Quotes one word of a shell line.
fn shell_quoted(word: &str) -> String {
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "=./:_-".contains(letter);
    if word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_a_shell_line_are_quoted() {
        assert_eq!(shell_quoted("examples/a.toml"), "examples/a.toml");
        assert_eq!(shell_quoted("stop.tip.gap=0.5 mm"), "'stop.tip.gap=0.5 mm'");
        assert_eq!(shell_quoted("a'; rm"), "'a'\\''; rm'");
    }
}

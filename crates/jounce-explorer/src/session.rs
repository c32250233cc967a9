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
const PLACES: usize = 49;

/// Shapes of the modes along each beam.
pub type Shapes = Arc<BTreeMap<String, BeamShape>>;

/// Session of a page.
pub struct Session {
    host: Arc<Host>,
    out: mpsc::Sender<Vec<u8>>,
    lanes: LatestRequests,
    base: Mutex<Option<Arc<Model>>>,
    shapes: Mutex<Option<(Spec, Shapes)>>,
    /// Responses sent so far.
    pub answers: Responses,
    /// Last curve of the harvester without contact.
    pub linear: LastLinear,
}

impl Session {
    /// Creates the session of a new page.
    pub fn new(host: Arc<Host>, out: mpsc::Sender<Vec<u8>>) -> Self {
        let (base, shapes) = (Mutex::new(None), Mutex::new(None));
        Self {
            host,
            out,
            lanes: LatestRequests::default(),
            base,
            shapes,
            answers: Responses::default(),
            linear: LastLinear::default(),
        }
    }

    /// Sends a frame.
    pub async fn tell(&self, frame: Frame) {
        let _ = self.out.send(frame.encode()).await;
    }

    /// Sends a frame from a computing thread, unless it is cancelled.
    pub fn send(&self, cancellation: &Cancellation, frame: Frame) {
        if !cancellation.is_stopped() {
            let _ = self.out.blocking_send(frame.encode());
        }
    }

    /// Sends a frame that may be lost, such as progress.
    pub fn hint(&self, cancellation: &Cancellation, frame: Frame) {
        if !cancellation.is_stopped() {
            let _ = self.out.try_send(frame.encode());
        }
    }

    /// Sends the description of this server.
    pub async fn greet(&self) {
        let mut frame = Frame::new(0, "hello", "done");
        let options = &self.host.options;
        frame
            .put("file", options.spec.name().display().to_string())
            .put("set", json!(options.set))
            .put("jounce", env!("CARGO_PKG_VERSION"));
        self.tell(frame).await;
    }

    /// Cancels all requests of the page.
    pub fn end(&self) {
        self.lanes.stop_all();
    }

    /// Handles a request.
    pub fn ask(self: &Arc<Self>, request: Request) {
        if let RequestKind::Stop { what } = &request.ask {
            return self.lanes.stop(what);
        }
        let cancellation = self.lanes.enter(request.ask.name());
        let session = Arc::clone(self);
        tokio::spawn(async move {
            let is_long = matches!(
                request.ask,
                RequestKind::Sweep { .. }
                    | RequestKind::Load { .. }
                    | RequestKind::Basins { .. }
                    | RequestKind::Shake { .. }
            );
            let permits = if is_long {
                &session.host.long
            } else {
                &session.host.quick
            };
            let Ok(_permit) = Arc::clone(permits).acquire_owned().await else {
                return;
            };
            if cancellation.is_stopped() {
                return;
            }
            let longest = session.host.options.limits.longest;
            let late = cancellation.clone();
            let timer = tokio::spawn(async move {
                tokio::time::sleep(longest).await;
                late.stop_late();
            });
            let (id, name) = (request.id, request.ask.name());
            let (worker, wish) = (Arc::clone(&session), cancellation.clone());
            let done = tokio::task::spawn_blocking(move || worker.work(&request, &wish)).await;
            timer.abort();
            let wrong = match done {
                _ if cancellation.is_late() => Some(DesignFault::Text(format!(
                    "this took longer than {} s and was stopped; request less",
                    longest.as_secs()
                ))),
                Ok(Ok(())) => None,
                Ok(Err(wrong)) => Some(wrong),
                Err(_) => Some(DesignFault::Text(
                    "the computation failed unexpectedly; please report the spec that caused it"
                        .to_owned(),
                )),
            };
            if let Some(wrong) =
                wrong.filter(|_| !cancellation.is_stopped() || cancellation.is_late())
            {
                let mut frame = Frame::new(id, name, "fault");
                frame.put("faults", wrong.listed(session.host.options.spec.name()));
                session.tell(frame).await;
            }
        });
    }

    fn work(&self, request: &Request, cancellation: &Cancellation) -> Result<(), DesignFault> {
        let design = Design::read(&self.host.options.spec, &request.set)?;
        let id = request.id;
        match &request.ask {
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
            RequestKind::Response(over) => branches::respond(self, id, design, over, cancellation),
            RequestKind::Orbit {
                answer,
                branch,
                point,
            } => orbit::respond(self, id, (*answer, *branch, *point), cancellation),
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
            RequestKind::Export(over) => {
                self.send(cancellation, self.export(id, &design, over, &request.set)?);
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
        over: &KeySpan,
        set: &[(String, String)],
    ) -> Result<Frame, DesignFault> {
        let key = design.range(&over.over, over.from, over.to)?;
        let path = self.host.options.spec.name().display().to_string();
        let range = format!("{}:{}", key.show(over.from), key.show(over.to));
        let sets: String = set
            .iter()
            .map(|(key, value)| format!(" --set {}", quoted(&format!("{key}={value}"))))
            .collect();
        let shell = format!(
            "jounce branch {} --over {}{sets}",
            quoted(&path),
            quoted(&format!("{}={range}", key.path()))
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
    pub fn prepared(
        &self,
        spec: &Spec,
        cancellation: &Cancellation,
    ) -> Result<Model, AnalysisError> {
        let before = self
            .base
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone();
        let prepared = match before {
            Some(before) if before.spec == *spec => before,
            before => {
                let prepared = Arc::new(match before {
                    Some(before) => before.changed(spec.clone())?,
                    None => Model::new(spec.clone())?,
                });
                *self.base.lock().unwrap_or_else(PoisonError::into_inner) =
                    Some(Arc::clone(&prepared));
                prepared
            }
        };
        prepared.with_control(cancellation.control())
    }

    /// Returns the shapes of the modes along the beams of a design.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn shapes(&self, spec: &Spec) -> Result<Shapes, AnalysisError> {
        let same = |known: &Spec| {
            (&known.beam, &known.patch, &known.mass, &known.modal)
                == (&spec.beam, &spec.patch, &spec.mass, &spec.modal)
                && known.reduction == spec.reduction
        };
        let mut kept = self.shapes.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, shapes)) = kept.as_ref().filter(|(known, _)| same(known)) {
            return Ok(Arc::clone(shapes));
        }
        let shapes = Arc::new(shapes_along_beams(spec, &[], PLACES)?);
        *kept = Some((spec.clone(), Arc::clone(&shapes)));
        Ok(shapes)
    }

    /// Returns an earlier response.
    ///
    /// # Errors
    /// [`DesignFault::Text`] where it is too old.
    pub fn answered(&self, id: u64) -> Result<Arc<StoredResponse>, DesignFault> {
        self.answers.find(id).ok_or_else(|| {
            DesignFault::Text(
                "this response is no longer stored; move a slider to compute it again".to_owned(),
            )
        })
    }
}

/// Quotes one word of a shell line.
fn quoted(word: &str) -> String {
    let plain = |letter: char| letter.is_ascii_alphanumeric() || "=./:_-".contains(letter);
    if word.chars().all(plain) {
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
        assert_eq!(quoted("examples/a.toml"), "examples/a.toml");
        assert_eq!(quoted("stop.tip.gap=0.5 mm"), "'stop.tip.gap=0.5 mm'");
        assert_eq!(quoted("a'; rm"), "'a'\\''; rm'");
    }
}

//! What one page has asked for, and what makes its next answer faster.

use crate::answers::{Answered, Answers};
use crate::controls::controls;
use crate::design::{Design, Wrong};
use crate::drawing::drawing;
use crate::frame::Frame;
use crate::halt::Halt;
use crate::lanes::Lanes;
use crate::linear::LastLinear;
use crate::request::{Ask, Over, Request};
use crate::server::Host;
use crate::{basins, branches, load, orbit, shake, sweep};
use jounce::spec::Spec;
use jounce::structure::{BeamShape, shapes_along_beams};
use jounce::study::{Prepared, StudyError};
use serde_json::json;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};
use tokio::sync::mpsc;

/// Places along a beam at which it is drawn in motion.
const PLACES: usize = 49;

/// Shapes of the modes along each beam.
pub type Shapes = Arc<BTreeMap<String, BeamShape>>;

/// A page.
pub struct Session {
    host: Arc<Host>,
    out: mpsc::Sender<Vec<u8>>,
    lanes: Lanes,
    base: Mutex<Option<Arc<Prepared>>>,
    shapes: Mutex<Option<(Spec, Shapes)>>,
    /// Responses given so far.
    pub answers: Answers,
    /// The last curve of the harvester that never strikes.
    pub linear: LastLinear,
}

impl Session {
    /// A page that has asked nothing.
    pub fn new(host: Arc<Host>, out: mpsc::Sender<Vec<u8>>) -> Self {
        let (base, shapes) = (Mutex::new(None), Mutex::new(None));
        Self { host, out, lanes: Lanes::default(), base, shapes, answers: Answers::default(), linear: LastLinear::default() }
    }

    /// Sends a frame.
    pub async fn tell(&self, frame: Frame) {
        let _ = self.out.send(frame.encode()).await;
    }

    /// Sends a frame from a thread that computes, unless nobody waits for it any more.
    pub fn send(&self, halt: &Halt, frame: Frame) {
        if !halt.is_stopped() {
            let _ = self.out.blocking_send(frame.encode());
        }
    }

    /// Sends a frame that may be lost: progress.
    pub fn hint(&self, halt: &Halt, frame: Frame) {
        if !halt.is_stopped() {
            let _ = self.out.try_send(frame.encode());
        }
    }

    /// Says what this server is about.
    pub async fn greet(&self) {
        let mut frame = Frame::new(0, "hello", "done");
        let options = &self.host.options;
        frame
            .put("file", options.spec.name().display().to_string())
            .put("set", json!(options.set))
            .put("jounce", env!("CARGO_PKG_VERSION"));
        self.tell(frame).await;
    }

    /// Stops everything that the page asked for.
    pub fn end(&self) {
        self.lanes.stop_all();
    }

    /// Takes a request.
    pub fn ask(self: &Arc<Self>, request: Request) {
        if let Ask::Stop { what } = &request.ask {
            return self.lanes.stop(what);
        }
        let halt = self.lanes.enter(request.ask.name());
        let session = Arc::clone(self);
        tokio::spawn(async move {
            let is_long = matches!(request.ask, Ask::Sweep { .. } | Ask::Load { .. } | Ask::Basins { .. } | Ask::Shake { .. });
            let permits = if is_long { &session.host.long } else { &session.host.quick };
            let Ok(_permit) = Arc::clone(permits).acquire_owned().await else { return };
            if halt.is_stopped() {
                return;
            }
            let longest = session.host.options.limits.longest;
            let late = halt.clone();
            let timer = tokio::spawn(async move {
                tokio::time::sleep(longest).await;
                late.stop_late();
            });
            let (id, name) = (request.id, request.ask.name());
            let (worker, wish) = (Arc::clone(&session), halt.clone());
            let done = tokio::task::spawn_blocking(move || worker.work(&request, &wish)).await;
            timer.abort();
            let wrong = match done {
                _ if halt.is_late() => {
                    Some(Wrong::Text(format!("this took longer than {} s and was stopped; ask for less", longest.as_secs())))
                }
                Ok(Ok(())) => None,
                Ok(Err(wrong)) => Some(wrong),
                Err(_) => Some(Wrong::Text("the computation broke off; please report the spec that did it".to_owned())),
            };
            if let Some(wrong) = wrong.filter(|_| !halt.is_stopped() || halt.is_late()) {
                let mut frame = Frame::new(id, name, "fault");
                frame.put("faults", wrong.listed(session.host.options.spec.name()));
                session.tell(frame).await;
            }
        });
    }

    fn work(&self, request: &Request, halt: &Halt) -> Result<(), Wrong> {
        let design = Design::read(&self.host.options.spec, &request.set)?;
        let id = request.id;
        match &request.ask {
            Ask::Design => {
                let mut frame = Frame::new(id, "design", "done");
                let title = self.host.options.spec.name().file_stem().unwrap_or_default().to_string_lossy().into_owned();
                frame.put("drawing", drawing(&title, &design)).put("controls", controls(&design));
                frame.put("drives", design.spec.drive.keys().cloned().collect::<Vec<_>>());
                self.send(halt, frame);
                Ok(())
            }
            Ask::Response(over) => branches::respond(self, id, design, over, halt),
            Ask::Orbit { answer, branch, point } => orbit::respond(self, id, (*answer, *branch, *point), halt),
            Ask::Sweep { range, points } => sweep::respond(self, id, &design, range, *points, halt),
            Ask::Load { over, points } => load::respond(self, id, &design, over, *points, halt),
            Ask::Basins { side } => basins::respond(self, id, &design, *side, halt),
            Ask::Shake { by } => shake::respond(self, id, &design, by, self.host.options.spec.folder(), halt),
            Ask::Export(over) => {
                self.send(halt, self.export(id, &design, over, &request.set)?);
                Ok(())
            }
            Ask::Stop { .. } => Ok(()),
        }
    }

    /// The spec as text, and the lines that give the response on the screen.
    fn export(&self, id: u64, design: &Design, over: &Over, set: &[(String, String)]) -> Result<Frame, Wrong> {
        let key = design.range(&over.over, over.from, over.to)?;
        let path = self.host.options.spec.name().display().to_string();
        let range = format!("{}:{}", key.show(over.from), key.show(over.to));
        let sets: String = set.iter().map(|(key, value)| format!(" --set {}", quoted(&format!("{key}={value}")))).collect();
        let shell = format!("jounce branch {} --over {}{sets}", quoted(&path), quoted(&format!("{}={range}", key.path())));
        let changes: String = set.iter().map(|(key, value)| format!("harvester[{key:?}] = {value:?}\n")).collect();
        let python =
            format!("import jounce\n\nharvester = jounce.read({path:?})\n{changes}print(harvester.branch({:?}, {range:?}))\n", key.path());
        let mut frame = Frame::new(id, "export", "done");
        frame.put("spec", design.file.text()).put("shell", shell).put("python", python);
        Ok(frame)
    }

    /// A design ready to be computed under a watch; what the one before shares with it is kept.
    ///
    /// # Errors
    /// [`StudyError`].
    pub fn prepared(&self, spec: &Spec, halt: &Halt) -> Result<Prepared, StudyError> {
        let before = self.base.lock().unwrap_or_else(PoisonError::into_inner).clone();
        let prepared = match before {
            Some(before) if before.spec == *spec => before,
            before => {
                let prepared = Arc::new(match before {
                    Some(before) => before.changed(spec.clone())?,
                    None => Prepared::new(spec.clone())?,
                });
                *self.base.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::clone(&prepared));
                prepared
            }
        };
        prepared.watched_by(halt.watch())
    }

    /// Shapes of the modes along the beams of a design.
    ///
    /// # Errors
    /// [`StudyError`].
    pub fn shapes(&self, spec: &Spec) -> Result<Shapes, StudyError> {
        let same = |known: &Spec| {
            (&known.beam, &known.patch, &known.mass, &known.modal) == (&spec.beam, &spec.patch, &spec.mass, &spec.modal)
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

    /// A response given before.
    ///
    /// # Errors
    /// [`Wrong::Text`] where it is too old.
    pub fn answered(&self, id: u64) -> Result<Arc<Answered>, Wrong> {
        self.answers.find(id).ok_or_else(|| Wrong::Text("this response is no longer kept; move a slider to compute it again".to_owned()))
    }
}

/// One word of a shell line.
fn quoted(word: &str) -> String {
    let plain = |letter: char| letter.is_ascii_alphanumeric() || "=./:_-".contains(letter);
    if word.chars().all(plain) { word.to_owned() } else { format!("'{}'", word.replace('\'', "'\\''")) }
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

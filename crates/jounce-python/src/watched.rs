//! A computation without the interpreter's lock, while somebody looks for Ctrl-C and tells how far it is: on a thread of its own, with
//! Python's own thread waiting for it, or, where a thread would cost more than the work, on Python's own thread, which looks in between.

use jounce::march::Watch;
use pyo3::prelude::*;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::failure::Failure;

/// Time between two looks for Ctrl-C.
const LOOK: Duration = Duration::from_millis(20);

/// Time between two calls of `progress`.
const TELL: Duration = Duration::from_millis(100);

/// Runs `work` with the interpreter's lock released. The second value is what ended it early: `KeyboardInterrupt`, or the exception of
/// `progress`, which is called with parts done, parts in all and seconds left.
pub fn watched<T: Send>(py: Python<'_>, progress: Option<&Bound<'_, PyAny>>, work: impl FnOnce(&Watch) -> T + Send) -> (T, Option<PyErr>) {
    let watch = Watch::default();
    let (sender, mut receiver) = channel::<()>();
    let mut teller = Teller::new(progress.map(|progress| progress.clone().unbind()));
    std::thread::scope(|scope| {
        let inside = watch.clone();
        let worker = scope.spawn(move || {
            let answer = work(&inside);
            let _ = sender.send(());
            answer
        });
        let mut ended = None;
        loop {
            let heard;
            (receiver, heard) = py.detach(move || {
                let heard = receiver.recv_timeout(LOOK);
                (receiver, heard)
            });
            let waits = heard == Err(RecvTimeoutError::Timeout);
            if ended.is_none() {
                ended = py.check_signals().and_then(|()| teller.tell(py, &watch, !waits)).err();
            }
            if !waits {
                break;
            }
            if ended.is_some() {
                watch.stop();
            }
        }
        match worker.join() {
            Ok(answer) => (answer, ended),
            Err(panic) => std::panic::resume_unwind(panic),
        }
    })
}

/// The same for work that takes long in parts without a look of their own. All that it needs belongs to it: at Ctrl-C it is left to itself, and
/// what it gives is thrown away.
pub fn left_alone<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&Watch) -> Result<T, Failure> + Send + 'static,
) -> (Result<T, Failure>, Option<PyErr>) {
    let watch = Watch::default();
    let inside = watch.clone();
    let (sender, mut receiver) = channel();
    let worker = std::thread::spawn(move || sender.send(work(&inside)));
    loop {
        let heard;
        (receiver, heard) = py.detach(move || {
            let heard = receiver.recv_timeout(LOOK);
            (receiver, heard)
        });
        match heard {
            Ok(answer) => return (answer, None),
            Err(RecvTimeoutError::Timeout) => {
                if let Err(ended) = py.check_signals() {
                    watch.stop();
                    return (Err(Failure::stopped()), Some(ended));
                }
            }
            Err(RecvTimeoutError::Disconnected) => match worker.join() {
                Ok(_) => return (Err(Failure::stopped()), None),
                Err(panic) => std::panic::resume_unwind(panic),
            },
        }
    }
}

/// The same on this thread, for one march: it is over before another thread would have begun, or lets somebody look in between its steps.
pub fn visited<T: Send>(py: Python<'_>, progress: Option<&Bound<'_, PyAny>>, work: impl FnOnce(&Watch) -> T + Send) -> (T, Option<PyErr>) {
    let visit =
        Arc::new(Mutex::new(Visit { looked: Instant::now(), ended: None, teller: Teller::new(progress.map(|own| own.clone().unbind())) }));
    let inside = Arc::clone(&visit);
    let watch = Watch::visited_by(move |watch| inside.lock().unwrap_or_else(PoisonError::into_inner).look(watch));
    let answer = py.detach(|| work(&watch));
    let mut visit = visit.lock().unwrap_or_else(PoisonError::into_inner);
    let ended = visit.ended.take().or_else(|| py.check_signals().and_then(|()| visit.teller.tell(py, &watch, true)).err());
    (answer, ended)
}

/// A look from within the work.
struct Visit {
    looked: Instant,
    ended: Option<PyErr>,
    teller: Teller,
}

impl Visit {
    fn look(&mut self, watch: &Watch) {
        if self.ended.is_some() || self.looked.elapsed() < LOOK {
            return;
        }
        self.ended = Python::attach(|py| py.check_signals().and_then(|()| self.teller.tell(py, watch, false))).err();
        if self.ended.is_some() {
            watch.stop();
        }
        self.looked = Instant::now();
    }
}

/// Tells Python how far the work is.
struct Teller {
    progress: Option<Py<PyAny>>,
    begun: Instant,
    told: Instant,
    last: (u64, u64),
}

impl Teller {
    fn new(progress: Option<Py<PyAny>>) -> Self {
        Self { progress, begun: Instant::now(), told: Instant::now(), last: (0, 0) }
    }

    fn tell(&mut self, py: Python<'_>, watch: &Watch, at_the_end: bool) -> PyResult<()> {
        let Some(progress) = &self.progress else { return Ok(()) };
        // What it answers is read at the next look.
        watch.ask_time();
        let now = watch.progress();
        let due = at_the_end || self.told.elapsed() >= TELL;
        if now == self.last || !due {
            return Ok(());
        }
        (self.last, self.told) = (now, Instant::now());
        let (done, expected) = now;
        // Without a known end there is nothing left to estimate.
        let left_s =
            (done > 0 && expected > 0).then(|| self.begun.elapsed().as_secs_f64() * expected.saturating_sub(done) as f64 / done as f64);
        progress.call1(py, (done, expected, left_s)).map(|_| ())
    }
}

/// Runs `work` on a pool of its own: the shared one does not survive a `fork`.
pub fn on_threads<T: Send>(threads: Option<usize>, work: impl FnOnce() -> Result<T, Failure> + Send) -> Result<T, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).build();
    pool.map_err(|error| Failure::new("JounceError", format!("the threads cannot be started: {error}")))?.install(work)
}

/// An answer for Python, and what ended it early. Where that left no answer at all, only the latter counts.
pub fn handed<'py, T>(
    py: Python<'py>,
    (answer, ended): (Result<T, Failure>, Option<PyErr>),
    told: impl FnOnce(T) -> PyResult<Bound<'py, pyo3::types::PyDict>>,
) -> PyResult<(Option<Bound<'py, pyo3::types::PyDict>>, Option<PyErr>)> {
    match (answer, ended) {
        (Ok(answer), ended) => Ok((Some(told(answer)?), ended)),
        (Err(_), Some(ended)) => Ok((None, Some(ended))),
        (Err(failure), None) => Err(failure.raised(py)),
    }
}

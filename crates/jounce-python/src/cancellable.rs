//! Computation without the lock of the interpreter, with checks for Ctrl-C and progress reports.
//! The work runs on its own thread while the thread of Python waits; where a thread would cost more
//! than the work, it runs on the thread of Python, which checks between steps.

use jounce_core::integrate::Control;
use pyo3::prelude::*;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::failure::Failure;

/// Time between two checks for Ctrl-C.
const POLL_INTERVAL: Duration = Duration::from_millis(20);

/// Time between two calls of `progress`.
const REPORT_INTERVAL: Duration = Duration::from_millis(100);

/// Runs `work` with the lock of the interpreter released. The second value is the error that ended
/// it early: `KeyboardInterrupt`, or the exception of `progress`, which is called with parts done,
/// parts in total and seconds left.
pub fn cancellable<T: Send>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Control) -> T + Send,
) -> (T, Option<PyErr>) {
    let control = Control::default();
    let (sender, mut receiver) = channel::<()>();
    let mut teller = ProgressReporter::new(progress.map(|progress| progress.clone().unbind()));
    std::thread::scope(|scope| {
        let inside = control.clone();
        let worker = scope.spawn(move || {
            let answer = work(&inside);
            let _ = sender.send(());
            answer
        });
        let mut ended = None;
        loop {
            let heard;
            (receiver, heard) = py.detach(move || {
                let heard = receiver.recv_timeout(POLL_INTERVAL);
                (receiver, heard)
            });
            let waits = heard == Err(RecvTimeoutError::Timeout);
            if ended.is_none() {
                ended = py
                    .check_signals()
                    .and_then(|()| teller.tell(py, &control, !waits))
                    .err();
            }
            if !waits {
                break;
            }
            if ended.is_some() {
                control.stop();
            }
        }
        match worker.join() {
            Ok(answer) => (answer, ended),
            Err(panic) => std::panic::resume_unwind(panic),
        }
    })
}

/// Runs work with long parts that do not check for cancellation. The work owns its data: at Ctrl-C
/// it is abandoned, and its result is discarded.
pub fn left_alone<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&Control) -> Result<T, Failure> + Send + 'static,
) -> (Result<T, Failure>, Option<PyErr>) {
    let control = Control::default();
    let inside = control.clone();
    let (sender, mut receiver) = channel();
    let worker = std::thread::spawn(move || sender.send(work(&inside)));
    loop {
        let heard;
        (receiver, heard) = py.detach(move || {
            let heard = receiver.recv_timeout(POLL_INTERVAL);
            (receiver, heard)
        });
        match heard {
            Ok(answer) => return (answer, None),
            Err(RecvTimeoutError::Timeout) => {
                if let Err(ended) = py.check_signals() {
                    control.stop();
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

/// Runs one integration on this thread: it ends before another thread would have started, or checks
/// between its steps.
pub fn visited<T: Send>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Control) -> T + Send,
) -> (T, Option<PyErr>) {
    let visit = Arc::new(Mutex::new(Visit {
        looked: Instant::now(),
        ended: None,
        teller: ProgressReporter::new(progress.map(|own| own.clone().unbind())),
    }));
    let inside = Arc::clone(&visit);
    let control = Control::with_callback(move |control| {
        inside
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .look(control)
    });
    let answer = py.detach(|| work(&control));
    let mut visit = visit.lock().unwrap_or_else(PoisonError::into_inner);
    let ended = visit.ended.take().or_else(|| {
        py.check_signals()
            .and_then(|()| visit.teller.tell(py, &control, true))
            .err()
    });
    (answer, ended)
}

/// Check from within the work.
struct Visit {
    looked: Instant,
    ended: Option<PyErr>,
    teller: ProgressReporter,
}

impl Visit {
    fn look(&mut self, control: &Control) {
        if self.ended.is_some() || self.looked.elapsed() < POLL_INTERVAL {
            return;
        }
        self.ended = Python::attach(|py| {
            py.check_signals()
                .and_then(|()| self.teller.tell(py, control, false))
        })
        .err();
        if self.ended.is_some() {
            control.stop();
        }
        self.looked = Instant::now();
    }
}

/// Reports progress to Python.
struct ProgressReporter {
    progress: Option<Py<PyAny>>,
    begun: Instant,
    told: Instant,
    last: (u64, u64),
}

impl ProgressReporter {
    fn new(progress: Option<Py<PyAny>>) -> Self {
        Self {
            progress,
            begun: Instant::now(),
            told: Instant::now(),
            last: (0, 0),
        }
    }

    fn tell(&mut self, py: Python<'_>, control: &Control, at_the_end: bool) -> PyResult<()> {
        let Some(progress) = &self.progress else {
            return Ok(());
        };
        // The progress requested here is read at the next check.
        control.request_progress();
        let now = control.progress();
        let due = at_the_end || self.told.elapsed() >= REPORT_INTERVAL;
        if now == self.last || !due {
            return Ok(());
        }
        (self.last, self.told) = (now, Instant::now());
        let (done, expected) = now;
        // Without a known end no time left is estimated.
        let left_s = (done > 0 && expected > 0).then(|| {
            self.begun.elapsed().as_secs_f64() * expected.saturating_sub(done) as f64 / done as f64
        });
        progress.call1(py, (done, expected, left_s)).map(|_| ())
    }
}

/// Runs `work` on its own pool: the shared one does not survive a `fork`.
pub fn on_threads<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads.unwrap_or(0))
        .build();
    pool.map_err(|error| {
        Failure::new(
            "JounceError",
            format!("the threads cannot be started: {error}"),
        )
    })?
    .install(work)
}

/// Returns a result for Python, and the error that ended it early. Without a result only that error
/// is returned.
pub fn to_python_result<'py, T>(
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

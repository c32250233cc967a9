//! Computation without the lock of the interpreter, with checks for Ctrl-C and progress reports.
//! The work runs on its own thread while the thread of Python waits; where a thread would cost more
//! than the work, it runs on the thread of Python, which checks between steps.

use jounce::Control;
use pyo3::prelude::*;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::failure::Failure;

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
    let mut reporter = ProgressReporter::new(progress.map(|progress| progress.clone().unbind()));
    std::thread::scope(|scope| {
        let control_of_work = control.clone();
        let worker = scope.spawn(move || {
            let result = work(&control_of_work);
            let _ = sender.send(());
            result
        });
        let mut interruption = None;
        loop {
            let message;
            (receiver, message) = py.detach(move || {
                let message = receiver.recv_timeout(POLL_INTERVAL);
                (receiver, message)
            });
            let is_running = message == Err(RecvTimeoutError::Timeout);
            if interruption.is_none() {
                interruption = py
                    .check_signals()
                    .and_then(|()| reporter.report(py, &control, !is_running))
                    .err();
            }
            if !is_running {
                break;
            }
            if interruption.is_some() {
                control.stop();
            }
        }
        match worker.join() {
            Ok(result) => (result, interruption),
            Err(panic) => std::panic::resume_unwind(panic),
        }
    })
}

/// Runs work with long parts that do not check for cancellation. The work owns its data: at Ctrl-C
/// it is abandoned, and its result is discarded.
pub fn detached<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&Control) -> Result<T, Failure> + Send + 'static,
) -> (Result<T, Failure>, Option<PyErr>) {
    let control = Control::default();
    let control_of_work = control.clone();
    let (sender, mut receiver) = channel();
    let worker = std::thread::spawn(move || sender.send(work(&control_of_work)));
    loop {
        let message;
        (receiver, message) = py.detach(move || {
            let message = receiver.recv_timeout(POLL_INTERVAL);
            (receiver, message)
        });
        match message {
            Ok(result) => return (result, None),
            Err(RecvTimeoutError::Timeout) => {
                if let Err(interruption) = py.check_signals() {
                    control.stop();
                    return (Err(Failure::stopped()), Some(interruption));
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
pub fn on_this_thread<T: Send>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Control) -> T + Send,
) -> (T, Option<PyErr>) {
    let callback_state = Arc::new(Mutex::new(CallbackState {
        last_check: Instant::now(),
        interruption: None,
        reporter: ProgressReporter::new(progress.map(|progress| progress.clone().unbind())),
    }));
    let shared_state = Arc::clone(&callback_state);
    let control = Control::with_callback(move |control| {
        shared_state
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .poll(control)
    });
    let result = py.detach(|| work(&control));
    let mut callback_state = callback_state
        .lock()
        .unwrap_or_else(PoisonError::into_inner);
    let interruption = callback_state.interruption.take().or_else(|| {
        py.check_signals()
            .and_then(|()| callback_state.reporter.report(py, &control, true))
            .err()
    });
    (result, interruption)
}

/// Check from within the work.
struct CallbackState {
    last_check: Instant,
    interruption: Option<PyErr>,
    reporter: ProgressReporter,
}

impl CallbackState {
    fn poll(&mut self, control: &Control) {
        if self.interruption.is_some() || self.last_check.elapsed() < POLL_INTERVAL {
            return;
        }
        self.interruption = Python::attach(|py| {
            py.check_signals()
                .and_then(|()| self.reporter.report(py, control, false))
        })
        .err();
        if self.interruption.is_some() {
            control.stop();
        }
        self.last_check = Instant::now();
    }
}

/// Reports progress to Python.
struct ProgressReporter {
    progress: Option<Py<PyAny>>,
    start: Instant,
    last_report: Instant,
    last_progress: (u64, u64),
}

impl ProgressReporter {
    fn new(progress: Option<Py<PyAny>>) -> Self {
        Self {
            progress,
            start: Instant::now(),
            last_report: Instant::now(),
            last_progress: (0, 0),
        }
    }

    fn report(&mut self, py: Python<'_>, control: &Control, is_final: bool) -> PyResult<()> {
        let Some(progress) = &self.progress else {
            return Ok(());
        };
        // The progress requested here is read at the next check.
        control.request_progress();
        let current = control.progress();
        let is_due = is_final || self.last_report.elapsed() >= REPORT_INTERVAL;
        if current == self.last_progress || !is_due {
            return Ok(());
        }
        (self.last_progress, self.last_report) = (current, Instant::now());
        let (done, expected) = current;
        // Without a known end no time left is estimated.
        let remaining_s = (done > 0 && expected > 0).then(|| {
            self.start.elapsed().as_secs_f64() * expected.saturating_sub(done) as f64 / done as f64
        });
        progress
            .call1(py, (done, expected, remaining_s))
            .map(|_| ())
    }
}

/// Returns a result for Python, and the error that ended it early. Without a result only that error
/// is returned.
pub fn to_python_result<'py, T>(
    py: Python<'py>,
    (result, interruption): (Result<T, Failure>, Option<PyErr>),
    into_python: impl FnOnce(T) -> PyResult<Bound<'py, pyo3::types::PyDict>>,
) -> PyResult<(Option<Bound<'py, pyo3::types::PyDict>>, Option<PyErr>)> {
    match (result, interruption) {
        (Ok(result), interruption) => Ok((Some(into_python(result)?), interruption)),
        (Err(_), Some(interruption)) => Ok((None, Some(interruption))),
        (Err(failure), None) => Err(failure.into_exception(py)),
    }
}

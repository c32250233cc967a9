//! Progress of a computation, sent at regular times.

use crate::session::Session;
use crate::session::cancellation::Cancellation;
use crate::session::frame::Frame;
use jounce::Control;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::{Duration, Instant};

/// Time between two frames of progress.
pub const PROGRESS_INTERVAL: Duration = Duration::from_millis(100);

/// Runs work, and sends the numbers of its finished and expected parts at regular times.
pub(super) fn with_progress<T>(
    session: &Session,
    (id, kind): (u64, &str),
    cancellation: &Cancellation,
    work: impl FnOnce() -> T,
) -> T {
    let start_time = Instant::now();
    // The channel closes when the work ends, also by a panic.
    let (working, is_working) = mpsc::channel::<()>();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            while is_working.recv_timeout(PROGRESS_INTERVAL) == Err(RecvTimeoutError::Timeout) {
                if let Some(frame) = progress((id, kind), cancellation.control(), start_time) {
                    session.try_send(cancellation, frame);
                }
            }
        });
        let _working = working;
        work()
    })
}

/// Returns the progress of a computation; `None` before its first part is finished.
pub fn progress((id, kind): (u64, &str), control: &Control, start_time: Instant) -> Option<Frame> {
    control.request_progress();
    let (done, expected) = control.progress();
    let mut frame = Frame::new(id, kind, "progress");
    frame
        .put("done", done)
        .put("of", expected)
        .put("seconds", start_time.elapsed().as_secs_f64());
    (done > 0).then_some(frame)
}

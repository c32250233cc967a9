//! Ctrl-C: the work ends soon, what is finished is told, and the exit code says that it is not all.

use crate::failure::Failure;
use jounce::march::Watch;

/// Lets Ctrl-C end the work of a watch. A second handler cannot be set where another already stands; then the default, to end at once, is
/// kept.
pub fn heed(watch: &Watch) {
    let asked = watch.clone();
    let _ = ctrlc::set_handler(move || asked.stop());
}

/// How a command ends whose answer is told: `finished` says what the answer is made of where the work was stopped.
///
/// # Errors
/// [`Failure::Shortened`].
pub fn end(watch: &Watch, finished: impl FnOnce() -> String) -> Result<(), Failure> {
    if watch.is_stopped() { Err(Failure::Shortened(format!("stopped: the answer is that of {}", finished()))) } else { Ok(()) }
}

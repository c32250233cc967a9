//! Ctrl-C: the work ends soon, what is finished is told, and the exit code says that it is not all.

use crate::failure::Failure;
use jounce::integrate::Control;

/// Lets Ctrl-C end the work of a control. A second handler cannot be set where another already stands; then the default, to end at once, is
/// kept.
pub fn install(control: &Control) {
    let asked = control.clone();
    let _ = ctrlc::set_handler(move || asked.stop());
}

/// How a command ends whose answer is told: `finished` says what the answer is made of where the work was stopped.
///
/// # Errors
/// [`Failure::Partial`].
pub fn end(control: &Control, finished: impl FnOnce() -> String) -> Result<(), Failure> {
    if control.is_stopped() {
        Err(Failure::Partial(format!(
            "stopped: the answer is that of {}",
            finished()
        )))
    } else {
        Ok(())
    }
}

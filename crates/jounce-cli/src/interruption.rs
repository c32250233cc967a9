//! Ctrl-C: the work ends soon, the finished part is printed, and the exit code marks it as
//! incomplete.

use crate::failure::Failure;
use jounce::Control;

/// Lets Ctrl-C end the work of a control. Only one handler can be set; without it the default
/// remains, which ends at once.
pub fn install(control: &Control) {
    let handler_control = control.clone();
    let _ = ctrlc::set_handler(move || handler_control.stop());
}

/// Ends a command whose result is printed: `finished` names the finished part where the work was
/// stopped.
///
/// # Errors
/// [`Failure::Partial`].
pub fn end(control: &Control, finished: impl FnOnce() -> String) -> Result<(), Failure> {
    if control.is_stopped() {
        Err(Failure::Partial(format!(
            "stopped: the result covers {}",
            finished()
        )))
    } else {
        Ok(())
    }
}

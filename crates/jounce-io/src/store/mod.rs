//! Atomic file writes.
//!
//! The content is written to a hidden file in the folder of the target, flushed to the disk, then
//! renamed to the target. A rename within one folder is atomic, so a reader (or a resumed run) sees
//! the old file or the new one, never a part.
mod atomic;
mod check;
mod clean;
mod lock;
mod reason;
pub use atomic::{PendingFile, StoreError, create, prepare, write, write_from, write_in_folder};
pub use check::{check_file, check_folder};
pub use clean::clean;
pub use lock::open_locked;
pub use reason::{missing, reason, unreadable, unwritable_folder};

//! Files appear whole or not at all.
//!
//! The content is written to a hidden neighbour of the target, flushed to the disk, then renamed over the target. A rename
//! within one folder is atomic, so a reader (or a run that resumes) sees the old file or the new one, never a part.
mod atomic;
mod clean;
pub use atomic::{StoreError, create, write, write_from};
pub use clean::clean;

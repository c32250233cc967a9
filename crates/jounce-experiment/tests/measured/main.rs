//! Recordings: files of every format, truncated files, and real recordings if they are present next
//! to the repository.

mod driving_recordings;
mod formats;
mod modes;
mod real_recordings;
mod samples;
mod sensors;

//! Recordings: files of every format, truncated files, and real recordings if they are present next
//! to the repository.

mod arrays;
mod base_input;
mod cantilever;
mod containers;
mod driving_recordings;
mod formats;
mod hammer;
mod intervals;
mod layouts;
mod real_recordings;
mod references;
mod samples;
mod seven_modes;
mod standard_test;
mod through_a_file;
mod truncated;
mod unknown_noise;
mod writers;
mod writing;

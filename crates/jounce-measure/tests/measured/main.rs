//! Recordings: files of every format, truncated files, and real recordings if they are present next
//! to the repository.

mod arrays;
mod base_input;
mod cantilever;
mod containers;
mod cut;
mod driven;
mod formats;
mod hammer;
mod intervals;
mod layouts;
mod real;
mod references;
mod samples;
mod seven;
mod standard_test;
mod through_a_file;
mod untold;
mod writers;
mod written;

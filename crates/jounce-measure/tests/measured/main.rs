//! Recordings: files of every format, cut files, and real recordings where they lie beside the repository.

mod arrays;
mod cantilever;
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
mod through_a_file;
mod untold;
mod written;

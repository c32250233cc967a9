//! Recordings: files of every format, cut files, and real recordings where they lie beside the repository.

mod arrays;
mod cantilever;
mod containers;
mod cut;
mod driven;
mod formats;
mod hammer;
mod intervals;
mod real;
mod references;
mod samples;
mod seven;
mod through_a_file;
mod untold;
mod writers;
mod written;

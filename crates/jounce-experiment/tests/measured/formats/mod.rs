//! Files of every format, written, read, truncated.

mod arrays;
mod containers;
mod headers;
mod layouts;
mod matlab;
mod through_a_file;
mod truncated;
mod units;
mod writers;
mod writing;

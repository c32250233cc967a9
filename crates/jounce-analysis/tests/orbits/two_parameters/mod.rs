//! Curves over two keys: bifurcations, peaks, levels.

mod levels;
mod peaks;
mod planes;
mod tracking;

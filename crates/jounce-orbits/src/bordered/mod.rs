//! Square matrices with a border of one row and one column, and null directions.

pub(crate) mod block_equations;
pub(crate) mod border;
pub(crate) mod null_vector;

//! Readers: one file or folder for each format.

pub(super) mod arrays;
pub(super) mod hdf5;
pub(super) mod lvm;
pub(super) mod mat;
pub(super) mod npy;
pub(super) mod npz;
pub(super) mod parquet;
mod scalar;
pub(super) mod tdms;
pub(super) mod text;
pub(super) mod uff;
pub(super) mod wav;

/// Maximum compression ratio of deflate: 258 bytes by a pair of codes of one bit.
const MAX_DEFLATE_RATIO: u64 = 1032;

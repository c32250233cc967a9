//! HDF5 and MATLAB 7.3 files: numeric arrays in groups of any depth, including cells and structs of
//! MATLAB.
//!
//! The crate `hdf5-pure` reads the format. Sizes are checked against the file size before memory is
//! allocated, because a damaged file may claim any size.
mod checked;
mod matlab;
mod node;
mod stored;

use std::path::Path as FilePath;

use hdf5_pure::File;

use crate::read::column::samples::SampleStore;
use crate::read::contents::FormatContents;
use crate::read::error::Damage;
use crate::read::format::arrays::{Path, Tree, into_found};
use node::Walker;

const BEGIN: &[u8] = b"\x89HDF\r\n\x1a\n";

/// True where a file begins like HDF5, perhaps after a user block of 512, 1024 or 2048 bytes, as
/// written by MATLAB.
pub(in crate::read) fn is_hdf5(head: &[u8]) -> bool {
    [0, 512, 1024, 2048].iter().any(|from| {
        head.get(*from..)
            .is_some_and(|head| head.starts_with(BEGIN))
    })
}

pub(in crate::read) fn read(
    path: &FilePath,
    store: &SampleStore,
) -> Result<FormatContents, Damage> {
    let size = std::fs::metadata(path).map_err(Damage::cut)?.len();
    let file = File::open_streaming(path).map_err(|fault| hdf5_error(&fault))?;
    let mut walker = Walker {
        store,
        size,
        tree: Tree::default(),
        visited_count: 0,
    };
    walker.group(&file.root(), &Path::default())?;
    into_found(walker.tree)
}

/// Adds to an error of the library how to convert a file that it cannot read.
fn hdf5_error(fault: &dyn std::fmt::Display) -> Damage {
    Damage::new(format!(
        "{fault}; is the file truncated? Else convert it in Python: import h5py, numpy; f = \
        h5py.File('FILE'); numpy.savez('FILE.npz', t=f['time'][...].ravel(), \
        v=f['NAME'][...].ravel())"
    ))
}

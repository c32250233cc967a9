//! Writers of binary formats, as plain as their descriptions allow.
pub mod mat;
pub mod tdms;
pub mod wav;
pub mod zip;

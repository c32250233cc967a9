//! What is there once per port in contact, or once per pair: seldom more than two ports are, so that nothing is allocated for it.

use smallvec::SmallVec;
use std::ops::Deref;

/// One entry per port in contact.
pub type SmallList<T> = SmallVec<[T; 2]>;

/// A table that is shared, or that was made for one step alone.
#[derive(Debug, Clone)]
pub enum SharedOrOwned<'a, T> {
    /// Kept by the kernel.
    Shared(&'a T),
    /// Of a step of any other length.
    Own(Box<T>),
}

impl<T> Deref for SharedOrOwned<'_, T> {
    type Target = T;

    #[inline(always)]
    fn deref(&self) -> &T {
        match self {
            SharedOrOwned::Shared(table) => table,
            SharedOrOwned::Own(table) => table,
        }
    }
}

//! Lists with one entry per port in contact or per pair: seldom are more than two ports in contact,
//! so that they need no allocation.

use smallvec::SmallVec;
use std::ops::Deref;

/// List with one entry per port in contact.
pub type SmallList<T> = SmallVec<[T; 2]>;

/// Table that is shared, or that belongs to one step.
#[derive(Debug, Clone)]
pub enum SharedOrOwned<'a, T> {
    /// Stored in the kernel.
    Shared(&'a T),
    /// Computed for a step of any other length.
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

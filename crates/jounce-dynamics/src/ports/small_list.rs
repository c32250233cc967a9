//! Lists with one entry per port in contact or per pair: seldom are more than two ports in contact,
//! so that they need no allocation.

use smallvec::SmallVec;

/// List with one entry per port in contact.
pub type SmallList<T> = SmallVec<[T; 2]>;

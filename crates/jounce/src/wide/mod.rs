//! Eight numbers side by side: the width in which marching works.
//!
//! [`Lane`] is how they lie in memory; [`Wide`] is the arithmetic on them in registers, for whatever vector instructions the
//! machine has. A function that is generic over `Wide` and entered through [`widest`] is compiled once per instruction set.

mod dispatch;
mod lane;
mod registers;

pub use dispatch::{Task, widest};
pub use lane::{Lane, WIDTH};
pub use registers::{Portable, Registers, Wide};

//! Eight numbers side by side: the width in which marching works.
//!
//! [`F64x8`] is how they lie in memory; [`Simd`] is the arithmetic on them in registers, for whatever vector instructions the
//! machine has. A function that is generic over `Simd` and entered through [`widest`] is compiled once per instruction set.

mod dispatch;
mod f64x8;
mod registers;

pub use dispatch::{Task, widest};
pub use f64x8::{F64x8, LANES};
pub use registers::{Portable, Registers, Simd};

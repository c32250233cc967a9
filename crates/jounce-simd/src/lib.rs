//! Arithmetic on eight numbers at once, the vector width of the integration.
//!
//! [`F64x8`] is their form in memory. [`Simd`] is the arithmetic on them in registers, for the
//! vector instructions of the machine. A function that is generic over `Simd` and entered through
//! [`widest`] is compiled once per instruction set.

mod dispatch;
mod f64x8;
mod power;
mod registers;

pub use dispatch::{Task, widest};
pub use f64x8::{F64x8, LANES};
pub use power::power;
pub use registers::{Portable, Registers, Simd};

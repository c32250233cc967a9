//! Diagonalised plant against its physical matrices, its secular equation, closed forms and
//! quadrature.
#![allow(clippy::unwrap_used, reason = "tests")]

mod diagonal;
mod faults;
mod meters;
mod steady;
mod systems;

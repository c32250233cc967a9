//! Factors `P A P^T = L D L^T` of sparse symmetric matrices, without pivoting for size.
//!
//! Columns of `L` with the same rows below their diagonal form a *supernode*, stored as a dense
//! block. The multifrontal method eliminates one supernode after the other in a dense *front* of its
//! rows, and adds what is left of the front, the Schur complement, to the front of its parent.

mod front;
mod multifrontal;
mod symbolic;
mod tree;

pub use multifrontal::Factor;
pub use symbolic::Symbolic;

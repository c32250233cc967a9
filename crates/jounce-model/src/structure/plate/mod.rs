//! Modes of rectangular thin plates by finite elements.
//!
//! ```text
//! U = 1/2 int D11 w_xx^2 + D22 w_yy^2 + 2 D12 w_xx w_yy + 4 D66 w_xy^2 dA   strain energy, J
//! T = 1/2 int m w_t^2 dA + 1/2 sum_j m_j w_t(x_j)^2                         kinetic energy, J
//! chi = int gamma_x w_xx + gamma_y w_yy dA                                  coupling of a patch, N/V
//! ```
//!
//! with the laminate stiffnesses `D11`, `D12`, `D22`, `D66` (N m), the mass per area `m` (kg/m^2)
//! and the moments `gamma` of a patch per volt and length (N/V) of each cell (`laminate`). The
//! displacement `w` (m) is a tensor product of piecewise polynomials with continuous slope in each
//! direction (`line`). Cubic polynomials give the element of Bogner, Fox and Schmit with 16 degrees
//! of freedom; higher ones add internal functions. Element matrices are Kronecker products of
//! integrals along the two directions. Grid lines pass through all edges of patches and layers;
//! points and masses are evaluated by the functions. Clamped and simply supported edges drop the
//! functions that they hold at rest.
//!
//! Sources: F. K. Bogner, R. L. Fox, L. A. Schmit, Proc. Conf. Matrix Methods in Structural
//! Mechanics, AFFDL-TR-66-80 (1966) 397; C. De Marqui, A. Erturk, D. J. Inman, J. Sound Vib. 327
//! (2009) 9.

mod laminate;
mod layout;
mod line;
mod mesh;
mod modal;
mod ply;
mod refinement;

pub(super) use modal::plate_modes;

//! Modal analysis from frequency responses.
//!
//! Poles come from the poly-reference least-squares complex frequency-domain method (pLSCF) over a
//! range of orders. Those that are stable from order to order form the stabilisation diagram and
//! the initial guess. A maximum-likelihood refinement then fits
//!
//! ```text
//! H(w) = (j w)^m [ sum_r R_r / (j w - p_r) + conj(R_r) / (j w - conj(p_r)) - L / w^2 + U_0 + U_1 w^2 + .. ],
//! p = -zeta w_r + j w_r sqrt(1 - zeta^2)
//! ```
//!
//! (`m` = 0, 1, 2 for displacement, velocity and acceleration per force) to all responses at once.
//! Each line has the variance given by the coherence around it, and the number of terms `U` for the
//! modes above the band is chosen from the data. `1 / (j w - p)` is replaced by the block's share
//! of a decay ([`jounce_signal::spectral::WindowBias`]). Leaving out one part of the blocks at a time gives
//! the uncertainty of frequencies and damping ratios; without blocks the residuals of each line do.
//! For forces at several locations the residues of a mode are its shape times its participation in
//! each. By reciprocity, sensors and force locations may be exchanged, so that the smaller set is
//! the references.
//!
//! Source: P. Guillaume et al., A poly-reference implementation of the least-squares complex
//! frequency-domain estimator, IMAC 21 (2003); M. El-Kafafy et al., Fast maximum-likelihood
//! identification of modal parameters with uncertainty intervals, Mech. Syst. Signal Process. 37
//! (2013) 422.
mod band;
mod band_lines;
mod decays;
mod error;
mod identify;
mod mac;
mod maximum_likelihood;
mod mode;
mod participation;
mod peaks;
mod poles;
mod refinement;

pub use band::{Band, ResponseQuantity};
pub use decays::identify_decays;
pub use error::ModalError;
pub use identify::{Identification, ModalSettings, identify};
pub use mac::{mac, mac_matrix};
pub use mode::Mode;
pub use participation::Participation;
pub use peaks::ResponsePeak;
pub use poles::{Pole, Stability, StablePole, diagram, poles};

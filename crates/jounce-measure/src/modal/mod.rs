//! Modes from frequency responses.
//!
//! Poles come from the poly-reference least-squares complex frequency-domain method (pLSCF) over a range of orders; those that stay where they
//! are from order to order make the stabilisation diagram and the first guess. A maximum-likelihood refinement then fits
//!
//! ```text
//! H(w) = (j w)^m [ sum_r R_r / (j w - p_r) + conj(R_r) / (j w - conj(p_r)) - L / w^2 + U_0 + U_1 w^2 + .. ],
//! p = -zeta w_r + j w_r sqrt(1 - zeta^2)
//! ```
//!
//! (`m` = 0, 1, 2 for displacement, velocity and acceleration per force) to all responses at once, each line with the variance that the
//! coherence around it tells, and with as many terms `U` for the modes above the band as the responses ask for. `1 / (j w - p)` stands for what
//! the blocks see of a decay ([`crate::spectral::WindowBias`]). Leaving out one part of the blocks after the other gives the uncertainty of
//! frequencies and damping ratios; without blocks what the modes leave of each line does. Of forces at several places the residues of a mode are its shape times its
//! participation in each; sensors and places of forces may change sides, by reciprocity, so that the fewer are the references.
//!
//! Source: P. Guillaume et al., A poly-reference implementation of the least-squares complex frequency-domain estimator, IMAC 21 (2003);
//! M. El-Kafafy et al., Fast maximum-likelihood identification of modal parameters with uncertainty intervals, Mech. Syst. Signal Process. 37
//! (2013) 422.
mod band;
mod close_modes;
mod complex_plscf;
mod covariance;
mod design_matrix;
mod error;
mod half_spectrum;
mod identify;
mod jackknife;
mod likelihood;
mod line_selection;
mod mac;
mod multi_band;
mod noise;
mod participation;
mod peaks;
mod plscf;
mod pole;
mod references;
mod scatter;
mod semi_normal;
mod stabilisation;
mod sums;
mod variable_projection;
mod warp;

pub use band::{Band, ResponseQuantity};
pub use error::ModalError;
pub use half_spectrum::identify_decays;
pub use identify::{Identification, ModalSettings, Mode, identify};
pub use mac::{mac, mac_matrix};
pub use participation::Participation;
pub use peaks::ResponsePeak;
pub use plscf::poles;
pub use pole::Pole;
pub use stabilisation::{Stability, StablePole, diagram};

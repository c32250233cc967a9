//! Modal constants, and participation of the base in each mode.
//!
//! ```text
//! H_o(w) = sum_r A_or / (w_r^2 - w^2 + 2 j z_r w_r w),   A_or = 2 j w_dr R_or
//! ```
//!
//! Under a force `A_or = phi_or phi_ir`. Under an acceleration of the base `A_or = -phi_or G_r`
//! with the participation `G_r = sum of mass times phi_r`. Because the base moves the complete
//! structure, `sum_r phi_or G_r = 1` at each point.
//!
//! Source: D. Ewins, Modal Testing, 2nd edition (2000), section 2.4, for modal constants; A.
//! Chopra, Dynamics of Structures (2012), section 13.1, for participation.

use jounce_linalg::c64;

use super::Mode;
use crate::response::MeasuredResponses;
use jounce_data::recording::Quantity;

/// Shape at an output times the participation of the base.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Participation {
    /// Real part.
    pub re: f64,
    /// Imaginary part: 0 for a mode whose points move in phase.
    pub im: f64,
    /// Empty for a motion, `V/m` for a voltage.
    pub unit: &'static str,
}

impl Mode {
    /// Modal constants `2 j w_d R` of all responses, in units of the output's displacement per
    /// input.
    pub fn modal_constants(&self) -> Vec<c64> {
        let damped = self.pole().complex().im;
        self.residue
            .iter()
            .map(|residue| residue * c64::new(0.0, 2.0 * damped))
            .collect()
    }

    /// Shape at each output times the participation of the base, for responses to base motion;
    /// `None` under another input.
    pub fn base_participation(&self, responses: &MeasuredResponses) -> Option<Vec<Participation>> {
        let is_motion = |input: &Quantity| {
            matches!(
                input,
                Quantity::Acceleration | Quantity::Velocity | Quantity::Displacement
            )
        };
        if !responses.inputs.iter().all(is_motion) {
            return None;
        }
        let participation = |(constant, quantity): (c64, &Quantity)| {
            let unit = if *quantity == Quantity::Voltage {
                "V/m"
            } else {
                ""
            };
            Participation {
                re: -constant.re,
                im: -constant.im,
                unit,
            }
        };
        Some(
            self.modal_constants()
                .into_iter()
                .zip(&responses.quantities)
                .map(participation)
                .collect(),
        )
    }
}

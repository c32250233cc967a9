//! Transients so chaotic that roundoff decides on which attractor they end.

use super::attractor_kind::AttractorKind;
use super::lyapunov::largest_exponent;
use super::steady_state::ReachedOrbit;
use jounce_dynamics::Kernel;

/// Drive cycles of the exponent of a transient.
const EXPONENT_CYCLES: usize = 64;

/// Drive cycles below which a transient is not examined: the derivative of the flow takes about four
/// times as long as the flow, so that an examination costs at most half of the integration.
pub const MIN_TRANSIENT_CYCLES: u32 = 512;

impl ReachedOrbit {
    /// True for a transient of at least [`MIN_TRANSIENT_CYCLES`] that has multiplied the error of the
    /// integration, `tolerance`, to the size of the motion: its largest Lyapunov exponent is
    /// positive, and so large that the error has grown over the transient by `1 / tolerance`.
    /// Integrations with other errors then end on other attractors. False where the motion has no
    /// derivative, because it sticks to a rigid stop.
    pub fn has_chaotic_transient(&self, kernel: &Kernel, cycle_s: f64, tolerance: f64) -> bool {
        let Some(state) = self
            .earlier
            .as_ref()
            .filter(|_| self.cycles >= MIN_TRANSIENT_CYCLES)
        else {
            return false;
        };
        let cycles = (EXPONENT_CYCLES, cycle_s);
        largest_exponent(kernel, state, cycles, tolerance).is_ok_and(|exponent| {
            let growth = exponent.exponent_per_s * f64::from(self.cycles) * cycle_s;
            exponent.kind() == AttractorKind::Chaos && growth > -tolerance.ln()
        })
    }
}

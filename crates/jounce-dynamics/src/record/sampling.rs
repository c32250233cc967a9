//! Dense samples of a recorded trajectory.

use super::trajectory::{Trajectory, TrajectorySegment};
use crate::kernel::Kernel;

impl Trajectory {
    /// Calls `visit` at the start of every step from segment number `first` on, and inside flights
    /// at times at most `gap_s` apart. Its arguments are the kernel of the conduction state, the
    /// time, and the state in block coordinates without the steady part. Contact steps are short
    /// relative to the motion and have no samples inside.
    pub fn walk<'k>(
        &self,
        kernel: &'k Kernel,
        first: usize,
        gap_s: f64,
        visit: &mut impl FnMut(&'k Kernel, f64, &[f64]),
    ) {
        let mut full = Vec::new();
        for segment in self.segments().iter().skip(first) {
            // The kernel of a conduction state in the record exists.
            if let Ok(state_kernel) = kernel.in_conduction_state(segment.conduction_state) {
                segment.walk(state_kernel, gap_s, &mut full, visit);
            }
        }
    }
}

impl TrajectorySegment {
    fn walk<'k>(
        &self,
        kernel: &'k Kernel,
        gap_s: f64,
        full: &mut Vec<f64>,
        visit: &mut impl FnMut(&'k Kernel, f64, &[f64]),
    ) {
        let mut visit_full = |after_s: f64, state: &[f64]| {
            if self.sizes.is_empty() {
                return visit(kernel, self.start_s + after_s, state);
            }
            full.clear();
            full.extend_from_slice(state);
            kernel.plant.add_forced(&self.sizes, after_s, full);
            visit(kernel, self.start_s + after_s, full);
        };
        visit_full(0.0, &self.state);
        if !self.forces.is_empty() {
            return;
        }
        // The flow over many equal steps is computed once: its roundoff accumulates, without effect
        // on the search for a turning point.
        let inner = (self.length_s / gap_s).ceil().max(1.0);
        if inner == 1.0 {
            return;
        }
        let (flow, mut state) = (
            kernel.plant.diagonal.block.over(self.length_s / inner),
            self.state.clone(),
        );
        for k in 1..inner as usize {
            flow.advance(&mut state);
            visit_full(self.length_s * k as f64 / inner, &state);
        }
    }
}

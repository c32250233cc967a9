//! State at the end of a trial step.

use crate::kernel::Kernel;
use crate::ports::per_port::PerPort;
use jounce_simd::F64x8;

/// State at the end of a trial step, which becomes that of the integration if the step is accepted.
/// The next trial uses the same memory.
#[derive(Debug)]
pub(crate) struct TrialState {
    /// State, in the layout of [`super::Integrator`].
    pub y: Vec<F64x8>,
    /// Integrals of the contact force from the start of the step (see
    /// [`crate::force_response::duhamel`]).
    pub from_start: Vec<F64x8>,
    /// Motion of each port at the end of a flight: distance past the stop, m, and its rate, m/s.
    pub motion: PerPort<[f64; 2]>,
}

impl TrialState {
    /// Creates the memory for the trial steps of a kernel.
    pub fn new(kernel: &Kernel) -> Self {
        let lanes = || vec![F64x8::ZERO; kernel.layout.lanes()];
        Self {
            y: lanes(),
            from_start: lanes(),
            motion: PerPort::new(kernel.plant.ports.len(), |_| [0.0; 2]),
        }
    }
}

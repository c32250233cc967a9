//! Selection of the instruction set, once per task.

use super::registers::{Registers, Simd};
use pulp::{Arch, Simd as PulpSimd, WithSimd};

/// Work that is generic over the instruction set. `run` must be `#[inline(always)]`, and so must
/// the functions that it calls.
pub trait Task {
    /// Result of the task.
    type Output;

    /// Runs the task.
    fn run<W: Simd>(self, wide: W) -> Self::Output;
}

struct Dispatch<T>(T);

impl<T: Task> WithSimd for Dispatch<T> {
    type Output = T::Output;

    #[inline(always)]
    fn with_simd<S: PulpSimd>(self, simd: S) -> Self::Output {
        match S::F64_LANES {
            8 => self.0.run(Registers::<S, 1>(simd)),
            4 => self.0.run(Registers::<S, 2>(simd)),
            2 => self.0.run(Registers::<S, 4>(simd)),
            _ => self.0.run(Registers::<S, 8>(simd)),
        }
    }
}

/// Runs a task with the widest vector instructions of this machine.
pub fn widest<T: Task>(task: T) -> T::Output {
    Arch::new().dispatch(Dispatch(task))
}

//! Tables for steps that end at a breakpoint of a drive, at an impact of another port, or at the end
//! of an integration.

use super::step_tables::StepTables;
use crate::kernel::Kernel;
use std::sync::Arc;

/// Number of lengths that are kept: complete, half and quarter pieces of a sampled drive, with a
/// reserve.
const MAX_LENGTHS: usize = 12;

/// Tables with the conduction state of their kernel, in order of last use, the latest first.
#[derive(Debug, Clone, Default)]
pub(crate) struct OddTables(Vec<(usize, Arc<StepTables>)>);

impl OddTables {
    /// Returns the tables of a length for the kernel of a conduction state.
    pub fn of(
        &mut self,
        kernel: &Kernel,
        conduction_state: usize,
        length_s: f64,
    ) -> Arc<StepTables> {
        let is_known = |(state, tables): &(usize, Arc<StepTables>)| {
            *state == conduction_state && tables.length_s == length_s
        };
        let entry = match self.0.iter().position(is_known) {
            Some(index) => self.0.remove(index),
            None => {
                let tables = StepTables::new(kernel.plant.ports.len(), length_s);
                (conduction_state, Arc::new(tables))
            }
        };
        self.0.truncate(MAX_LENGTHS - 1);
        self.0.insert(0, entry);
        Arc::clone(&self.0[0].1)
    }
}

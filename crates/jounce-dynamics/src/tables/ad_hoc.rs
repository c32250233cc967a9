//! Cache of tables for contact steps that end at a breakpoint of a drive or at the end of an
//! integration.

use super::contact::ContactTable;
use crate::kernel::{ForceBasis, Kernel};
use std::sync::Arc;

/// Size of the cache: complete, half and quarter pieces of a sampled drive, in both bases, with a
/// reserve.
const MAX_CACHED_TABLES: usize = 12;

/// Tables in order of last use, the latest first.
#[derive(Debug, Clone, Default)]
pub(crate) struct AdHocTables(Vec<(ForceBasis, Arc<ContactTable>)>);

impl AdHocTables {
    /// Returns the table of a length, and computes it if it is not in the cache.
    pub fn of(&mut self, kernel: &Kernel, shape: ForceBasis, length_s: f64) -> Arc<ContactTable> {
        let cached_index = self
            .0
            .iter()
            .position(|(cached, table)| *cached == shape && table.length_s == length_s);
        let entry = match cached_index {
            Some(index) => self.0.remove(index),
            None => (
                shape,
                Arc::new(ContactTable::new(
                    kernel,
                    0,
                    kernel.basis(0, shape),
                    length_s,
                )),
            ),
        };
        self.0.truncate(MAX_CACHED_TABLES - 1);
        self.0.insert(0, entry);
        Arc::clone(&self.0[0].1)
    }
}

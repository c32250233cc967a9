//! Finds what is nearest to an array among the enclosing structs.

use std::collections::HashMap;
use std::hash::Hash;

/// Lookup by enclosing names: finds the item of a kind that shares the most names with an array,
/// counted from the outermost.
pub(super) struct NearestByName<K>(HashMap<(K, Vec<String>), usize>);

impl<K> Default for NearestByName<K> {
    fn default() -> Self {
        Self(HashMap::new())
    }
}

impl<K: Copy + Eq + Hash> NearestByName<K> {
    /// Stores the first item for each list of outermost names.
    pub(super) fn insert(&mut self, kind: K, scope: &[String], number: usize) {
        for depth in 0..=scope.len() {
            self.0
                .entry((kind, scope[..depth].to_vec()))
                .or_insert(number);
        }
    }

    /// Returns the first item inside these names.
    pub(super) fn at_scope(&self, kind: K, scope: &[String]) -> Option<usize> {
        self.0.get(&(kind, scope.to_vec())).copied()
    }

    /// Returns the nearest item; among equally near kinds, the first.
    pub(super) fn nearest(&self, kinds: &[K], scope: &[String]) -> Option<usize> {
        (0..=scope.len()).rev().find_map(|depth| {
            kinds
                .iter()
                .find_map(|kind| self.at_scope(*kind, &scope[..depth]))
        })
    }
}

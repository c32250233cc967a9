//! One value for each port of a plant.

use std::ops::{Index, IndexMut};

/// As many values as ports, and one where there is none. The first stands beside its owner: a march with one port reaches it
/// without a look-up.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PerPort<T> {
    first: T,
    rest: Vec<T>,
}

impl<T> PerPort<T> {
    /// For a number of ports.
    pub fn new(ports: usize, make: impl FnMut(usize) -> T) -> Self {
        let mut make = make;
        Self {
            first: make(0),
            rest: (1..ports).map(make).collect(),
        }
    }

    /// In the order of the ports.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        std::iter::once(&self.first).chain(&self.rest)
    }

    /// The same, to be changed.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut T> {
        std::iter::once(&mut self.first).chain(&mut self.rest)
    }
}

impl<T> Index<usize> for PerPort<T> {
    type Output = T;

    #[inline(always)]
    fn index(&self, port: usize) -> &T {
        if port == 0 {
            &self.first
        } else {
            &self.rest[port - 1]
        }
    }
}

impl<T> IndexMut<usize> for PerPort<T> {
    #[inline(always)]
    fn index_mut(&mut self, port: usize) -> &mut T {
        if port == 0 {
            &mut self.first
        } else {
            &mut self.rest[port - 1]
        }
    }
}

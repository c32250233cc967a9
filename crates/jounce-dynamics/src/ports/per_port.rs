//! One value for each port of a plant.

use std::ops::{Index, IndexMut};

/// One value per port, and one where there is no port. The first value is stored inline: an
/// integration with one port reads it without indirection.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PerPort<T> {
    first: T,
    rest: Vec<T>,
}

impl<T> PerPort<T> {
    /// Creates the values of a number of ports.
    pub fn new(ports: usize, make: impl FnMut(usize) -> T) -> Self {
        let mut make = make;
        Self {
            first: make(0),
            rest: (1..ports).map(make).collect(),
        }
    }

    /// Iterates in the order of the ports.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        std::iter::once(&self.first).chain(&self.rest)
    }

    /// Iterates mutably in the order of the ports.
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

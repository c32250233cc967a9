//! Number series that can be iterated repeatedly, in memory or on disk.

use std::borrow::Cow;
use std::convert::Infallible;

use super::Grid;

/// Numbers in each piece of a series except the last.
pub const PIECE: usize = 4096;

/// Series of numbers, read piece by piece.
pub trait Series {
    /// Error of reading.
    type Fault;

    /// Number of values.
    fn count(&self) -> usize;

    /// Returns the numbers from `index * PIECE`, at most [`PIECE`] of them.
    ///
    /// # Errors
    /// The numbers cannot be read.
    fn piece(&self, index: usize) -> Result<Cow<'_, [f64]>, Self::Fault>;

    /// Passes every number to `callback` in order.
    ///
    /// # Errors
    /// Those of [`Series::piece`].
    fn each(&self, mut callback: impl FnMut(f64)) -> Result<(), Self::Fault>
    where
        Self: Sized,
    {
        for index in 0..self.count().div_ceil(PIECE) {
            self.piece(index)?.iter().for_each(|x| callback(*x));
        }
        Ok(())
    }
}

impl Series for &[f64] {
    type Fault = Infallible;

    fn count(&self) -> usize {
        self.len()
    }

    fn piece(&self, index: usize) -> Result<Cow<'_, [f64]>, Infallible> {
        let from = (index * PIECE).min(self.len());
        Ok(Cow::Borrowed(&self[from..(from + PIECE).min(self.len())]))
    }
}

impl Series for Grid {
    type Fault = Infallible;

    fn count(&self) -> usize {
        self.len()
    }

    fn piece(&self, index: usize) -> Result<Cow<'_, [f64]>, Infallible> {
        let from = (index * PIECE).min(self.len());
        Ok((from..(from + PIECE).min(self.len()))
            .map(|k| self.at(k))
            .collect())
    }
}

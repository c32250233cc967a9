//! Numbers that can be gone through any number of times, wherever they lie.

use std::borrow::Cow;
use std::convert::Infallible;

use super::Grid;

/// Numbers in each piece of a series, but for the last one.
pub const PIECE: usize = 4096;

/// A series of numbers that is handed over piece by piece.
pub trait Series {
    /// What may go wrong where the numbers lie.
    type Fault;

    /// How many numbers there are.
    fn count(&self) -> usize;

    /// The numbers from `index * PIECE` on, at most [`PIECE`] of them.
    ///
    /// # Errors
    /// The place where they lie cannot be read.
    fn piece(&self, index: usize) -> Result<Cow<'_, [f64]>, Self::Fault>;

    /// Hands over every number in order.
    ///
    /// # Errors
    /// As [`Series::piece`].
    fn each(&self, mut take: impl FnMut(f64)) -> Result<(), Self::Fault>
    where
        Self: Sized,
    {
        for index in 0..self.count().div_ceil(PIECE) {
            self.piece(index)?.iter().for_each(|x| take(*x));
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

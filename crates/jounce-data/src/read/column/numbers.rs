//! Numbers of a column, in memory or in a scratch file.

use std::borrow::Cow;
use std::cell::RefCell;
use std::io;
use std::rc::Rc;

use crate::read::column::samples::{SampleStore, Scratch, StoredPiece};
use crate::recording::{PIECE, Series};

/// Numbers of a column.
#[derive(Debug)]
pub struct ColumnNumbers {
    store: NumberStore,
    /// For levels in decibels to be returned as linear values: decibels per factor of ten.
    levels: Option<f64>,
    /// Factor applied to stored numbers on reading.
    factor: f64,
}

#[derive(Debug)]
enum NumberStore {
    Memory(Vec<f64>),
    Scratch {
        scratch: Rc<RefCell<Scratch>>,
        pieces: Vec<StoredPiece>,
        last: Vec<f64>,
    },
}

impl ColumnNumbers {
    pub(in crate::read) fn new(store: &SampleStore) -> Self {
        let number_store = match store {
            SampleStore::Memory => NumberStore::Memory(Vec::new()),
            SampleStore::Scratch(scratch) => NumberStore::Scratch {
                scratch: Rc::clone(scratch),
                pieces: Vec::new(),
                last: Vec::new(),
            },
        };
        Self {
            store: number_store,
            levels: None,
            factor: 1.0,
        }
    }

    /// Appends a number; fails where the scratch file cannot be written.
    pub(in crate::read) fn push(&mut self, x: f64) -> io::Result<()> {
        match &mut self.store {
            NumberStore::Memory(numbers) => numbers.push(x),
            NumberStore::Scratch {
                scratch,
                pieces,
                last,
            } => {
                last.push(x);
                if last.len() == PIECE {
                    pieces.push(scratch.borrow_mut().store(last)?);
                }
            }
        }
        Ok(())
    }

    /// Reserves memory for more numbers, if they are stored in memory; false if there is not
    /// enough.
    pub(in crate::read) fn expect(&mut self, count: usize) -> bool {
        match &mut self.store {
            NumberStore::Memory(numbers) => numbers.try_reserve_exact(count).is_ok(),
            NumberStore::Scratch { .. } => true,
        }
    }

    /// Multiplies all returned numbers by a factor.
    pub(in crate::read) fn scale(&mut self, factor: f64) {
        match &mut self.store {
            NumberStore::Memory(numbers) if factor != 1.0 => {
                numbers.iter_mut().for_each(|x| *x *= factor)
            }
            NumberStore::Memory(_) => {}
            NumberStore::Scratch { .. } => self.factor *= factor,
        }
    }

    /// Returns the stored levels `L` as linear values `10^(L/decade)` in subsequent reads.
    pub(in crate::read) fn convert_levels(&mut self, decade: f64) {
        match &mut self.store {
            NumberStore::Memory(numbers) => numbers
                .iter_mut()
                .for_each(|level| *level = from_level(*level, decade)),
            NumberStore::Scratch { .. } => self.levels = Some(decade),
        }
    }

    /// First and last number.
    pub(in crate::read) fn first_and_last(&self) -> io::Result<Option<(f64, f64)>> {
        let Some(last) = self.count().checked_sub(1) else {
            return Ok(None);
        };
        let (head, tail) = (self.piece(0)?, self.piece(last / PIECE)?);
        Ok(head.first().copied().zip(tail.last().copied()))
    }

    /// True where both columns contain equal numbers.
    pub(in crate::read) fn equals(&self, other: &Self) -> io::Result<bool> {
        if self.count() != other.count() {
            return Ok(false);
        }
        for index in 0..self.count().div_ceil(PIECE) {
            if self.piece(index)? != other.piece(index)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Loads all numbers into memory.
    pub(in crate::read) fn into_vec(self) -> io::Result<Vec<f64>> {
        if let NumberStore::Memory(numbers) = self.store {
            return Ok(numbers);
        }
        let mut numbers = Vec::with_capacity(self.count());
        self.each(|x| numbers.push(x))?;
        Ok(numbers)
    }
}

impl From<Vec<f64>> for ColumnNumbers {
    fn from(numbers: Vec<f64>) -> Self {
        Self {
            store: NumberStore::Memory(numbers),
            levels: None,
            factor: 1.0,
        }
    }
}

impl Series for ColumnNumbers {
    type Fault = io::Error;

    fn count(&self) -> usize {
        match &self.store {
            NumberStore::Memory(numbers) => numbers.len(),
            NumberStore::Scratch { pieces, last, .. } => pieces.len() * PIECE + last.len(),
        }
    }

    fn piece(&self, index: usize) -> io::Result<Cow<'_, [f64]>> {
        let (scratch, pieces, last) = match &self.store {
            NumberStore::Memory(numbers) => {
                let from = (index * PIECE).min(numbers.len());
                return Ok(Cow::Borrowed(
                    &numbers[from..(from + PIECE).min(numbers.len())],
                ));
            }
            NumberStore::Scratch {
                scratch,
                pieces,
                last,
            } => (scratch, pieces, last),
        };
        let mut numbers = match pieces.get(index) {
            Some(StoredPiece::Memory(numbers)) => Cow::Borrowed(numbers.as_slice()),
            Some(StoredPiece::Scratch(offset)) => Cow::Owned(scratch.borrow_mut().load(*offset)?),
            None => Cow::Borrowed(last.as_slice()),
        };
        if let Some(decade) = self.levels {
            numbers
                .to_mut()
                .iter_mut()
                .for_each(|level| *level = from_level(*level, decade));
        }
        if self.factor != 1.0 {
            numbers.to_mut().iter_mut().for_each(|x| *x *= self.factor);
        }
        Ok(numbers)
    }
}

fn from_level(level: f64, decade: f64) -> f64 {
    10f64.powf(level / decade)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    /// Uses more numbers than fit in memory, written to two columns alternately.
    #[test]
    fn scratch_file_returns_the_stored_numbers() {
        let store = SampleStore::scratch();
        let (mut a, mut b) = (store.column(), store.column());
        let count = (3 << 20) + 77;
        for k in 0..count {
            a.push(f64::from(k)).unwrap();
            b.push(-f64::from(k)).unwrap();
        }
        b.scale(0.5);
        assert_eq!(
            (a.count(), a.first_and_last().unwrap()),
            (count as usize, Some((0.0, f64::from(count - 1))))
        );
        let (mut next, mut mismatches) = (0.0, 0);
        b.each(|x| {
            mismatches += usize::from(x != next);
            next -= 0.5;
        })
        .unwrap();
        assert_eq!(mismatches, 0);
        assert!(!a.equals(&b).unwrap());
        assert!(
            a.into_vec()
                .unwrap()
                .iter()
                .enumerate()
                .all(|(k, x)| *x == k as f64)
        );
    }
}

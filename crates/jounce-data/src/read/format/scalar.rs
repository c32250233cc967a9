//! Decoding of stored numbers to `f64`.

use std::io::{self, Read};

use half::f16;

use crate::read::error::Damage;

/// Bytes read at once: a multiple of every size of a number.
const BYTES_AT_ONCE: usize = 3 << 14;

/// Storage type of a number. Integers beyond 2^53 are rounded to the nearest `f64`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::read) struct Scalar {
    pub kind: Kind,
    /// Bytes of a number.
    pub size: usize,
    pub little_endian: bool,
}

/// Kinds of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::read) enum Kind {
    /// IEEE 754, of 2, 4 or 8 bytes.
    Float,
    /// Two's complement, of 1, 2, 3, 4 or 8 bytes.
    Signed,
    /// Without sign, of 1, 2, 3, 4 or 8 bytes.
    Unsigned,
}

impl Scalar {
    /// Returns the type of that kind and size; `None` if it does not exist.
    pub fn new(kind: Kind, size: usize, little_endian: bool) -> Option<Self> {
        let is_supported = matches!(
            (kind, size),
            (Kind::Float, 2 | 4 | 8) | (Kind::Signed | Kind::Unsigned, 1 | 2 | 3 | 4 | 8)
        );
        is_supported.then_some(Self {
            kind,
            size,
            little_endian,
        })
    }

    /// Decodes a number of [`Self::size`] bytes.
    pub fn number(self, bytes: &[u8]) -> f64 {
        let mut ordered = [0; 8];
        let size = self.size.min(bytes.len());
        ordered[..size].copy_from_slice(&bytes[..size]);
        if !self.little_endian {
            ordered[..size].reverse();
        }
        let bits = u64::from_le_bytes(ordered);
        match (self.kind, size) {
            (Kind::Float, 8) => f64::from_bits(bits),
            (Kind::Float, 4) => f64::from(f32::from_bits(bits as u32)),
            (Kind::Float, _) => f16::from_bits(bits as u16).to_f64(),
            (Kind::Unsigned, _) => bits as f64,
            (Kind::Signed, _) => {
                // Shift the sign bit to the top, then back, to extend the sign.
                let unused = 64 - 8 * size.clamp(1, 8) as u32;
                ((bits << unused) as i64 >> unused) as f64
            }
        }
    }

    /// Passes each of `count` numbers of a source to `callback`, in order.
    ///
    /// # Errors
    /// The source ends early, or `callback` fails.
    pub fn each(
        self,
        source: &mut dyn Read,
        count: u64,
        mut callback: impl FnMut(f64) -> io::Result<()>,
    ) -> Result<(), Damage> {
        let mut remaining = count.saturating_mul(self.size as u64);
        let mut bytes =
            vec![0; BYTES_AT_ONCE.min(usize::try_from(remaining).unwrap_or(BYTES_AT_ONCE))];
        while remaining > 0 {
            let expected = bytes
                .len()
                .min(usize::try_from(remaining).unwrap_or(BYTES_AT_ONCE));
            source
                .read_exact(&mut bytes[..expected])
                .map_err(Damage::cut)?;
            bytes[..expected]
                .chunks_exact(self.size)
                .try_for_each(|number| callback(self.number(number)))?;
            remaining -= expected as u64;
        }
        Ok(())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_number_is_read_in_both_orders() {
        let cases: [(Kind, &[u8], f64); 13] = [
            (Kind::Signed, &[0x01, 0x00, 0x80], -8_388_607.0),
            (Kind::Unsigned, &[0x01, 0x00, 0x80], 8_388_609.0),
            (Kind::Float, &(-2.5e-300_f64).to_le_bytes(), -2.5e-300),
            (Kind::Float, &1.1_f32.to_le_bytes(), f64::from(1.1_f32)),
            (Kind::Float, &0xc500_u16.to_le_bytes(), -5.0),
            (Kind::Signed, &[0xfe], -2.0),
            (Kind::Signed, &(-300_i16).to_le_bytes(), -300.0),
            (Kind::Signed, &(-70_000_i32).to_le_bytes(), -70_000.0),
            (Kind::Signed, &(-5_000_000_000_i64).to_le_bytes(), -5e9),
            (Kind::Unsigned, &[0xfe], 254.0),
            (Kind::Unsigned, &65_535_u16.to_le_bytes(), 65_535.0),
            (Kind::Unsigned, &u32::MAX.to_le_bytes(), 4_294_967_295.0),
            (
                Kind::Unsigned,
                &(1_u64 << 63).to_le_bytes(),
                9_223_372_036_854_775_808.0,
            ),
        ];
        for (kind, bytes, expected) in cases {
            let reversed: Vec<u8> = bytes.iter().rev().copied().collect();
            assert_eq!(
                Scalar::new(kind, bytes.len(), true).unwrap().number(bytes),
                expected,
                "{kind:?}"
            );
            assert_eq!(
                Scalar::new(kind, bytes.len(), false)
                    .unwrap()
                    .number(&reversed),
                expected,
                "{kind:?}"
            );
        }
        assert_eq!(Scalar::new(Kind::Float, 3, true), None);
    }

    #[test]
    fn a_source_that_ends_early_is_an_error() {
        let four = Scalar::new(Kind::Signed, 2, true).unwrap();
        let mut result = Vec::new();
        let mut callback = |x| {
            result.push(x);
            Ok(())
        };
        four.each(&mut [1, 0, 2, 0].as_slice(), 2, &mut callback)
            .unwrap();
        assert!(
            four.each(&mut [1, 0, 2].as_slice(), 2, &mut callback)
                .is_err()
        );
        assert_eq!(result, [1.0, 2.0]);
    }
}

//! Layout of the numbers in the elements of an HDF5 type.

use std::io;

use hdf5_pure::{Datatype, DatatypeByteOrder};

use crate::read::column::numbers::ColumnNumbers;
use crate::read::format::arrays::ArrayLayout;
use crate::read::format::scalar::{Kind, Scalar};

/// Layout of numbers in the bytes of an element.
pub(super) struct Stored {
    pub scalar: Scalar,
    /// Bytes of an element.
    pub width: usize,
    real: usize,
    pub imaginary: Option<usize>,
}

impl Stored {
    /// Returns the layout of the numbers of a type, `None` for other types. A pair of numbers is
    /// complex.
    pub(super) fn of(datatype: &Datatype) -> Option<Self> {
        match datatype {
            Datatype::Enumeration { base_type, .. } => scalar_of(base_type).map(Self::real),
            Datatype::Compound { size, members } => {
                let [a, b] = &members[..] else { return None };
                let scalar = scalar_of(&a.datatype)
                    .filter(|scalar| scalar_of(&b.datatype) == Some(*scalar))?;
                let (width, real, imaginary) = (
                    *size as usize,
                    a.byte_offset as usize,
                    b.byte_offset as usize,
                );
                let has_real_name = ["r", "re", "real"].contains(&a.name.to_lowercase().as_str());
                let fits_width = real
                    .max(imaginary)
                    .checked_add(scalar.size)
                    .is_some_and(|end| end <= width);
                (has_real_name && fits_width).then_some(Self {
                    scalar,
                    width,
                    real,
                    imaginary: Some(imaginary),
                })
            }
            _ => scalar_of(datatype).map(Self::real),
        }
    }

    /// Elements that are one real number.
    fn real(scalar: Scalar) -> Self {
        Self {
            scalar,
            width: scalar.size,
            real: 0,
            imaginary: None,
        }
    }

    /// Appends the number of an element to its series, and its imaginary part to that of the other.
    pub(super) fn push(
        &self,
        element: &[u8],
        layout: &ArrayLayout,
        number: u64,
        series: &mut [ColumnNumbers],
        imaginary: Option<&mut Vec<ColumnNumbers>>,
    ) -> io::Result<()> {
        let number_at = |from: usize| self.scalar.number(element.get(from..).unwrap_or_default());
        layout.push(series, number, number_at(self.real))?;
        if let Some((from, series)) = self.imaginary.zip(imaginary) {
            layout.push(series, number, number_at(from))?;
        }
        Ok(())
    }
}

/// Integers of full precision and floating-point numbers of IEEE 754, of 2, 4 and 8 bytes.
fn scalar_of(datatype: &Datatype) -> Option<Scalar> {
    let order = |order: &DatatypeByteOrder| match order {
        DatatypeByteOrder::LittleEndian => Some(true),
        DatatypeByteOrder::BigEndian => Some(false),
        DatatypeByteOrder::Vax => None,
    };
    match datatype {
        Datatype::FixedPoint {
            size,
            byte_order,
            layout,
        } => {
            let has_full_precision =
                layout.bit_offset == 0 && u32::from(layout.bit_precision) == 8 * size;
            let kind = if layout.signed {
                Kind::Signed
            } else {
                Kind::Unsigned
            };
            Scalar::new(kind, *size as usize, order(byte_order)?).filter(|_| has_full_precision)
        }
        Datatype::FloatingPoint {
            size,
            byte_order,
            layout,
        } => {
            let ieee = [(2, 5, 10), (4, 8, 23), (8, 11, 52)].contains(&(
                *size,
                layout.exponent_size,
                layout.mantissa_size,
            ));
            Scalar::new(Kind::Float, *size as usize, order(byte_order)?).filter(|_| ieee)
        }
        _ => None,
    }
}

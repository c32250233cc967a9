//! RMS, peak and mean of a complex channel.

use crate::recording::{PIECE, Series, Sizes};

/// RMS and peak of `|z|` and the modulus of the mean of `z`, over samples whose two parts are
/// numbers; `real` unchanged without an imaginary part.
pub(crate) fn sizes_with<S: Series>(
    real: Sizes,
    values: &S,
    imaginary: Option<&S>,
) -> Result<Sizes, S::Fault> {
    let Some(imaginary) = imaginary else {
        return Ok(real);
    };
    let (mut square_sum, mut count, mut peak, mut sum) = (0.0, 0.0, 0.0_f64, [0.0_f64; 2]);
    for index in 0..values.count().div_ceil(PIECE) {
        for (re, im) in values
            .piece(index)?
            .iter()
            .zip(imaginary.piece(index)?.iter())
        {
            if re.is_finite() && im.is_finite() {
                square_sum += re * re + im * im;
                count += 1.0;
                sum = [sum[0] + re, sum[1] + im];
                peak = peak.max(re.hypot(*im));
            }
        }
    }
    let numbers = f64::max(count, 1.0);
    Ok(Sizes {
        rms: f64::sqrt(square_sum / numbers),
        peak,
        mean: sum[0].hypot(sum[1]) / numbers,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    /// 3 + 4 j and 0 - 5 j have the magnitude 5; samples that are not numbers are ignored.
    #[test]
    fn a_complex_channel_is_as_large_as_its_absolute_value() {
        let (re, im) = ([3.0, 0.0, f64::NAN, 1.0], [4.0, -5.0, 1.0, f64::NAN]);
        let sizes = sizes_with(Sizes::of(&re), &&re[..], Some(&&im[..])).unwrap();
        assert_eq!(
            (sizes.rms, sizes.peak, sizes.mean),
            (5.0, 5.0, 1.5_f64.hypot(0.5))
        );
        let real = sizes_with(Sizes::of(&[3.0, 4.0]), &&re[..2], None).unwrap();
        assert_eq!((real.rms, real.peak), (12.5_f64.sqrt(), 4.0));
    }
}

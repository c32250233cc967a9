//! Poincare section of a record: one value per drive cycle.

use jounce_signal::Samples;

use super::cycles::cubic;

/// Values at one phase of the drive.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// Times, s from the first sample.
    pub time_s: Vec<f64>,
    /// Values, in the unit of the record.
    pub value: Vec<f64>,
}

/// Computes `x(t_1 + n / f)` for every integer `n`, with cubic interpolation between samples; `t_1`
/// is the second sample. A solution of `m` drive cycles shows `m` values in turn.
pub fn section(samples: &Samples<'_>, drive_hz: f64) -> Section {
    let (values, rate_hz) = (samples.values(), samples.rate_hz());
    let position = |n: usize| 1.0 + n as f64 * rate_hz / drive_hz;
    let positions = (0..)
        .map(position)
        .take_while(|x| x.floor() as usize + 2 < values.len());
    let (time_s, value) = positions
        .map(|x| {
            let k = x.floor() as usize;
            (x / rate_hz, cubic(&values[k - 1..k + 3], x.fract()))
        })
        .unzip();
    Section { time_s, value }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// A third of the drive: three values in turn, those of the formula; measured 2e-6, the cubic
    /// between samples 114 to a cycle.
    #[test]
    fn subharmonic_repeats_its_section_values() {
        let (rate, hz) = (1536.0, 13.5);
        let at = |t: f64| (TAU * hz * t).cos() + 0.7 * (TAU * hz / 3.0 * t).sin();
        let values: Vec<f64> = (0..20_000).map(|k| at(f64::from(k) / rate)).collect();
        let result = section(&Samples::new(&values, rate).unwrap(), hz);
        assert_eq!(result.value.len(), 176);
        let max_error = result
            .value
            .iter()
            .enumerate()
            .map(|(n, x)| (x - at(1.0 / rate + (n % 3) as f64 / hz)).abs())
            .fold(0.0, f64::max);
        eprintln!("off by {max_error:.1e}");
        assert!(max_error < 1e-5, "{max_error:e}");
    }
}

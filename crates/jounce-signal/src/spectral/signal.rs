//! Channel as a signal.

use crate::Samples;

use super::SpectralError;
use jounce_data::recording::{Channel, Quantity, Recording};

/// Magnitude up to which a sum of squares of all samples is a number.
const MAX_MAGNITUDE: f64 = 1e145;

/// Returns the samples of a channel with a signal.
///
/// # Errors
/// All samples are equal, as from a disconnected sensor; no sample, or one that is not a number or
/// too large for sums of squares.
pub fn signal(channel: &Channel, rate_hz: f64) -> Result<Samples<'_>, SpectralError> {
    let samples = Samples::new(&channel.values, rate_hz)?;
    let too_large = |value: &f64| value.abs() > MAX_MAGNITUDE;
    if let Some(sample) = channel.values.iter().position(too_large) {
        return Err(SpectralError::Overflow {
            channel: channel.name.clone(),
            sample,
            value: channel.values[sample],
        });
    }
    match samples.values() {
        [first, rest @ ..] if rest.iter().all(|x| x == first) => Err(SpectralError::Constant {
            channel: channel.name.clone(),
            samples: channel.values.len(),
            value: *first,
        }),
        _ => Ok(samples),
    }
}

/// First channel of a quantity with a signal, else the first channel with a signal, else the first
/// channel of the quantity, else the first channel.
pub fn first_varying(record: &Recording, quantity: Quantity) -> Option<&Channel> {
    let is_varying = |channel: &&Channel| signal(channel, record.rate()).is_ok();
    let all = || record.channels.iter();
    let of_quantity = |channel: &&Channel| channel.quantity == quantity;
    all()
        .filter(of_quantity)
        .find(is_varying)
        .or_else(|| all().find(is_varying))
        .or_else(|| all().find(of_quantity))
        .or(record.channels.first())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use jounce_data::recording::{Grid, Over};

    #[test]
    fn first_varying_channel_is_the_default() {
        let default_channel = |channels: &[(&str, Quantity, f64)]| {
            let channel = |(name, quantity, last): &(&str, Quantity, f64)| {
                Channel::new(name, *quantity, "", vec![1.0, 1.0, *last])
            };
            let channels = channels.iter().map(channel).collect();
            let grid = Grid::even(0.0, 1.0, 3).unwrap();
            let record = Recording {
                name: "r".to_owned(),
                over: Over::Time,
                grid,
                channels,
                issues: Vec::new(),
            };
            first_varying(&record, Quantity::Voltage).map(|channel| channel.name.clone())
        };
        let (volts, motion) = (Quantity::Voltage, Quantity::Acceleration);
        assert_eq!(
            default_channel(&[("a", motion, 2.0), ("dead", volts, 1.0), ("v", volts, 3.0)])
                .as_deref(),
            Some("v")
        );
        assert_eq!(
            default_channel(&[("dead", volts, 1.0), ("a", motion, 2.0)]).as_deref(),
            Some("a")
        );
        assert_eq!(
            default_channel(&[("a", motion, 1.0), ("dead", volts, 1.0)]).as_deref(),
            Some("dead")
        );
        assert_eq!(default_channel(&[]), None);
    }

    #[test]
    fn constant_channel_is_no_signal() {
        let channel = |values: Vec<f64>| Channel::new("mfc", Quantity::Voltage, "V", values);
        assert_eq!(
            signal(&channel(vec![1.5, 1.5, 1.25]), 10.0)
                .unwrap()
                .values(),
            [1.5, 1.5, 1.25]
        );
        let message = signal(&channel(vec![1.5; 300]), 10.0)
            .unwrap_err()
            .to_string();
        assert_eq!(
            message,
            "all 300 samples of mfc are 1.5: there is no signal; is it the right channel, and was its sensor connected?"
        );
        assert!(matches!(
            signal(&channel(Vec::new()), 10.0),
            Err(SpectralError::Signal(_))
        ));
    }
}

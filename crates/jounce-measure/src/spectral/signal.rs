//! A channel as a signal.

use jounce::signal::Samples;

use super::SpectralError;
use crate::recording::Channel;

/// The samples of a channel that shows a signal.
///
/// # Errors
/// All samples are equal, as those of a sensor that was not connected; no sample, or one that is no number.
pub fn signal(channel: &Channel, rate_hz: f64) -> Result<Samples<'_>, SpectralError> {
    let samples = Samples::new(&channel.values, rate_hz)?;
    match samples.values() {
        [first, rest @ ..] if rest.iter().all(|x| x == first) => {
            Err(SpectralError::Constant { channel: channel.name.clone(), samples: channel.values.len(), value: *first })
        }
        _ => Ok(samples),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::recording::Quantity;

    #[test]
    fn a_channel_that_never_moves_is_no_signal() {
        let channel = |values: Vec<f64>| Channel::new("mfc", Quantity::Voltage, "V", values);
        assert_eq!(signal(&channel(vec![1.5, 1.5, 1.25]), 10.0).unwrap().values(), [1.5, 1.5, 1.25]);
        let told = signal(&channel(vec![1.5; 300]), 10.0).unwrap_err().to_string();
        assert_eq!(told, "all 300 samples of mfc are 1.5: there is no signal; is it the right channel, and was its sensor connected?");
        assert!(matches!(signal(&channel(Vec::new()), 10.0), Err(SpectralError::Signal(_))));
    }
}

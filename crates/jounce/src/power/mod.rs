//! Mean power of recorded voltages.

mod options;
mod report;
mod result;

pub use options::PowerOptions;
pub use result::{OrderAmplitude, PowerRecord, PowerResult};

use crate::error::Error;
use crate::options::check_drive;
use crate::recording::Recording;
use jounce_signal::spectral::{SpectralError, mean_power, signal};
use jounce_signal::{Samples, Window};

/// Multiples of the drive frequency whose amplitudes are reported.
const REPORTED_ORDERS: [f64; 8] = [0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0];

impl Recording {
    /// Computes the mean power of the voltage of each recording over its load, with a confidence
    /// interval that accounts for correlation. Samples that are missing in a recording do not count.
    ///
    /// # Errors
    /// [`Error::Option`], [`Error::NoChannel`] and [`Error::Channel`] for a channel that does not
    /// exist or does not suit, [`Error::Spectral`] for a record without a signal or too short.
    ///
    /// ```
    /// use jounce::parts::{Grid, Over, RawChannel};
    /// use jounce::{PowerOptions, Recording};
    /// let volts: Vec<f64> = (0..5120).map(|k| (0.1 * f64::from(k)).sin()).collect();
    /// let channels = vec![RawChannel::new("patch", "V", volts)];
    /// let grid = Grid::Even { start: 0.0, step: 1e-3, count: 5120 };
    /// let recording = Recording::from_arrays("test", Over::Time, grid, channels)?;
    /// let options = PowerOptions { resistance_ohm: vec![1e3], ..Default::default() };
    /// let result = Recording::power(&[recording], &options)?;
    /// assert!((result.records[0].power.mean_power_w / 0.5e-3 - 1.0).abs() < 1e-2);
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn power(recordings: &[Self], options: &PowerOptions) -> Result<PowerResult, Error> {
        let resistances = options.resistances(recordings.len())?;
        let records = recordings.iter().zip(resistances);
        let records = records.map(|(recording, ohm)| recording.power_record(ohm, options));
        Ok(PowerResult {
            records: records.collect::<Result<_, _>>()?,
            drive_hz: options.drive_hz,
        })
    }

    fn power_record(
        &self,
        resistance_ohm: f64,
        options: &PowerOptions,
    ) -> Result<PowerRecord, Error> {
        let record = self.load(options)?;
        let voltage = &record.channels[0];
        let samples = signal(voltage, record.rate())?;
        // Interpolated samples have no power of their own.
        let measured = self.measured_values(options, &record, 0)?;
        let measured = Samples::new(&measured, record.rate()).map_err(SpectralError::from)?;
        let power = mean_power(&measured, resistance_ohm, options.remove_mean)?;
        let mean_square = match record.channels.get(1) {
            None => None,
            Some(base) => {
                signal(base, record.rate())?;
                let base = self.measured_values(options, &record, 1)?;
                let base = Samples::new(&base, record.rate()).map_err(SpectralError::from)?;
                Some(base.rms().powi(2) - base.mean().powi(2))
            }
        };
        self.check_stop()?;
        let orders = match options.drive_hz {
            None => Vec::new(),
            Some(drive_hz) => {
                check_drive(drive_hz, record.rate(), (0.5, "half"))?;
                orders(&samples, drive_hz)?
            }
        };
        self.check_stop()?;
        let spectrum = options.spectra.then(|| samples.spectrum(Window::Hann));
        self.check_stop()?;
        Ok(PowerRecord {
            name: record.name.clone(),
            channel: voltage.name.clone(),
            resistance_ohm,
            power,
            mean_square_base_acceleration_m2_s4: mean_square,
            mean_power_per_mean_square_w_s4_m2: mean_square
                .map(|square| power.mean_power_w / square),
            orders,
            spectrum,
            issues: record.issues,
        })
    }

    /// Fails where the control has stopped.
    fn check_stop(&self) -> Result<(), Error> {
        if self.control().is_stopped() {
            Err(Error::Stopped)
        } else {
            Ok(())
        }
    }
}

/// Returns the amplitudes at the multiples of a drive below half the sampling rate.
fn orders(samples: &Samples<'_>, drive_hz: f64) -> Result<Vec<OrderAmplitude>, Error> {
    let resolved: Vec<f64> = REPORTED_ORDERS
        .into_iter()
        .filter(|order| order * drive_hz < 0.5 * samples.rate_hz())
        .collect();
    let orders = samples.orders(drive_hz, &resolved);
    let orders = orders.map_err(SpectralError::from)?;
    Ok(orders.lines.iter().map(OrderAmplitude::of).collect())
}

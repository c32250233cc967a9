//! Decimates a long recording for plotting while preserving its envelope.

use std::io;

use crate::read::summary::RecordingSummary;
use crate::recording::{Over, PIECE, Series};

/// Decimated points of the first channels of a recording.
#[derive(Debug, Clone, PartialEq)]
pub struct DecimatedRecording {
    /// Positions of the points, s or Hz.
    pub places: Vec<f64>,
    /// Points of each channel: samples over time, magnitudes over frequency.
    pub channels: Vec<Vec<f64>>,
}

impl RecordingSummary {
    /// Decimates the first channels to at most `most` points each. Returns all samples if they fit,
    /// else the minimum and maximum of each of `most / 2` segments, in order.
    ///
    /// # Errors
    /// The scratch file cannot be read.
    pub fn decimate(&self, channels: usize, most: usize) -> io::Result<DecimatedRecording> {
        let count = self.places.count();
        let interval = if count <= most {
            1
        } else {
            count.div_ceil((most / 2).max(1))
        };
        let (mut places, mut number) = (Vec::new(), 0);
        self.places.each(|place| {
            let index_in_interval = number % interval;
            if index_in_interval == 0 || index_in_interval == interval / 2 {
                places.push(place);
            }
            number += 1;
        })?;
        let mut decimated = Vec::new();
        for channel in self.channels.iter().take(channels) {
            let mut points = DecimatedPoints {
                interval,
                index_in_interval: 0,
                lowest: (f64::NAN, 0),
                highest: (f64::NAN, 0),
                found: Vec::new(),
            };
            for index in 0..count.div_ceil(PIECE) {
                let real = channel.values.piece(index)?;
                let imaginary = channel
                    .imaginary
                    .as_ref()
                    .filter(|_| self.over == Over::Frequency);
                let imaginary = imaginary
                    .map(|imaginary| imaginary.piece(index))
                    .transpose()?;
                for (k, x) in real.iter().enumerate() {
                    let imaginary_value = imaginary.as_ref().and_then(|imaginary| imaginary.get(k));
                    points.add(if self.over == Over::Time {
                        *x
                    } else {
                        x.hypot(imaginary_value.copied().unwrap_or(0.0))
                    });
                }
            }
            points.close();
            points.found.truncate(places.len());
            decimated.push(points.found);
        }
        Ok(DecimatedRecording {
            places,
            channels: decimated,
        })
    }
}

/// Points of a channel so far.
struct DecimatedPoints {
    interval: usize,
    /// Samples of the current segment, and its minimum and maximum with their indices.
    index_in_interval: usize,
    lowest: (f64, usize),
    highest: (f64, usize),
    found: Vec<f64>,
}

impl DecimatedPoints {
    fn add(&mut self, x: f64) {
        // Any number replaces NaN.
        if self.index_in_interval == 0 || x < self.lowest.0 || self.lowest.0.is_nan() {
            self.lowest = (x, self.index_in_interval);
        }
        if self.index_in_interval == 0 || x > self.highest.0 || self.highest.0.is_nan() {
            self.highest = (x, self.index_in_interval);
        }
        self.index_in_interval += 1;
        if self.index_in_interval == self.interval {
            self.close();
        }
    }

    fn close(&mut self) {
        if self.index_in_interval == 0 {
            return;
        }
        let (lowest, highest) = (self.lowest, self.highest);
        match self.interval {
            1 => self.found.push(lowest.0),
            _ if lowest.1 < highest.1 => self.found.extend([lowest.0, highest.0]),
            _ => self.found.extend([highest.0, lowest.0]),
        }
        self.index_in_interval = 0;
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::recording::{Channel, Grid, Quantity, Recording};

    fn decimate(values: Vec<f64>, most: usize) -> DecimatedRecording {
        let grid = Grid::even(0.0, 1.0, values.len()).unwrap();
        let channels = vec![Channel::new("a", Quantity::Voltage, "V", values)];
        let recording = Recording {
            name: "r".into(),
            over: Over::Time,
            grid,
            channels,
            issues: Vec::new(),
        };
        RecordingSummary::from(recording).decimate(8, most).unwrap()
    }

    #[test]
    fn short_records_are_complete_and_long_ones_retain_their_extremes() {
        let values: Vec<f64> = (0..10_007).map(|k| f64::from(k * 7919 % 10_007)).collect();
        assert_eq!(decimate(values.clone(), 20_000).channels[0], values);
        let decimated = decimate(values.clone(), 1000);
        assert!(
            decimated.places.len() <= 1000 && decimated.places.len() == decimated.channels[0].len(),
            "{}",
            decimated.places.len()
        );
        for (k, interval) in values.chunks(21).take(400).enumerate() {
            let pair = &decimated.channels[0][2 * k..2 * k + 2];
            let extreme_value =
                |choose: fn(f64, f64) -> f64| interval.iter().copied().fold(interval[0], choose);
            assert_eq!(
                (pair[0].min(pair[1]), pair[0].max(pair[1])),
                (extreme_value(f64::min), extreme_value(f64::max)),
                "{k}"
            );
            assert_eq!(decimated.places[2 * k], 21.0 * k as f64);
        }
    }
}

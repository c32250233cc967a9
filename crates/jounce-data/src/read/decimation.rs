//! Decimates a long recording for plotting while preserving its envelope.

use std::io;

use super::summary::RecordingSummary;
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
    pub fn outline(&self, channels: usize, most: usize) -> io::Result<DecimatedRecording> {
        let count = self.places.count();
        let stretch = if count <= most {
            1
        } else {
            count.div_ceil((most / 2).max(1))
        };
        let (mut places, mut number) = (Vec::new(), 0);
        self.places.each(|place| {
            let inside = number % stretch;
            if inside == 0 || inside == stretch / 2 {
                places.push(place);
            }
            number += 1;
        })?;
        let mut drawn = Vec::new();
        for channel in self.channels.iter().take(channels) {
            let mut points = DecimatedPoints {
                stretch,
                inside: 0,
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
                    let beside = imaginary.as_ref().and_then(|imaginary| imaginary.get(k));
                    points.take(if self.over == Over::Time {
                        *x
                    } else {
                        x.hypot(beside.copied().unwrap_or(0.0))
                    });
                }
            }
            points.close();
            points.found.truncate(places.len());
            drawn.push(points.found);
        }
        Ok(DecimatedRecording {
            places,
            channels: drawn,
        })
    }
}

/// Points of a channel so far.
struct DecimatedPoints {
    stretch: usize,
    /// Samples of the current segment, and its minimum and maximum with their indices.
    inside: usize,
    lowest: (f64, usize),
    highest: (f64, usize),
    found: Vec<f64>,
}

impl DecimatedPoints {
    fn take(&mut self, x: f64) {
        // Any number replaces NaN.
        if self.inside == 0 || x < self.lowest.0 || self.lowest.0.is_nan() {
            self.lowest = (x, self.inside);
        }
        if self.inside == 0 || x > self.highest.0 || self.highest.0.is_nan() {
            self.highest = (x, self.inside);
        }
        self.inside += 1;
        if self.inside == self.stretch {
            self.close();
        }
    }

    fn close(&mut self) {
        if self.inside == 0 {
            return;
        }
        let (lowest, highest) = (self.lowest, self.highest);
        match self.stretch {
            1 => self.found.push(lowest.0),
            _ if lowest.1 < highest.1 => self.found.extend([lowest.0, highest.0]),
            _ => self.found.extend([highest.0, lowest.0]),
        }
        self.inside = 0;
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::recording::{Channel, Grid, Quantity, Recording};

    fn outline(values: Vec<f64>, most: usize) -> DecimatedRecording {
        let grid = Grid::even(0.0, 1.0, values.len()).unwrap();
        let channels = vec![Channel::new("a", Quantity::Voltage, "V", values)];
        let recording = Recording {
            name: "r".into(),
            over: Over::Time,
            grid,
            channels,
            findings: Vec::new(),
        };
        RecordingSummary::from(recording).outline(8, most).unwrap()
    }

    #[test]
    fn a_short_record_is_whole_and_a_long_one_keeps_its_extremes() {
        let values: Vec<f64> = (0..10_007).map(|k| f64::from(k * 7919 % 10_007)).collect();
        assert_eq!(outline(values.clone(), 20_000).channels[0], values);
        let thin = outline(values.clone(), 1000);
        assert!(
            thin.places.len() <= 1000 && thin.places.len() == thin.channels[0].len(),
            "{}",
            thin.places.len()
        );
        for (k, stretch) in values.chunks(21).take(400).enumerate() {
            let pair = &thin.channels[0][2 * k..2 * k + 2];
            let extreme =
                |pick: fn(f64, f64) -> f64| stretch.iter().copied().fold(stretch[0], pick);
            assert_eq!(
                (pair[0].min(pair[1]), pair[0].max(pair[1])),
                (extreme(f64::min), extreme(f64::max)),
                "{k}"
            );
            assert_eq!(thin.places[2 * k], 21.0 * k as f64);
        }
    }
}

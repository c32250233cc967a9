//! Excitation of one port by the signals.

use super::cursor::SignalCursor;
use super::row::{ExcitationRow, ExcitationSeries};
use jounce_model::plant::{Plant, Port, SignalSample};
use std::sync::Arc;

/// Excitation of one port by the signals.
#[derive(Debug, Clone)]
pub struct PortExcitation {
    pub reading: Arc<ExcitationRow>,
    pub series: ExcitationSeries,
    /// Displacement per displacement of the base that each signal moves; empty where both sides of
    /// a stop are on one base.
    pub approach: Vec<f64>,
    /// Contribution of the bases to the series: a cubic.
    course: [f64; 4],
}

impl PortExcitation {
    /// Reads a port of a plant; the excitation is zero until the first [`Self::follow`].
    pub fn of(plant: &Plant, port: &Port) -> Self {
        let approach = if port.approach.iter().all(|share| *share == 0.0) {
            Vec::new()
        } else {
            port.approach.clone()
        };
        Self {
            reading: Arc::new(ExcitationRow::of(plant, &port.displacement)),
            series: ExcitationSeries::ZERO,
            approach,
            course: [0.0; 4],
        }
    }

    /// Adds the motions of the bases from a time on to the series.
    pub fn follow(&mut self, cursors: &[SignalCursor], sizes: &[SignalSample], time_s: f64) {
        self.course = [0.0; 4];
        for ((cursor, [size, slope]), share) in cursors.iter().zip(sizes).zip(&self.approach) {
            let Some(travel) = &cursor.travel else {
                continue;
            };
            let [displacement, speed] = travel.at(cursor.index, &cursor.piece, time_s);
            let motion = [displacement, speed, 0.5 * size, slope / 6.0];
            self.course
                .iter_mut()
                .zip(motion)
                .for_each(|(sum, c)| *sum += share * c);
        }
        self.series.add(&self.course);
    }

    /// Returns the speed of the bases towards the stop, a time after the current one, m/s.
    pub fn base_speed_m_s(&self, after_s: f64) -> f64 {
        let [_, speed, half, sixth] = self.course;
        speed + after_s * (2.0 * half + after_s * 3.0 * sixth)
    }
}

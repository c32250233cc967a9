//! Force pulses of contacts and the laws fitted to them.

use jounce::picture::{Axis, Colour, Figure, Marker, Panel, Series};

/// The samples of one pulse, and the law fitted to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Pulse {
    /// Name in the legend.
    pub label: String,
    /// Time of each sample, s from the largest force.
    pub time_s: Vec<f64>,
    /// Force, N.
    pub force_n: Vec<f64>,
    /// Times and forces of the law; empty where none was fitted.
    pub law: (Vec<f64>, Vec<f64>),
}

/// Pulses in one panel: rings for samples, lines for laws.
pub fn pulses(title: &str, pulses: &[Pulse]) -> Figure {
    let panel = Panel::new(Axis::linear("Time from the largest force", "s"), Axis::linear("Force", "N")).high(340.0);
    let drawn = |panel: Panel, (index, pulse): (usize, &Pulse)| {
        let colour = Colour::nth(index);
        let samples = Series::points(pulse.time_s.clone(), pulse.force_n.clone(), Marker::Ring).colour(colour).label(&pulse.label);
        panel.with(samples).with(Series::line(pulse.law.0.clone(), pulse.law.1.clone()).colour(colour))
    };
    Figure::new(title).with(pulses.iter().enumerate().fold(panel, drawn))
}

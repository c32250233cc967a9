//! Force pulses of contacts and the laws fitted to them.

use jounce_plot::{Axis, Colour, Figure, Marker, Panel, Series};
use jounce_signal::Samples;

use jounce_identification::contact::ContactFit;
use jounce_signal::spectral::Hit;

/// Points of a law per sample of the pulse.
const POINTS_PER_SAMPLE: usize = 20;

/// Samples of one pulse, and the law fitted to it.
#[derive(Debug, Clone, PartialEq)]
pub struct PulseFigure {
    /// Name in the legend.
    pub label: String,
    /// Time of each sample, s from the peak force.
    pub time_s: Vec<f64>,
    /// Force, N.
    pub force_n: Vec<f64>,
    /// Times and forces of the law; empty without a fitted law.
    pub law: (Vec<f64>, Vec<f64>),
}

impl PulseFigure {
    /// Returns the samples of a hit, extended by half its length on both sides, with the law.
    pub fn of(force: &Samples<'_>, hit: &Hit, law: Option<&ContactFit>) -> Self {
        let margin = (hit.end - hit.start) / 2 + 1;
        let (first, last) = (
            hit.start.saturating_sub(margin),
            (hit.end + margin).min(force.values().len()),
        );
        let at = |k: f64| k / force.rate_hz();
        let peak_s = at(hit.peak as f64);
        let fine_time: Vec<f64> = (first * POINTS_PER_SAMPLE..=(last - 1) * POINTS_PER_SAMPLE)
            .map(|k| at(k as f64 / POINTS_PER_SAMPLE as f64))
            .collect();
        Self {
            label: format!("{peak_s:.4} s"),
            time_s: (first..last).map(|k| at(k as f64) - peak_s).collect(),
            force_n: force.values()[first..last].to_vec(),
            law: law.map_or_else(Default::default, |law| {
                (
                    fine_time.iter().map(|t| t - peak_s).collect(),
                    law.force_n(&fine_time),
                )
            }),
        }
    }
}

/// Plots pulses in one panel: rings for samples, lines for laws.
pub fn pulses(title: &str, pulses: &[PulseFigure]) -> Figure {
    let panel = Panel::new(
        Axis::linear("Time from the largest force", "s"),
        Axis::linear("Force", "N"),
    )
    .high(340.0);
    let with_pulse = |panel: Panel, (index, pulse): (usize, &PulseFigure)| {
        let colour = Colour::nth(index);
        let samples = Series::points(pulse.time_s.clone(), pulse.force_n.clone(), Marker::Ring)
            .colour(colour)
            .label(&pulse.label);
        panel
            .with(samples)
            .with(Series::line(pulse.law.0.clone(), pulse.law.1.clone()).colour(colour))
    };
    Figure::new(title).with(pulses.iter().enumerate().fold(panel, with_pulse))
}

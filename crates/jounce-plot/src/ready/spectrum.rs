//! Amplitude spectra with the multiples of the drive frequency marked.

use crate::{Along, Axis, Colour, Figure, Line, Panel, Scale, Series};

/// One spectrum.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumLine {
    /// Name in the legend; omitted if there is only one spectrum.
    pub label: String,
    /// Frequency of each line, Hz.
    pub frequency_hz: Vec<f64>,
    /// Peak amplitude of each line.
    pub amplitude_peak: Vec<f64>,
}

/// Draws spectra of one quantity (`Voltage`, `V`), up to the end of their frequencies, one panel
/// each with equal axes. If a drive frequency is given, its multiples are marked and numbered above
/// the frames, as far as there is room.
pub fn spectra(
    title: &str,
    quantity: &str,
    unit: &str,
    scale: Scale,
    lines: &[SpectrumLine],
    drive_hz: Option<f64>,
) -> Figure {
    let y = Axis::of(scale, &format!("{quantity}, peak"), unit);
    let height_px = if lines.len() > 1 { 200.0 } else { 320.0 };
    let mut axes = Panel::new(Axis::linear("Frequency", "Hz"), y).high(height_px);
    let highest_hz = lines
        .iter()
        .flat_map(|line| &line.frequency_hz)
        .copied()
        .filter(|f| f.is_finite())
        .fold(0.0, f64::max);
    for order in orders(drive_hz, highest_hz) {
        let label = if order == 1 {
            "drive".to_owned()
        } else {
            format!("{order}×")
        };
        axes = axes.reference(
            Along::X,
            f64::from(order) * drive_hz.unwrap_or(0.0),
            Some(&label),
        );
    }
    let panel = |(index, line): (usize, &SpectrumLine)| {
        let series = Series::line(line.frequency_hz.clone(), line.amplitude_peak.clone())
            .colour(Colour::nth(index))
            .style(Line::Thin);
        axes.clone().with(if lines.len() > 1 {
            series.label(&line.label)
        } else {
            series
        })
    };
    Figure {
        panels: lines.iter().enumerate().map(panel).collect(),
        ..Figure::new(title)
    }
}

/// Returns the multiples of the drive in the picture; empty if their spacing is below a fortieth of
/// it.
fn orders(drive_hz: Option<f64>, highest_hz: f64) -> std::ops::RangeInclusive<u32> {
    let count = drive_hz
        .filter(|f| *f > 0.0 && f.is_finite())
        .map_or(0.0, |drive| (highest_hz / drive + 1e-9).floor());
    1..=if count <= 40.0 { count as u32 } else { 0 }
}

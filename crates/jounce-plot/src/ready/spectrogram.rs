//! Amplitudes over time and frequency.

use crate::{Along, Axis, Field, Figure, Panel};

/// Amplitude spectra of one quantity over time.
#[derive(Debug, Clone, PartialEq)]
pub struct TimeSpectrum {
    /// Name of the quantity (`Voltage`).
    pub quantity: String,
    /// Unit.
    pub unit: String,
    /// Ends of the time intervals of the spectra, s: one more than the number of spectra.
    pub time_s: Vec<f64>,
    /// Ends of the frequency bands of the lines, Hz.
    pub frequency_hz: Vec<f64>,
    /// Peak amplitude of each line, for each spectrum.
    pub amplitude_peak: Vec<Vec<f64>>,
}

/// Largest numbers of columns and rows of a picture; beyond them cells are joined, and the largest
/// is shown.
const MAX_GRID_SIZE: (usize, usize) = (240, 160);
/// Range of the colours below the largest amplitude, dB.
const RANGE_DB: f64 = 60.0;

/// Draws a spectrogram in dB below its largest amplitude, with the scale of colours below;
/// multiples of the drive frequency are marked.
pub fn spectrogram(title: &str, of: &TimeSpectrum, drive_hz: Option<f64>) -> Figure {
    let largest = of
        .amplitude_peak
        .iter()
        .flatten()
        .copied()
        .filter(|a| a.is_finite())
        .fold(f64::MIN_POSITIVE, f64::max);
    let (columns, rows) = (
        blocks(&of.time_s, MAX_GRID_SIZE.0),
        blocks(&of.frequency_hz, MAX_GRID_SIZE.1),
    );
    let decibels = |pair: &[usize]| -> Vec<f64> {
        let most = |band: &[usize]| {
            let inside = of.amplitude_peak[pair[0]..pair[1]]
                .iter()
                .flat_map(|spectrum| &spectrum[band[0]..band[1]]);
            20.0 * (inside.copied().fold(0.0, f64::max) / largest).log10()
        };
        rows.windows(2).map(most).collect()
    };
    let ends = |positions: &[f64], edges: &[usize]| {
        edges
            .iter()
            .map(|edge| positions[*edge])
            .collect::<Vec<f64>>()
    };
    let field = Field {
        x: ends(&of.time_s, &columns),
        y: ends(&of.frequency_hz, &rows),
        columns: columns.windows(2).map(decibels).collect(),
        range: (-RANGE_DB, 0.0),
    };
    let bounds = |edges: &[f64]| {
        edges
            .first()
            .copied()
            .zip(edges.last().copied())
            .unwrap_or((0.0, 1.0))
    };
    let ((from_s, to_s), (low_hz, high_hz)) = (bounds(&field.x), bounds(&field.y));
    let axes = Panel::new(
        Axis::linear("Time", "s").between(from_s, to_s),
        Axis::linear("Frequency", "Hz").between(low_hz, high_hz),
    );
    let panel = with_orders(axes.high(340.0).field(field), drive_hz, high_hz);
    Figure::new(title).with(panel).with(scale(of, largest))
}

/// Marks the multiples of the drive frequency on a panel, if they are few.
fn with_orders(panel: Panel, drive_hz: Option<f64>, high_hz: f64) -> Panel {
    let orders = drive_hz
        .filter(|f| *f > 0.0 && high_hz / f <= 20.0)
        .map_or(0, |f| (high_hz / f) as u32);
    let mark = |panel: Panel, order: u32| {
        let label = if order == 1 {
            "drive".to_owned()
        } else {
            format!("{order}× drive")
        };
        panel.reference(
            Along::Y,
            f64::from(order) * drive_hz.unwrap_or(0.0),
            Some(&label),
        )
    };
    (1..=orders).fold(panel, mark)
}

/// Draws the scale of the colours.
fn scale(of: &TimeSpectrum, largest: f64) -> Panel {
    const CELLS: usize = 120;
    let edge = |k: usize| -RANGE_DB + RANGE_DB * k as f64 / CELLS as f64;
    let x: Vec<f64> = (0..=CELLS).map(edge).collect();
    let columns = x
        .windows(2)
        .map(|pair| vec![0.5 * (pair[0] + pair[1])])
        .collect();
    let quantity = format!(
        "{} amplitude relative to its largest, {largest:.3e} {}",
        of.quantity, of.unit
    );
    let (along, across) = (
        Axis::linear(&quantity, "dB").between(-RANGE_DB, 0.0),
        Axis::linear("", "").between(0.41, 0.59).every(1.0),
    );
    Panel::new(along, across).high(14.0).field(Field {
        x,
        y: vec![0.0, 1.0],
        columns,
        range: (-RANGE_DB, 0.0),
    })
}

/// Returns the edges of at most `most` blocks with equal numbers of cells, except the last.
fn blocks(edges: &[f64], most: usize) -> Vec<usize> {
    let cells = edges.len().saturating_sub(1);
    let step = cells.div_ceil(most).max(1);
    (0..cells).step_by(step).chain([cells]).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    /// 1000 spectra of 500 lines, one of them large: it remains visible at 0 dB, however many cells
    /// are joined.
    #[test]
    fn merged_cells_show_their_maximum() {
        let edges = |n: usize| (0..=n).map(|k| k as f64).collect::<Vec<f64>>();
        let mut amplitude_peak = vec![vec![1e-3; 500]; 1000];
        amplitude_peak[777][333] = 2.0;
        let of = TimeSpectrum {
            quantity: "Voltage".to_owned(),
            unit: "V".to_owned(),
            time_s: edges(1000),
            frequency_hz: edges(500),
            amplitude_peak,
        };
        let figure = spectrogram("a", &of, Some(100.0));
        let field = figure.panels[0].field.as_ref().unwrap();
        assert!(
            field.columns.len() <= MAX_GRID_SIZE.0 && field.columns[0].len() <= MAX_GRID_SIZE.1
        );
        let largest = field
            .columns
            .iter()
            .flatten()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max);
        assert!(
            largest == 0.0
                && field
                    .columns
                    .iter()
                    .flatten()
                    .filter(|v| **v == 0.0)
                    .count()
                    == 1
        );
        assert_eq!(figure.panels[0].references.len(), 5);
        figure.to_svg().unwrap();
    }
}

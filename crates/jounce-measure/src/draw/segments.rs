//! Figures of a long record with its segments, and of their spectra.

use jounce_core::picture::{
    Along, Axis, Colour, Figure, Line, Marker, Panel, Scale, Series, SpectrumLine, spectra,
};
use jounce_core::signal::{Samples, Window};

use crate::segmentation::{RecordSegment, Segmentation, SegmentationError, section};

/// Multiples of the drive frequency shown in a spectrum.
const SHOWN_ORDERS: f64 = 8.0;

/// Plots the record in one panel and the RMS of its segments in a second; vertical lines mark
/// changes, labelled with the period that begins there.
pub fn segments(
    title: &str,
    quantity: &str,
    unit: &str,
    samples: &Samples<'_>,
    found: &Segmentation,
) -> Figure {
    let time_s: Vec<f64> = (0..samples.values().len())
        .map(|k| k as f64 / samples.rate_hz())
        .collect();
    let time = || Axis::linear("Time", "s");
    let trace = Series::line(time_s, samples.values().to_vec()).style(Line::Thin);
    let mut record = Panel::new(time(), Axis::linear(quantity, unit))
        .high(200.0)
        .with(trace);
    let largest = found
        .stretches
        .iter()
        .map(|stretch| stretch.rms)
        .fold(0.0, f64::max);
    let mut size = Panel::new(
        time(),
        Axis::linear("Rms", unit).between(0.0, 1.1 * largest),
    )
    .high(140.0);
    for (k, stretch) in found.stretches.iter().enumerate() {
        record = record.reference(Along::X, stretch.start_s, Some(&named(stretch)));
        let level = Series::line(vec![stretch.start_s, stretch.end_s], vec![stretch.rms; 2]);
        size = size.with(level.colour(Colour::nth(k)));
    }
    Figure::new(title).with(record).with(size)
}

/// Plots one value per drive cycle over time, coloured by segment: a solution of `n` drive cycles
/// shows `n` rows of points.
pub fn stretch_section(
    title: &str,
    quantity: &str,
    unit: &str,
    samples: &Samples<'_>,
    found: &Segmentation,
    drive_hz: f64,
) -> Figure {
    let points = section(samples, drive_hz);
    let axes = Panel::new(
        Axis::linear("Time", "s"),
        Axis::linear(&format!("{quantity} at one phase of the drive"), unit),
    )
    .high(260.0);
    let add = |panel: Panel, (k, stretch): (usize, &RecordSegment)| {
        let own = points
            .time_s
            .iter()
            .zip(&points.value)
            .filter(|(t, _)| (stretch.start_s..stretch.end_s).contains(t));
        let (x, y) = own.unzip();
        panel.with(
            Series::points(x, y, Marker::Circle)
                .colour(Colour::nth(k))
                .label(&named(stretch)),
        )
    };
    Figure::new(title).with(found.stretches.iter().enumerate().fold(axes, add))
}

/// Plots the spectrum of each segment (Hann window, peak amplitudes), up to eight times the drive
/// frequency.
///
/// # Errors
/// A segment that is not a valid signal.
pub fn stretch_spectra(
    title: &str,
    quantity: &str,
    unit: &str,
    samples: &Samples<'_>,
    found: &Segmentation,
    drive_hz: f64,
) -> Result<Figure, SegmentationError> {
    let line = |stretch: &RecordSegment| -> Result<SpectrumLine, SegmentationError> {
        let part = Samples::new(
            &samples.values()[stretch.start..stretch.end],
            samples.rate_hz(),
        )?;
        let spectrum = part.spectrum(Window::Hann);
        let kept = spectrum
            .frequency_hz
            .iter()
            .take_while(|f| **f <= SHOWN_ORDERS * drive_hz)
            .count();
        Ok(SpectrumLine {
            label: format!(
                "{:.2} to {:.2} s: {}",
                stretch.start_s,
                stretch.end_s,
                named(stretch)
            ),
            frequency_hz: spectrum.frequency_hz[..kept].to_vec(),
            amplitude_peak: spectrum.amplitude_peak[..kept].to_vec(),
        })
    };
    let lines = found
        .stretches
        .iter()
        .map(line)
        .collect::<Result<Vec<_>, _>>()?;
    Ok(spectra(
        title,
        quantity,
        unit,
        Scale::Log,
        &lines,
        Some(drive_hz),
    ))
}

fn named(stretch: &RecordSegment) -> String {
    stretch.period.cycles.map_or_else(
        || "no period".to_owned(),
        |cycles| format!("period {cycles}"),
    )
}

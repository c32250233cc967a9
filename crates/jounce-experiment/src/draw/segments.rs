//! Figures of a long record with its segments, and of their spectra.

use jounce_plot::{
    Along, Axis, Colour, Figure, Line, Marker, Panel, Scale, Series, SpectrumLine, spectra,
};
use jounce_signal::{Samples, Window};

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
    result: &Segmentation,
) -> Figure {
    let time_s: Vec<f64> = (0..samples.values().len())
        .map(|k| k as f64 / samples.rate_hz())
        .collect();
    let time = || Axis::linear("Time", "s");
    let trace = Series::line(time_s, samples.values().to_vec()).style(Line::Thin);
    let mut record = Panel::new(time(), Axis::linear(quantity, unit))
        .high(200.0)
        .with(trace);
    let largest_rms = result
        .segments
        .iter()
        .map(|segment| segment.rms)
        .fold(0.0, f64::max);
    let mut rms_panel = Panel::new(
        time(),
        Axis::linear("Rms", unit).between(0.0, 1.1 * largest_rms),
    )
    .high(140.0);
    for (k, segment) in result.segments.iter().enumerate() {
        record = record.reference(Along::X, segment.start_s, Some(&segment_label(segment)));
        let level = Series::line(vec![segment.start_s, segment.end_s], vec![segment.rms; 2]);
        rms_panel = rms_panel.with(level.colour(Colour::nth(k)));
    }
    Figure::new(title).with(record).with(rms_panel)
}

/// Plots one value per drive cycle over time, coloured by segment: a solution of `n` drive cycles
/// shows `n` rows of points.
pub fn segment_section(
    title: &str,
    quantity: &str,
    unit: &str,
    samples: &Samples<'_>,
    result: &Segmentation,
    drive_hz: f64,
) -> Figure {
    let points = section(samples, drive_hz);
    let axes = Panel::new(
        Axis::linear("Time", "s"),
        Axis::linear(&format!("{quantity} at one phase of the drive"), unit),
    )
    .high(260.0);
    let add = |panel: Panel, (k, segment): (usize, &RecordSegment)| {
        let segment_points = points
            .time_s
            .iter()
            .zip(&points.value)
            .filter(|(t, _)| (segment.start_s..segment.end_s).contains(t));
        let (x, y) = segment_points.unzip();
        panel.with(
            Series::points(x, y, Marker::Circle)
                .colour(Colour::nth(k))
                .label(&segment_label(segment)),
        )
    };
    Figure::new(title).with(result.segments.iter().enumerate().fold(axes, add))
}

/// Plots the spectrum of each segment (Hann window, peak amplitudes), up to eight times the drive
/// frequency.
///
/// # Errors
/// A segment that is not a valid signal.
pub fn segment_spectra(
    title: &str,
    quantity: &str,
    unit: &str,
    samples: &Samples<'_>,
    result: &Segmentation,
    drive_hz: f64,
) -> Result<Figure, SegmentationError> {
    let line = |segment: &RecordSegment| -> Result<SpectrumLine, SegmentationError> {
        let inner_samples = Samples::new(
            &samples.values()[segment.start..segment.end],
            samples.rate_hz(),
        )?;
        let spectrum = inner_samples.spectrum(Window::Hann);
        let retained = spectrum
            .frequency_hz
            .iter()
            .take_while(|f| **f <= SHOWN_ORDERS * drive_hz)
            .count();
        Ok(SpectrumLine {
            label: format!(
                "{:.2} to {:.2} s: {}",
                segment.start_s,
                segment.end_s,
                segment_label(segment)
            ),
            frequency_hz: spectrum.frequency_hz[..retained].to_vec(),
            amplitude_peak: spectrum.amplitude_peak[..retained].to_vec(),
        })
    };
    let lines = result
        .segments
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

fn segment_label(segment: &RecordSegment) -> String {
    segment.period.cycles.map_or_else(
        || "no period".to_owned(),
        |cycles| format!("period {cycles}"),
    )
}

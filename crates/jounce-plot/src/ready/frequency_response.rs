//! Frequency responses: magnitude on a logarithmic axis over phase (figures 4 and 5 of the paper).

use crate::{Axis, Colour, Figure, Line, Panel, Scale, Series};

/// A complex response over frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct ResponseLine {
    /// Name in the legend; omitted if there is only one response.
    pub label: String,
    /// Real part at each frequency.
    pub re: Vec<f64>,
    /// Imaginary part at each frequency.
    pub im: Vec<f64>,
}

/// Draws responses of one quantity (`Tip acceleration per force`, `m/s^2/N`) over `frequency_hz`,
/// on a linear or logarithmic frequency axis.
pub fn frequency_responses(
    title: &str,
    quantity: &str,
    unit: &str,
    scale: Scale,
    frequency_hz: &[f64],
    responses: &[ResponseLine],
) -> Figure {
    let x = || Axis::of(scale, "Frequency", "Hz");
    let mut magnitude = Panel::new(x(), Axis::log(quantity, unit)).high(260.0);
    let mut phase = Panel::new(
        x(),
        Axis::linear("Phase", "deg")
            .between(-195.0, 195.0)
            .every(90.0),
    )
    .high(130.0);
    for (index, response) in responses.iter().enumerate() {
        let parts = || response.re.iter().zip(&response.im);
        let size = Series::line(
            frequency_hz.to_vec(),
            parts().map(|(re, im)| re.hypot(*im)).collect(),
        )
        .colour(Colour::nth(index));
        magnitude = magnitude.with(if responses.len() > 1 {
            size.label(&response.label)
        } else {
            size
        });
        let (frequencies, angles) = unwrapped(
            frequency_hz,
            parts().map(|(re, im)| im.atan2(*re).to_degrees()),
        );
        phase = phase.with(
            Series::line(frequencies, angles)
                .colour(Colour::nth(index))
                .style(Line::Thin),
        );
    }
    Figure::new(title).with(magnitude).with(phase)
}

/// Returns the phase with a gap wherever it wraps from one end of the axis to the other.
fn unwrapped(frequency_hz: &[f64], angles: impl Iterator<Item = f64>) -> (Vec<f64>, Vec<f64>) {
    let (mut frequencies, mut values): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    for (frequency, angle) in frequency_hz.iter().zip(angles) {
        if values
            .last()
            .is_some_and(|before| (angle - before).abs() > 180.0)
        {
            frequencies.push(*frequency);
            values.push(f64::NAN);
        }
        frequencies.push(*frequency);
        values.push(angle);
    }
    (frequencies, values)
}

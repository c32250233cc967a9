//! Power against load resistance, with and without impact, as in the paper's figures 8 and 9.

use super::sweep::{Direction, SweepLine, SweepLook, sweep};
use crate::picture::{Along, Axis, Figure, Reference};

/// Lines over resistance (ohm, logarithmic axis); `unit` is that of the power: `W`, or `W/N^2` where it is divided by the force squared.
/// The best resistance of each line is marked with a dotted line named by its value.
pub fn power_against_resistance(title: &str, unit: &str, lines: &[SweepLine]) -> Figure {
    let quantity = if unit.contains("N^2") { "Mean power per force squared" } else { "Mean power" };
    let look = SweepLook { parameter: Axis::log("Load resistance", "ohm"), value: Axis::linear(quantity, unit) };
    let mut figure = sweep(title, &look, lines);
    for panel in &mut figure.panels {
        panel.height_px = 320.0;
        for line in lines.iter().filter(|line| line.direction != Direction::Down) {
            if let Some(best_ohm) = best(line) {
                let label = Some(format!("{} kΩ", rounded(best_ohm / 1e3)));
                panel.references.push(Reference { along: Along::X, value: best_ohm, label });
            }
        }
    }
    figure
}

/// The parameter of the largest finite value, if it is not at an end of the line.
fn best(line: &SweepLine) -> Option<f64> {
    let points = || line.parameter.iter().zip(&line.value).filter(|(x, y)| x.is_finite() && y.is_finite());
    let (best, _) = points().max_by(|a, b| a.1.total_cmp(b.1))?;
    let (first, last) = (points().next()?.0, points().next_back()?.0);
    (best != first && best != last).then_some(*best)
}

/// Three significant digits.
fn rounded(value: f64) -> String {
    let decimals = (2.0 - value.abs().log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{value:.decimals$}")
}

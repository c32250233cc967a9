//! Power against load resistance, with and without impact, as in the paper's figures 8 and 9.

use super::sweep::{LineDirection, SweepLine, SweepLook, sweep};
use crate::axis::unit::prefix;
use crate::{Along, Axis, Figure, Line, ReferenceLine};

/// Draws lines over resistance (ohm, logarithmic axis); `unit` is the unit of the power: `W`, or
/// `W/N^2` if it is divided by the force squared. The optimal resistance of each line comes from a
/// parabola through its three highest neighbours over `ln R`. It is marked by a dotted line and
/// listed in the legend.
pub fn power_against_resistance(title: &str, unit: &str, lines: &[SweepLine]) -> Figure {
    let quantity = if unit.contains("N^2") {
        "Mean power per force squared"
    } else {
        "Mean power"
    };
    let style = SweepLook {
        parameter: Axis::log("Load resistance", "ohm"),
        value: Axis::linear(quantity, unit),
    };
    let best: Vec<_> = lines.iter().map(best_ohm).collect();
    let named: Vec<_> = lines
        .iter()
        .zip(&best)
        .map(|(line, best)| SweepLine {
            label: label(line, *best),
            ..line.clone()
        })
        .collect();
    let mut figure = sweep(title, &style, &named);
    for panel in &mut figure.panels {
        panel.height_px = 320.0;
        panel
            .references
            .extend(best.iter().flatten().map(|best| ReferenceLine {
                along: Along::X,
                value: *best,
                label: None,
            }));
        // Power is a smooth function of resistance, so even independent points are joined.
        panel
            .series
            .iter_mut()
            .filter(|series| series.line.is_none() && series.label.is_some())
            .for_each(|series| series.line = Some(Line::Thin));
    }
    figure
}

fn label(line: &SweepLine, best: Option<f64>) -> String {
    match best {
        // Both directions of a level have one name; the legend would otherwise list them twice.
        Some(best) if !matches!(line.direction, LineDirection::Up | LineDirection::Down) => {
            let thousands = (best.log10() / 3.0).floor().clamp(-1.0, 3.0) as i32;
            format!(
                "{}, best at {} {}Ω",
                line.label,
                three_digits(best / 1000f64.powi(thousands)),
                prefix(3 * thousands).unwrap_or_default()
            )
        }
        _ => line.label.clone(),
    }
}

/// Returns the position of the maximum, if it lies between three points of the line without a gap.
fn best_ohm(line: &SweepLine) -> Option<f64> {
    let points: Vec<_> = line
        .parameter
        .iter()
        .copied()
        .zip(line.value.iter().copied())
        .collect();
    let highest = (0..points.len())
        .filter(|&i| points[i].1.is_finite())
        .max_by(|&a, &b| points[a].1.total_cmp(&points[b].1))?;
    let three_points = points.get(highest.checked_sub(1)?..=highest + 1)?;
    let [(x0, y0), (x1, y1), (x2, y2)] = [three_points[0], three_points[1], three_points[2]]
        .map(|(ohm, power): (f64, f64)| (ohm.ln(), power));
    let (slope_left, right) = ((y1 - y0) / (x1 - x0), (y2 - y1) / (x2 - x1));
    let best = 0.5 * (x0 + x1) + 0.5 * (x2 - x0) * slope_left / (slope_left - right);
    best.is_finite().then(|| best.exp())
}

fn three_digits(value: f64) -> String {
    let decimals = (2.0 - value.abs().log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{value:.decimals$}")
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn line(parameter: Vec<f64>, value: Vec<f64>) -> SweepLine {
        SweepLine {
            label: "a".into(),
            direction: LineDirection::Independent,
            parameter,
            value,
            settled: vec![],
        }
    }

    /// `P = P_0 2 R R_0 / (R^2 + R_0^2)` has its maximum at `R_0`. With ten points a decade the
    /// largest measured error is 0.1 %.
    #[test]
    fn the_best_resistance_lies_between_the_points() {
        for best in [60e3, 67e3, 69.2e3, 75e3] {
            let ohm: Vec<f64> = (0..31)
                .map(|i| 10f64.powf(4.0 + f64::from(i) / 10.0))
                .collect();
            let power = ohm
                .iter()
                .map(|r| 2.0 * r * best / (r * r + best * best))
                .collect();
            let computed = best_ohm(&line(ohm, power)).unwrap();
            assert!((computed / best - 1.0).abs() < 0.002, "{computed} {best}");
        }
    }

    #[test]
    fn best_resistance_is_printed_with_its_unit() {
        let printed = |ohm: f64| label(&line(vec![], vec![]), Some(ohm));
        assert_eq!(
            [printed(95.2), printed(4.7e3), printed(1.25e6)],
            [
                "a, best at 95.2 Ω",
                "a, best at 4.70 kΩ",
                "a, best at 1.25 MΩ"
            ]
        );
    }

    #[test]
    fn maximum_at_an_end_next_to_a_gap_or_on_a_plateau_is_rejected() {
        for power in [
            vec![3.0, 2.0, 1.0],
            vec![1.0, 2.0, f64::NAN],
            vec![f64::NAN; 3],
            vec![1.0, 1.0, 1.0],
        ] {
            assert_eq!(best_ohm(&line(vec![1e3, 1e4, 1e5], power)), None);
        }
        assert_eq!(best_ohm(&line(vec![], vec![])), None);
    }
}

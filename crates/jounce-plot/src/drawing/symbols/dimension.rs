//! Lengths as text and as dimension lines.

use crate::svg::{Svg, number};

const LOOK: &str = "class=\"jounce-rule\" stroke=\"#1a1a1a\" stroke-width=\"1\" fill=\"none\"";

/// Two arrow heads have no room between ends closer than this, px.
const SHORT: f64 = 18.0;

/// Returns a length in the most readable unit.
pub fn length(length_m: f64) -> String {
    let (value, unit) = match length_m.abs() {
        size if size >= 1.0 || size == 0.0 => (length_m, "m"),
        size if size >= 1e-4 => (length_m * 1e3, "mm"),
        _ => (length_m * 1e6, "µm"),
    };
    format!("{} {unit}", rounded(value))
}

/// Returns length, width and thickness, in millimetres as on the drawings of a workshop.
pub fn size(size_m: [f64; 3]) -> String {
    let numbers = size_m.map(|length_m| rounded(length_m * 1e3).to_string());
    format!("{} mm", numbers.join(" × "))
}

/// Rounds to five digits, which are enough for a drawing.
fn rounded(value: f64) -> f64 {
    format!("{value:.4e}").parse().unwrap_or(value)
}

/// Returns the largest of 1, 2, 5 times a power of ten that is not larger than `value`.
pub fn round_below(value: f64) -> f64 {
    let power = 10f64.powf(value.log10().floor());
    [5.0, 2.0]
        .into_iter()
        .map(|digit| digit * power)
        .find(|round| *round <= value * (1.0 + 1e-12))
        .unwrap_or(power)
}

/// Draws a scale bar.
pub fn bar(svg: &mut Svg, x: f64, y: f64, length: f64) {
    let (left, right, y0, low, high) = (
        number(x),
        number(x + length),
        number(y),
        number(y - 5.0),
        number(y + 5.0),
    );
    svg.path(
        &format!(
            "M{left} {low}L{left} {high}M{left} {y0}L{right} {y0}M{right} {low}L{right} {high}"
        ),
        LOOK,
    );
}

/// Draws a vertical line with an arrow head at each requested end; on a short length both heads are
/// outside.
pub fn arrow(svg: &mut Svg, x: f64, (from, to): (f64, f64), both: bool) {
    if both && (from - to).abs() < SHORT {
        let sign = (to - from).signum();
        arrow(svg, x, (from - sign * SHORT, from), false);
        return arrow(svg, x, (to + sign * SHORT, to), false);
    }
    let head = |y: f64, sign: f64| {
        format!(
            "M{} {}L{} {}L{} {}",
            number(x - 4.0),
            number(y + 8.0 * sign),
            number(x),
            number(y),
            number(x + 4.0),
            number(y + 8.0 * sign)
        )
    };
    let sign = (from - to).signum();
    let mut steps = format!(
        "M{} {}L{} {}{}",
        number(x),
        number(from),
        number(x),
        number(to),
        head(to, sign)
    );
    if both {
        steps.push_str(&head(from, -sign));
    }
    svg.path(&steps, LOOK);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_printed_in_millimetres() {
        assert_eq!(size([0.315, 0.03, 0.98e-3]), "315 × 30 × 0.98 mm");
    }

    #[test]
    fn lengths_are_printed_in_the_most_readable_unit() {
        let labels = [0.315, 0.98e-3, 5e-5, 2.0, 0.0, 0.085].map(length);
        assert_eq!(
            labels,
            ["315 mm", "0.98 mm", "50 µm", "2 m", "0 m", "85 mm"]
        );
        assert_eq!(
            [0.07, 0.3, 5.0, 1.0].map(|v| (round_below(v) * 1e3).round()),
            [50.0, 200.0, 5000.0, 1000.0]
        );
    }
}

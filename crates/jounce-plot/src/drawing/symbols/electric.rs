//! Symbols of circuits in a vertical wire from `top` to `bottom`, and one in a horizontal wire.

use crate::drawing::canvas::INK;
use crate::drawing::parts::bodies::PATCH;
use crate::svg::{Svg, number};

/// Half the length of a symbol, px.
const HALF: f64 = 16.0;

fn line(steps: &mut String, from: (f64, f64), to: (f64, f64)) {
    steps.push_str(&format!(
        "M{} {}L{} {}",
        number(from.0),
        number(from.1),
        number(to.0),
        number(to.1)
    ));
}

/// A resistor.
pub fn resistor(svg: &mut Svg, x: f64, (top, bottom): (f64, f64)) {
    let middle = 0.5 * (top + bottom);
    let mut steps = String::new();
    line(&mut steps, (x, top), (x, middle - HALF));
    line(&mut steps, (x, middle + HALF), (x, bottom));
    svg.path(&steps, INK);
    let style = "class=\"jounce-paper\" fill=\"#ffffff\" stroke=\"#1a1a1a\" stroke-width=\"1.2\"";
    svg.rect(x - 6.0, middle - HALF, 12.0, 2.0 * HALF, style);
}

/// A capacitor.
pub fn capacitor(svg: &mut Svg, x: f64, ends: (f64, f64)) {
    plates(svg, x, ends, [11.0, 11.0]);
}

/// A battery, its plus above.
pub fn battery(svg: &mut Svg, x: f64, ends: (f64, f64)) {
    plates(svg, x, ends, [13.0, 7.0]);
}

/// A patch: a capacitor with the ceramic between its plates.
pub fn patch(svg: &mut Svg, x: f64, (top, bottom): (f64, f64)) {
    let middle = 0.5 * (top + bottom);
    let mut steps = String::new();
    line(&mut steps, (x, top), (x, middle - 8.0));
    line(&mut steps, (x, middle + 8.0), (x, bottom));
    line(
        &mut steps,
        (x - 12.0, middle - 8.0),
        (x + 12.0, middle - 8.0),
    );
    line(
        &mut steps,
        (x - 12.0, middle + 8.0),
        (x + 12.0, middle + 8.0),
    );
    svg.rect(x - 10.0, middle - 5.0, 20.0, 10.0, PATCH);
    svg.path(&steps, INK);
}

fn plates(svg: &mut Svg, x: f64, (top, bottom): (f64, f64), half: [f64; 2]) {
    let middle = 0.5 * (top + bottom);
    let mut steps = String::new();
    line(&mut steps, (x, top), (x, middle - 4.0));
    line(&mut steps, (x, middle + 4.0), (x, bottom));
    line(
        &mut steps,
        (x - half[0], middle - 4.0),
        (x + half[0], middle - 4.0),
    );
    line(
        &mut steps,
        (x - half[1], middle + 4.0),
        (x + half[1], middle + 4.0),
    );
    svg.path(&steps, INK);
}

/// An inductor.
pub fn inductor(svg: &mut Svg, x: f64, (top, bottom): (f64, f64)) {
    let middle = 0.5 * (top + bottom);
    let mut steps = format!(
        "M{x0} {}L{x0} {}",
        number(top),
        number(middle - HALF),
        x0 = number(x)
    );
    (0..4).for_each(|turn| {
        steps.push_str(&format!(
            "A4 4 0 0 1 {} {}",
            number(x),
            number(middle - HALF + 8.0 * f64::from(turn + 1))
        ))
    });
    steps.push_str(&format!("L{} {}", number(x), number(bottom)));
    svg.path(&steps, INK);
}

/// An inductor in a horizontal wire from `left` to `right`.
pub fn level_inductor(svg: &mut Svg, y: f64, (left, right): (f64, f64)) {
    let middle = 0.5 * (left + right);
    let mut steps = format!(
        "M{} {y0}L{} {y0}",
        number(left),
        number(middle - HALF),
        y0 = number(y)
    );
    (0..4).for_each(|turn| {
        steps.push_str(&format!(
            "A4 4 0 0 1 {} {}",
            number(middle - HALF + 8.0 * f64::from(turn + 1)),
            number(y)
        ))
    });
    steps.push_str(&format!("L{} {}", number(right), number(y)));
    svg.path(&steps, INK);
}

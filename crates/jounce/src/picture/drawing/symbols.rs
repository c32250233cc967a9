//! Symbols: a mass, a spring, a resistor.

use super::hatch::{Far, ground};
use crate::picture::svg::{Anchor, Svg, number};
use crate::picture::text::SMALL;

const INK: &str = "class=\"jounce-rule\" stroke=\"#1a1a1a\" stroke-width=\"1.2\" fill=\"none\"";

/// A box with words in and below it; returns its height.
pub fn labelled_box(svg: &mut Svg, (x, y, width, height): (f64, f64, f64, f64), label: &str) {
    svg.rect(x, y, width, height, "class=\"jounce-body\" fill=\"#dfe3e8\" stroke=\"#1a1a1a\" stroke-width=\"1.2\"");
    svg.text(x + 0.5 * width, y + 0.5 * height + 4.0, SMALL, Anchor::Middle, label);
}

/// A spring that stands on the ground.
pub fn spring(svg: &mut Svg, x: f64, top: f64, height: f64) {
    const TURNS: usize = 4;
    let pitch = height / (TURNS as f64 + 1.0);
    let mut steps = format!("M{} {}L{} {}", number(x), number(top), number(x), number(top + 0.5 * pitch));
    for turn in 0..TURNS {
        let y = top + (turn as f64 + 0.5) * pitch;
        steps.push_str(&format!(
            "L{} {}L{} {}L{} {}",
            number(x + 8.0),
            number(y + 0.25 * pitch),
            number(x - 8.0),
            number(y + 0.75 * pitch),
            number(x),
            number(y + pitch)
        ));
    }
    steps.push_str(&format!("L{} {}", number(x), number(top + height)));
    svg.path(&steps, INK);
    ground(svg, (x - 25.0, top + height), 50.0, Far::Below);
}

/// A load between two wires that come down from the ends of a patch.
pub fn load(svg: &mut Svg, (left, right): (f64, f64), top: f64, words: &str) {
    let (middle, y) = (0.5 * (left + right), top + 62.0);
    let half = (0.25 * (right - left)).clamp(10.0, 24.0);
    let wires = format!(
        "M{l} {t}L{l} {y}L{a} {y}M{b} {y}L{r} {y}L{r} {t}",
        l = number(left),
        r = number(right),
        t = number(top),
        y = number(y),
        a = number(middle - half),
        b = number(middle + half)
    );
    svg.path(&wires, INK);
    svg.rect(middle - half, y - 7.0, 2.0 * half, 14.0, "class=\"jounce-paper\" fill=\"#ffffff\" stroke=\"#1a1a1a\" stroke-width=\"1.2\"");
    svg.text(middle, y + 22.0, SMALL, Anchor::Middle, words);
}

//! A circuit: its elements between two wires.

use super::bodies::BODY;
use crate::drawing::canvas::INK;
use crate::drawing::layout::labels::{LINE, size_of};
use crate::drawing::symbols::electric;
use crate::drawing::{DrawnCircuit, DrawnElement};
use crate::svg::{Anchor, Svg, number};
use crate::text::{SMALL, width};

/// Height of a circuit with its name, px.
pub const HIGH: f64 = 150.0;
/// Heights of the two wires under the upper edge, px.
const WIRES: (f64, f64) = (46.0, 136.0);
/// From the left edge to the first element, px.
const MARGIN: f64 = 20.0;

/// Returns the width of a circuit, px.
pub fn wide(circuit: &DrawnCircuit) -> f64 {
    let elements: f64 = circuit.elements.iter().map(column).sum();
    (MARGIN + elements).max(width(&name(circuit), SMALL) + 10.0)
}

fn name(circuit: &DrawnCircuit) -> String {
    format!("circuit {}", circuit.label)
}

/// Returns the width of an element.
fn column(element: &DrawnElement) -> f64 {
    match element {
        DrawnElement::Patches(patches) => {
            20.0 + patches
                .iter()
                .map(|(name, _)| width(name, SMALL))
                .fold(0.0, f64::max)
                + 34.0
        }
        DrawnElement::Block(words) => size_of(words).0 + 20.0 + 34.0,
        DrawnElement::SeriesInductor(words) => size_of(words).0.max(40.0) + 24.0,
        DrawnElement::Capacitor(words)
        | DrawnElement::Battery(words)
        | DrawnElement::Resistor(words)
        | DrawnElement::Inductor(words) => 20.0 + size_of(words).0 + 34.0,
    }
}

/// Draws a circuit with its upper left corner at `(x, y)`.
pub fn draw(svg: &mut Svg, circuit: &DrawnCircuit, (x, y): (f64, f64)) {
    svg.text(x, y + 14.0, SMALL, Anchor::Start, &name(circuit));
    let ends = (y + WIRES.0, y + WIRES.1);
    let mut at = x + MARGIN;
    for (index, circuit_element) in circuit.elements.iter().enumerate() {
        let next = at + column(circuit_element);
        element(svg, circuit_element, at, ends);
        // The wires extend from each element to the next.
        let last = index + 1 == circuit.elements.len();
        if !last {
            let from = if let DrawnElement::Block(words) = circuit_element {
                at + size_of(words).0 + 20.0
            } else {
                at
            };
            wires(
                svg,
                from,
                next,
                ends,
                matches!(circuit_element, DrawnElement::SeriesInductor(_)),
            );
        }
        at = next;
    }
}

fn wires(svg: &mut Svg, from: f64, to: f64, (top, bottom): (f64, f64), only_lower: bool) {
    let line = |y: f64| format!("M{} {y}L{} {y}", number(from), number(to), y = number(y));
    let upper = if only_lower { String::new() } else { line(top) };
    svg.path(&(upper + &line(bottom)), INK);
}

fn element(svg: &mut Svg, element: &DrawnElement, x: f64, ends: (f64, f64)) {
    let middle = 0.5 * (ends.0 + ends.1);
    match element {
        DrawnElement::Patches(patches) => stack(svg, patches, x, ends),
        DrawnElement::Block(words) => {
            let (width, height) = (size_of(words).0 + 20.0, ends.1 - ends.0 + 16.0);
            svg.rect(x, ends.0 - 8.0, width, height, BODY);
            words_at(svg, words, x + 10.0, middle);
        }
        DrawnElement::SeriesInductor(words) => {
            let element_width = size_of(words).0.max(40.0) + 24.0;
            electric::level_inductor(svg, ends.0, (x, x + element_width));
            words_at(
                svg,
                words,
                x + 12.0,
                ends.0 + 12.0 + 0.5 * LINE * words.len() as f64,
            );
        }
        DrawnElement::Capacitor(words) => upright(svg, electric::capacitor, words, x, ends),
        DrawnElement::Battery(words) => upright(svg, electric::battery, words, x, ends),
        DrawnElement::Resistor(words) => upright(svg, electric::resistor, words, x, ends),
        DrawnElement::Inductor(words) => upright(svg, electric::inductor, words, x, ends),
    }
}

fn upright(
    svg: &mut Svg,
    symbol: fn(&mut Svg, f64, (f64, f64)),
    words: &[String],
    x: f64,
    ends: (f64, f64),
) {
    symbol(svg, x, ends);
    words_at(svg, words, x + 20.0, 0.5 * (ends.0 + ends.1));
}

/// Draws lines centred at a height.
fn words_at(svg: &mut Svg, words: &[String], x: f64, middle: f64) {
    for (line, text) in words.iter().enumerate() {
        let y = middle + LINE * (line as f64 - 0.5 * words.len() as f64) + 11.5;
        svg.text(x, y, SMALL, Anchor::Start, text);
    }
}

/// Draws patches in series, with the sign of each at its upper plate.
fn stack(svg: &mut Svg, patches: &[(String, bool)], x: f64, (top, bottom): (f64, f64)) {
    let each = (bottom - top) / patches.len().max(1) as f64;
    for (k, (name, reversed)) in patches.iter().enumerate() {
        let ends = (top + each * k as f64, top + each * (k as f64 + 1.0));
        electric::patch(svg, x, ends);
        let middle = 0.5 * (ends.0 + ends.1);
        svg.text(x + 20.0, middle + 4.0, SMALL, Anchor::Start, name);
        let sign = if *reversed { "−" } else { "+" };
        svg.text(x - 9.0, middle - 11.0, SMALL, Anchor::Middle, sign);
    }
}

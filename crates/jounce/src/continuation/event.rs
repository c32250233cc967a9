//! The place between two points at which a function of the curve passes zero.

use super::{Corrector, Direction, Family, Metric, Position, Step, Stretch, correct, tangent};

/// Most places tried.
const MOST: u32 = 40;

/// Where Newton fails: length of the bracket, beside the resolution, in which any place has come near.
const NARROW: f64 = 10.0;

/// Where Newton fails: value, beside those at the two ends, of a place that has come near.
const SMALL: f64 = 0.01;

/// One side of the zero.
#[derive(Debug, Clone)]
struct Side {
    position: Position,
    tangent: Direction,
    /// Distance along the chord.
    place: f64,
    value: f64,
}

/// Walks from `before` towards `after` to the zero of `value`, which has different signs at the two.
///
/// Places are sought along the chord by inverse quadratic interpolation kept inside the bracket (Chandrupatla), each from a guess on
/// the cubic between the two sides of the bracket, which comes nearer to the curve as it shrinks: by the fourth power of its length.
/// The search ends when the bracket or the last move is shorter than `resolution` (in the metric), or a value is as small beside those
/// at the two ends.
/// Where Newton fails on the way, as it may within roundoff of a kink, the place with the least value so far is the answer, if it has come
/// near; otherwise there is none, as between two points of which one has been carried past the other.
///
/// Source: T. R. Chandrupatla, Adv. Eng. Software 28 (1997) 145.
pub fn locate<F: Family>(
    family: &F,
    corrector: &Corrector,
    parameter_scale: f64,
    (before, after): (&Step<F::Local>, &Step<F::Local>),
    resolution: f64,
    value: impl Fn(&Step<F::Local>) -> f64,
) -> Option<Step<F::Local>> {
    let metric = Metric::at(&before.position, parameter_scale);
    let chord = before.position.to(&after.position);
    let length = metric.length(&chord);
    let unit = metric.unit(chord);
    let side = |step: &Step<F::Local>, place: f64, value: f64| Side {
        position: step.position.clone(),
        tangent: step.tangent.clone(),
        place,
        value,
    };
    let mut low = side(before, 0.0, value(before));
    let mut high = side(after, length, value(after));
    let size = low.value.abs().max(high.value.abs());
    // The place before the last one, on whichever side.
    let mut third: Option<(f64, f64)> = None;
    let mut last_is_low = false;
    let mut best: Option<(f64, Step<F::Local>)> = None;
    for _ in 0..MOST {
        let (one, two) = if last_is_low { (&low, &high) } else { (&high, &low) };
        let least = (0.5 * resolution / (high.place - low.place)).min(0.5);
        let share = next_share((one.place, one.value), (two.place, two.value), third).clamp(least, 1.0 - least);
        let stretch = Stretch::between(&metric, (&low.position, &low.tangent), (&high.position, &high.tangent));
        let from_low = if last_is_low { share } else { 1.0 - share };
        let guess = stretch.at(from_low * stretch.length);
        let found = correct(family, corrector, &metric, &unit, guess).ok();
        let found = found.and_then(|found| Some((tangent(&found.local, &metric, &unit)?, found)));
        let Some((ahead, found)) = found else {
            let is_narrow = high.place - low.place <= NARROW * resolution;
            return best.filter(|(own, _)| is_narrow || *own <= SMALL * size).map(|(_, step)| step);
        };
        let step = Step { position: found.position, tangent: ahead, local: found.local, error: found.error };
        let place = metric.inner(&unit, &before.position.to(&step.position));
        let here = side(&step, place, value(&step));
        let own = here.value.abs();
        let (small, is_high) = (here.value.abs() <= resolution * size, (here.value > 0.0) == (high.value > 0.0));
        let moved = (place - one.place).abs();
        let replaced = std::mem::replace(if is_high { &mut high } else { &mut low }, here);
        // It bends the interpolation.
        third = Some((replaced.place, replaced.value));
        last_is_low = !is_high;
        if small || moved.min(high.place - low.place) <= resolution {
            return Some(step);
        }
        if best.as_ref().is_none_or(|(least, _)| own < *least) {
            best = Some((own, step));
        }
    }
    None
}

/// Share of the way from the last place (place and value) to the other side of the bracket.
fn next_share((x1, f1): (f64, f64), (x2, f2): (f64, f64), third: Option<(f64, f64)>) -> f64 {
    let Some((x3, f3)) = third else { return f1 / (f1 - f2) };
    let (xi, phi) = ((x1 - x2) / (x3 - x2), (f1 - f2) / (f3 - f2));
    let is_smooth = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
    if is_smooth { f1 / (f2 - f1) * f3 / (f2 - f3) + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2) } else { 0.5 }
}

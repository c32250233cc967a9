//! The place between two points at which a function of the curve passes zero.

use super::{Corrector, Family, Metric, Step, Stretch, correct, tangent};

/// Most places tried.
const MOST: u32 = 40;

/// Walks from `before` towards `after` to the zero of `value`, which has different signs at the two.
///
/// The place is sought along the chord, from guesses on the cubic between the two, by false position with halving (Illinois), until the bracket is shorter than `resolution`
/// (in the metric) or a value is as small beside those at the two ends. `None` where Newton fails on the way.
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
    let cubic = Stretch::between(&metric, (&before.position, &before.tangent), (&after.position, &after.tangent));
    let (mut low, mut high) = (0.0, length);
    let (mut at_low, mut at_high) = (value(before), value(after));
    let size = at_low.abs().max(at_high.abs());
    let mut best = None;
    for _ in 0..MOST {
        let mut place = (low * at_high - high * at_low) / (at_high - at_low);
        if !(place > low && place < high) {
            place = 0.5 * (low + high);
        }
        let found = correct(family, corrector, &metric, &unit, cubic.at(place)).ok()?;
        let ahead = tangent(&found.local, &metric, &unit)?;
        let step = Step { position: found.position, tangent: ahead, local: found.local, error: found.error };
        let here = value(&step);
        best = Some(step);
        if (here > 0.0) == (at_high > 0.0) {
            (high, at_high) = (place, here);
            at_low *= 0.5;
        } else {
            (low, at_low) = (place, here);
            at_high *= 0.5;
        }
        if high - low <= resolution || here.abs() <= resolution * size {
            break;
        }
    }
    best
}

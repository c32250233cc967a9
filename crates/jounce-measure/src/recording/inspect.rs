//! Looks at the samples of a channel for what instruments do to signals.

use super::{Channel, Finding, FindingKind, Place, Quantity};

/// Leading or trailing zeros from this many on are padding.
const PADDING: usize = 10;
/// Equal samples in a row at an extreme from this many on may be a flat top.
const FLAT: usize = 3;
/// Whole numbers beyond this size, without unit, are counts.
const COUNTS: f64 = 100.0;

/// Everything that is odd about the samples of a channel.
///
/// A flat top is told from a slow maximum of a coarsely quantised signal by how the signal enters it: by a jump of more than two of the
/// smallest steps that the channel makes.
pub fn inspect(channel: &Channel) -> Vec<Finding> {
    let values = &channel.values;
    let found = [not_a_number(values), constant(values), padding(values), clipping(values), counts(channel)];
    found.into_iter().flatten().map(|finding| finding.of(&channel.name)).collect()
}

fn not_a_number(values: &[f64]) -> Option<Finding> {
    let first = values.iter().position(|x| !x.is_finite())?;
    let count = values.iter().filter(|x| !x.is_finite()).count();
    Some(Finding::new(FindingKind::NotANumber, count, Some(Place::Sample(first)), "samples are no numbers".to_owned()))
}

fn constant(values: &[f64]) -> Option<Finding> {
    let first = values.first()?;
    let same = values.len() > 1 && values.iter().all(|x| x == first);
    same.then(|| Finding::new(FindingKind::Constant, values.len(), None, format!("all samples are {first}; there is no signal")))
}

fn padding(values: &[f64]) -> Option<Finding> {
    let leading = values.iter().take_while(|x| **x == 0.0).count();
    let trailing = values.iter().rev().take_while(|x| **x == 0.0).count();
    if leading == values.len() || leading.max(trailing) < PADDING {
        return None;
    }
    let (leading, trailing) = (if leading < PADDING { 0 } else { leading }, if trailing < PADDING { 0 } else { trailing });
    let first = if leading > 0 { 0 } else { values.len() - trailing };
    let about = format!("{leading} exact zeros stand before the signal and {trailing} after it");
    Some(Finding::new(FindingKind::ZeroPadding, leading + trailing, Some(Place::Sample(first)), about))
}

fn clipping(values: &[f64]) -> Option<Finding> {
    let finite = || values.iter().copied().filter(|x| x.is_finite());
    let (low, high) = finite().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    if low >= high {
        return None;
    }
    let quantum = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).filter(|d| *d > 0.0).fold(f64::INFINITY, f64::min);
    let (mut count, mut first, mut k) = (0, None, 0);
    while k < values.len() {
        let run = values[k..].iter().take_while(|x| **x == values[k]).count().max(1);
        let extreme = values[k] == low || values[k] == high;
        let jump = |a: usize, b: usize| (values[a] - values[b]).abs() > 2.0 * quantum;
        let steep = (k > 0 && jump(k, k - 1)) || (k + run < values.len() && jump(k, k + run));
        if extreme && run >= FLAT && steep && values[k] != 0.0 {
            count += run;
            first = first.or(Some(k));
        }
        k += run;
    }
    let about = format!("flat tops at the ends of the range {low} to {high}: the signal was clipped");
    first.map(|first| Finding::new(FindingKind::Clipping, count, Some(Place::Sample(first)), about))
}

fn counts(channel: &Channel) -> Option<Finding> {
    let finite = || channel.values.iter().filter(|x| x.is_finite());
    let whole = channel.quantity == Quantity::Unknown && channel.imaginary.is_none() && finite().all(|x| x.fract() == 0.0);
    let large = finite().any(|x| x.abs() > COUNTS);
    let about = "whole numbers without unit: counts of a converter? give the scale in the notes beside the file";
    (whole && large).then(|| Finding::new(FindingKind::RawCounts, channel.values.len(), None, about.to_owned()))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn found(values: Vec<f64>) -> Vec<(FindingKind, usize, Option<Place>)> {
        let quantity = Quantity::Acceleration;
        inspect(&Channel::new("a", quantity, "m/s^2", values)).into_iter().map(|f| (f.kind, f.count, f.first)).collect()
    }

    fn sine(peak: f64, count: usize) -> Vec<f64> {
        (0..count).map(|k| peak * (TAU * k as f64 / 100.0 + 0.1).sin()).collect()
    }

    #[test]
    fn a_clean_sine_has_no_findings_not_even_when_coarse() {
        assert_eq!(found(sine(1.0, 1000)), []);
        assert_eq!(found(sine(20.0, 1000).into_iter().map(f64::round).collect()), []);
    }

    #[test]
    fn each_fault_is_found_at_its_place_with_its_count() {
        let clipped: Vec<f64> = sine(1.0, 1000).into_iter().map(|x| x.min(0.9)).collect();
        let flat = clipped.iter().filter(|x| **x == 0.9).count();
        let first = clipped.iter().position(|x| *x == 0.9).unwrap();
        assert_eq!(found(clipped), [(FindingKind::Clipping, flat, Some(Place::Sample(first)))]);
        let padded = [vec![0.0; 40], sine(1.0, 300), vec![0.0; 3]].concat();
        assert_eq!(found(padded), [(FindingKind::ZeroPadding, 40, Some(Place::Sample(0)))]);
        let mut holed = sine(1.0, 300);
        (holed[7], holed[9]) = (f64::NAN, f64::INFINITY);
        assert_eq!(found(holed), [(FindingKind::NotANumber, 2, Some(Place::Sample(7)))]);
        assert_eq!(found(vec![3.0; 50]), [(FindingKind::Constant, 50, None)]);
        let counts = Channel::new("a", Quantity::Unknown, "", sine(16_000.0, 300).into_iter().map(f64::round).collect());
        assert!(inspect(&counts).iter().any(|finding| finding.kind == FindingKind::RawCounts));
    }
}

//! Merging of intervals that overlap or touch.

use super::result::{BandInterval, BandLimit, Bandwidth, IntervalEdge, PowerPeak};

/// Returns the bandwidth of intervals in any order.
pub fn merged(peak: PowerPeak, mut ranges: Vec<BandInterval>) -> Bandwidth {
    ranges.sort_by(|a, b| a.from.parameter.total_cmp(&b.from.parameter));
    let mut intervals: Vec<BandInterval> = Vec::new();
    for range in ranges {
        match intervals.last_mut() {
            Some(last) if range.from.parameter <= last.to.parameter => {
                // An edge at a point inside a branch has no known cause; it yields to an edge with
                // a cause. Of two such edges the larger error counts.
                let knows = |edge: &IntervalEdge, other: &IntervalEdge| {
                    edge.parameter == other.parameter
                        && other.at == BandLimit::End
                        && (edge.at != BandLimit::End
                            || edge.parameter_error > other.parameter_error)
                };
                if range.to.parameter > last.to.parameter || knows(&range.to, &last.to) {
                    last.to = range.to;
                }
                if knows(&range.from, &last.from) {
                    last.from = range.from;
                }
            }
            _ => intervals.push(range),
        }
    }
    let width = intervals
        .iter()
        .map(|range| range.to.parameter - range.from.parameter)
        .sum();
    let width_error = intervals
        .iter()
        .map(|range| range.to.parameter_error + range.from.parameter_error)
        .sum();
    // An isolated stable point next to a stability boundary that is not resolved has width zero;
    // its real width is unknown.
    intervals.retain(|range| range.to.parameter > range.from.parameter);
    Bandwidth {
        peak,
        width,
        width_error,
        intervals,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_without_width_is_none_and_its_error_stays() {
        let edge = |parameter: f64| IntervalEdge {
            parameter,
            parameter_error: 0.25,
            at: BandLimit::Stability,
        };
        let range = |a: f64, b: f64| BandInterval {
            from: edge(a),
            to: edge(b),
        };
        let peak = PowerPeak {
            parameter: 2.0,
            parameter_error: 0.0,
            mean_power_w: 1.0,
            at: BandLimit::Maximum,
        };
        let result = merged(peak, vec![range(1.0, 2.0), range(6.0, 6.0)]);
        assert_eq!(
            (result.intervals.len(), result.width, result.width_error),
            (1, 1.0, 1.0)
        );
    }

    #[test]
    fn ranges_that_touch_are_one_and_their_outer_ends_stay() {
        let edge = |parameter: f64, at: BandLimit| IntervalEdge {
            parameter,
            parameter_error: 0.5,
            at,
        };
        let range = |a: f64, b: f64| BandInterval {
            from: edge(a, BandLimit::HalfPower),
            to: edge(b, BandLimit::Stability),
        };
        let peak = PowerPeak {
            parameter: 2.0,
            parameter_error: 0.0,
            mean_power_w: 1.0,
            at: BandLimit::Maximum,
        };
        let result = merged(
            peak,
            vec![
                range(5.0, 6.0),
                range(1.0, 2.0),
                range(2.0, 3.0),
                range(1.5, 1.7),
            ],
        );
        let ends: Vec<(f64, f64)> = result
            .intervals
            .iter()
            .map(|one| (one.from.parameter, one.to.parameter))
            .collect();
        assert_eq!(ends, [(1.0, 3.0), (5.0, 6.0)]);
        assert!(
            result.width == 3.0
                && result.width_error == 2.0
                && result.intervals[0].to.at == BandLimit::Stability
        );
    }
}

//! Simplification of a branch for drawing.

use super::branch::{Branch, BranchPoint};

/// Quantities of a branch that are drawn, each over its range on the branch.
const SHOWN_QUANTITIES: [fn(&BranchPoint) -> f64; 8] = [
    |point| point.orbit.mean_power_w,
    |point| point.orbit.mean_power_w.max(f64::MIN_POSITIVE).ln(),
    |point| point.orbit.voltage_rms_v,
    |point| point.orbit.max_penetration_m,
    |point| point.orbit.max_contact_force_n,
    |point| point.orbit.max_impact_velocity_m_s,
    |point| point.orbit.displacement_peak_m,
    |point| point.orbit.floquet_max_abs(),
];

impl Branch {
    /// Returns the branch without the points whose removal moves no drawn curve by more than a
    /// fraction of the height (Ramer 1972, Douglas and Peucker 1973).
    pub fn thinned(&self, share: f64) -> Branch {
        let x = self.scaled(|point| point.parameter);
        let curves = SHOWN_QUANTITIES.map(|quantity| self.scaled(quantity));
        let mut selected = vec![false; self.points.len()];
        let mut segments = Vec::new();
        if let Some(last) = self.points.len().checked_sub(1) {
            (selected[0], selected[last]) = (true, true);
            segments.push((0, last));
        }
        while let Some((first, last)) = segments.pop() {
            let far = |k: usize| {
                curves
                    .iter()
                    .map(|y| distance([&x, y], (first, k, last)))
                    .fold(0.0, f64::max)
            };
            let farthest = (first + 1..last)
                .map(|k| (far(k), k))
                .max_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((_, k)) = farthest.filter(|(far, _)| *far > share) {
                selected[k] = true;
                segments.extend([(first, k), (k, last)]);
            }
        }
        let points = self
            .points
            .iter()
            .zip(selected)
            .filter(|(_, is_selected)| *is_selected)
            .map(|(point, _)| point.clone())
            .collect();
        Branch {
            points,
            ..self.clone()
        }
    }

    fn scaled(&self, quantity: fn(&BranchPoint) -> f64) -> Vec<f64> {
        let values: Vec<f64> = self.points.iter().map(quantity).collect();
        let (low, high) = values
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                (low.min(*value), high.max(*value))
            });
        let width = if high > low { high - low } else { 1.0 };
        values.iter().map(|value| (value - low) / width).collect()
    }
}

/// Returns the distance of a point of a curve from the chord between two others.
fn distance([x, y]: [&Vec<f64>; 2], (first, k, last): (usize, usize, usize)) -> f64 {
    let (chord, offset) = (
        (x[last] - x[first], y[last] - y[first]),
        (x[k] - x[first], y[k] - y[first]),
    );
    let square = chord.0 * chord.0 + chord.1 * chord.1;
    let along = if square > 0.0 {
        ((offset.0 * chord.0 + offset.1 * chord.1) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (offset.0 - along * chord.0).hypot(offset.1 - along * chord.1)
}

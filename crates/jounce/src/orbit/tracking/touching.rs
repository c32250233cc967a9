//! A turning point on the surface of the stop, as a scalar: its distance past the surface, beside the size of the motion.

use super::condition::Gradient;
use crate::orbit::{Shot, nearest_extremum_m};
use faer::ColRef;

/// Move of each state for a difference, beside the size of the state.
const MOVE: f64 = 1e-6;

/// `g` with its gradient by differences; `None` without a turning point. See [`super::Condition::gradient`].
pub fn gradient<E>(
    shot: &Shot,
    aside: [&Shot; 2],
    differences: [f64; 2],
    moved: impl Fn(&[f64]) -> Result<Shot, E>,
) -> Result<Option<Gradient>, E> {
    let scale_m = shot.kernel.plant.scale_m();
    let distance = |shot: &Shot| nearest_extremum_m(shot).map(|distance_m| distance_m / scale_m);
    let Some(value) = distance(shot) else { return Ok(None) };
    let start = &shot.looks[0];
    let step = MOVE * ColRef::from_slice(start).norm_l2();
    let mut by_unknown = Vec::with_capacity(start.len());
    for j in 0..start.len() {
        let mut by = vec![0.0; start.len()];
        by[j] = step;
        let Some(there) = distance(&moved(&by)?) else { return Ok(None) };
        by_unknown.push((there - value) / step);
    }
    let [Some(first), Some(second)] = [distance(aside[0]), distance(aside[1])] else { return Ok(None) };
    let by_parameters = [(first - value) / differences[0], (second - value) / differences[1]];
    Ok(Some(Gradient { value, by_unknown, by_parameters }))
}

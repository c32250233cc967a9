//! Values to paths in pixels: gaps, distant points, and more points than pixels.

use std::fmt::Write as _;

use crate::svg::number;

/// Returns the points of a series in pixels of its frame, one run for each segment without a gap.
pub(super) fn runs(points: impl Iterator<Item = Option<(f64, f64)>>) -> Vec<Vec<(f64, f64)>> {
    let mut runs = vec![Vec::new()];
    for point in points {
        match (point, runs.last_mut()) {
            (Some((x, y)), Some(run)) => run.push((
                x.clamp(-MAX_PIXEL_DISTANCE, MAX_PIXEL_DISTANCE),
                y.clamp(-MAX_PIXEL_DISTANCE, MAX_PIXEL_DISTANCE),
            )),
            _ => runs.push(Vec::new()),
        }
    }
    runs.retain(|run| !run.is_empty());
    runs
}

/// Points farther outside than this are moved to this distance, pixels: renderers fail at huge
/// coordinates.
const MAX_PIXEL_DISTANCE: f64 = 1e5;

/// Returns the path along the points of a run; a single point becomes a dot.
pub(super) fn path(run: &[(f64, f64)]) -> String {
    let mut steps = String::new();
    let thinned = simplify(run);
    for (index, (x, y)) in thinned.iter().enumerate() {
        let _ = write!(
            steps,
            "{}{} {}",
            if index == 0 { "M" } else { "L" },
            number(*x),
            number(*y)
        );
    }
    if thinned.len() == 1 {
        steps.push_str("h0");
    }
    steps
}

/// Keeps at most four points in each column of half a pixel: first, lowest, highest, last. The
/// picture does not change.
fn simplify(run: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let ordered = run.windows(2).all(|pair| pair[0].0 <= pair[1].0);
    if !ordered || run.len() < 2000 {
        return run.to_vec();
    }
    let column = |point: &(f64, f64)| (2.0 * point.0).floor();
    let mut thinned = Vec::new();
    for points in run.chunk_by(|a, b| column(a) == column(b)) {
        let extreme = |sign: f64| {
            (0..points.len())
                .max_by(|&a, &b| (sign * points[a].1).total_cmp(&(sign * points[b].1)))
                .unwrap_or(0)
        };
        let mut selected = vec![0, extreme(1.0), extreme(-1.0), points.len() - 1];
        selected.sort_unstable();
        selected.dedup();
        thinned.extend(selected.into_iter().map(|index| points[index]));
    }
    thinned
}

/// Returns points along a run no farther than `step` pixels apart: the area covered by the line.
pub(super) fn along(run: &[(f64, f64)], step: f64) -> Vec<(f64, f64)> {
    let mut points = run.first().copied().into_iter().collect::<Vec<_>>();
    for pair in simplify(run).windows(2) {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        let count = ((x1 - x0).hypot(y1 - y0) / step).ceil().clamp(1.0, 1000.0);
        points.extend(
            (1..=count as usize)
                .map(|i| i as f64 / count)
                .map(|s| (x0 + s * (x1 - x0), y0 + s * (y1 - y0))),
        );
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_split_a_line_and_far_points_come_nearer() {
        let points = [
            Some((0.0, 1.0)),
            Some((1.0, 1e30)),
            None,
            None,
            Some((3.0, 1.0)),
        ];
        assert_eq!(
            runs(points.into_iter()),
            [vec![(0.0, 1.0), (1.0, 1e5)], vec![(3.0, 1.0)]]
        );
        assert_eq!(path(&[(0.0, 1.0), (2.5, 3.0)]), "M0 1L2.5 3");
        assert_eq!(path(&[(0.0, 1.0)]), "M0 1h0");
    }

    #[test]
    fn a_dense_record_keeps_its_extremes_in_few_points() {
        let run: Vec<_> = (0..200_000)
            .map(|i| {
                (
                    f64::from(i) * 600.0 / 2e5,
                    (f64::from(i) * 0.37).sin() * 100.0,
                )
            })
            .collect();
        let thinned = simplify(&run);
        assert!(thinned.len() <= 4800, "{}", thinned.len());
        let highest = |points: &[(f64, f64)]| points.iter().fold(f64::MIN, |m, p| m.max(p.1));
        assert_eq!(highest(&run), highest(&thinned));
        assert_eq!((run[0], run.last()), (thinned[0], thinned.last()));
    }
}

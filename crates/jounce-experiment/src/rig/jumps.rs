//! Times at which the record of a shaker test jumps between solutions.

use jounce_analysis::run::StartState;
use jounce_spec::Spec;

use super::ShakerTest;
use super::disturbance::DriveCourse;

/// Times of the starts, s of the run: the first at once, the others at the start of a cycle of the
/// first drive.
pub(super) fn jumps<'a>(
    spec: &Spec,
    test: &'a ShakerTest,
    drive_courses: &[(String, DriveCourse)],
) -> Vec<(f64, &'a StartState)> {
    let cycle = |at_s: f64| match drive_courses.first() {
        Some((_, drive_course)) => {
            let cycles = |k: usize| {
                (drive_course.angle_rad[k] - drive_course.angle_rad[0]) / std::f64::consts::TAU
            };
            let first =
                ((at_s / drive_course.step_s) as usize).min(drive_course.angle_rad.len() - 2);
            let next_cycle = cycles(first).ceil();
            let k = (first..drive_course.angle_rad.len() - 1)
                .find(|k| cycles(k + 1) >= next_cycle)
                .unwrap_or(first);
            let step_share =
                ((next_cycle - cycles(k)) / (cycles(k + 1) - cycles(k))).clamp(0.0, 1.0);
            (k as f64 + step_share) * drive_course.step_s
        }
        None => {
            let period_s = spec
                .drive
                .values()
                .find_map(|drive| drive.frequency_hz())
                .map_or(0.0, f64::recip);
            if period_s > 0.0 {
                (at_s / period_s - 1e-9).ceil() * period_s
            } else {
                at_s
            }
        }
    };
    let at = |(number, (at_s, start)): (usize, &'a (f64, StartState))| {
        (
            if number == 0 {
                0.0
            } else {
                cycle(test.before_s + at_s)
            },
            start,
        )
    };
    test.starts.iter().enumerate().map(at).collect()
}

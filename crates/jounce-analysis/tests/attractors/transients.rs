//! Chaotic transients: starts that the library reports end on different orbits in integrations with
//! different errors.

use crate::checks::published::{bench, harvester};
use crate::harvesters::cloud;
use jounce_analysis::{Basins, Model, Recognition};
use jounce_spec::SpecFile;

/// An impact oscillator with orbits of four and of eight drive cycles.
const OSCILLATOR: &str = r#"
[modal.o]
frequency_hz = [10.0]
damping_ratio = [0.015]
[modal.o.point]
tip = [1.0]
[stop.tip]
at = "o.tip"
gap = "0 mm"
law = "hertz"
stiffness = "4e5 N/m"
exponent = 1
[drive.shaker]
at = "o.tip"
kind = "force"
amplitude = "1 N"
frequency = "31.4 Hz"
"#;

const STARTS: usize = 200;

/// Number of the attractor of each start, and whether its transient is reported as chaotic.
fn ends(base: &Model, tolerance: f64) -> Vec<(u32, bool)> {
    let result = Basins {
        base,
        starts: cloud(STARTS),
        recognition: Recognition::at(tolerance),
    }
    .run()
    .unwrap();
    let period = |start: usize| {
        let reached = result
            .attractors
            .iter()
            .find(|attractor| attractor.starts.contains(&start));
        reached.unwrap().period_cycles
    };
    (0..STARTS)
        .map(|start| (period(start), result.chaotic_transients.contains(&start)))
        .collect()
}

/// If roundoff decides between two orbits of the shares 0.63 and 0.37, three integrations agree for
/// 0.63^3 + 0.37^3 = 30 % of the starts.
#[test]
fn starts_with_chaotic_transients_end_differently_at_other_tolerances() {
    let base = Model::new(SpecFile::from_text(OSCILLATOR).spec().unwrap()).unwrap();
    let all = [1e-8, 1e-9, 1e-10].map(|tolerance| ends(&base, tolerance));
    let is_reported = |start: &usize| all.iter().any(|ends| ends[*start].1);
    let differs = |start: &usize| all.iter().any(|ends| ends[*start].0 != all[0][*start].0);
    let reported: Vec<usize> = (0..STARTS).filter(is_reported).collect();
    let different = reported.iter().copied().filter(differs).count();
    assert!(
        reported.len() >= STARTS / 10 && 2 * different > reported.len(),
        "{different} of {} differ",
        reported.len()
    );
}

/// Lightly damped motions reach orbits of 1, 3 and 18 drive cycles after a thousand cycles.
#[test]
fn a_regular_transient_is_not_reported_as_chaotic() {
    let base = Model::new(harvester(bench()).spec().unwrap()).unwrap();
    let ends = ends(&base, 1e-9);
    assert!(ends.iter().any(|end| end.0 == 1) && ends.iter().any(|end| end.0 == 18));
    assert!(ends.iter().all(|(_, is_reported)| !is_reported));
}

/// One orbit attracts all starts, also those with chaotic impacts before: roundoff decides nothing.
#[test]
fn a_single_attractor_leaves_nothing_to_roundoff() {
    let text = OSCILLATOR.replace("0.015", "0.0005").replace("0 mm", "1 m");
    let base = Model::new(SpecFile::from_text(text).spec().unwrap()).unwrap();
    assert!(
        ends(&base, 1e-9)
            .iter()
            .all(|(_, is_reported)| !is_reported)
    );
}

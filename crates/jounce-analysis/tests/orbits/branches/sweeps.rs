//! Runs against branches: where a run settles there is a stable segment of a branch with equal
//! power.

use crate::harvesters::{bench, branches};
use jounce_analysis::{OrbitMethodKind, Sweep, SweepOrder};

#[test]
fn sweeps_follow_stable_segments_and_jump_at_the_folds() {
    let file = bench();
    let branches_found = branches(&file, (11.0, 13.0), OrbitMethodKind::Shooting, 0);
    let branch = &branches_found[0];
    let spec = file.spec().unwrap();
    let range = file
        .range("drive.shaker.frequency=11Hz:13Hz:0.1Hz")
        .unwrap();
    let sweep = Sweep {
        spec: &spec,
        range: &range,
        direction: SweepOrder::Both,
        fixed_duration: false,
        folder: "".into(),
    };
    let points = sweep
        .run(None, &jounce_control::Control::default(), &|_| ())
        .unwrap();
    let (mut hits, mut worst) = (0, 0.0_f64);
    for point in points
        .iter()
        .filter(|point| point.settled && point.period_cycles == 1)
    {
        let crossings = branch.crossings(point.parameter);
        let distance = crossings
            .iter()
            .map(|(_, power_w)| (power_w / point.mean_power_w - 1.0).abs());
        let nearest = distance.fold(f64::INFINITY, f64::min);
        worst = worst.max(nearest);
        hits += 1;
    }
    eprintln!("{hits} settled points, farthest {worst:.1e} from the interpolated branch");
    assert!(hits > 15 && worst < 2e-2, "{hits} points, {worst:e}");
    let fold = branch
        .bifurcations
        .iter()
        .find(|b| b.kind.name() == "fold")
        .unwrap()
        .at
        .parameter;
    let up: Vec<_> = points
        .iter()
        .filter(|p| p.direction.name() == "up")
        .collect();
    let jump = up
        .windows(2)
        .find(|pair| pair[1].mean_power_w < 0.1 * pair[0].mean_power_w)
        .unwrap();
    eprintln!(
        "jump between {} and {} Hz, fold at {fold:.4} Hz",
        jump[0].parameter, jump[1].parameter
    );
    assert!(jump[0].parameter < fold && fold < jump[1].parameter + 1e-9);
}

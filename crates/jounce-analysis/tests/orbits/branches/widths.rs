//! Peaks and half-power bandwidths against closed forms, and against runs where the harvester
//! strikes its stop.

use crate::harvesters::{bench, bench_with_keys};
use jounce_analysis::{
    BandLimit, BandwidthSearch, Bandwidths, Branch, BranchKind, BranchSearch, Model,
    OrbitMethodKind, Parameter, settled_orbit,
};
use jounce_model::linear::steady_power_w;
use jounce_spec::SpecFile;

/// One mode with a load of negligible damping.
const OSCILLATOR: &str = r#"
[modal.oscillator]
frequency_hz = [10.0]
damping_ratio = [0.02]
[modal.oscillator.point]
tip = [1.0]
[modal.oscillator.patch.mfc]
coupling_n_per_v = [1e-5]
capacitance = "10 nF"
[stop.tip]
at = "oscillator.tip"
frame = "ground"
law = "hertz"
gap = "500 mm"
stiffness = "1000 N/m^1.5"
[circuit.load]
patch = "oscillator.mfc"
resistance = "10 ohm"
[drive.shaker]
at = "oscillator.tip"
kind = "force"
amplitude = "1 N"
frequency = "10 Hz"
[run]
start = "rest"
duration = "20 s"
average_over = "10 s"
"#;

/// Branches over the frequency of the shaker up to a period, from the ends of the range, with their
/// bandwidths.
fn branches_with_widths(
    file: &SpecFile,
    range: (f64, f64),
    tolerance: f64,
    longest_period: u32,
) -> (Vec<Branch>, Bandwidths) {
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range,
        method: OrbitMethodKind::Shooting,
        tolerance,
        seeds: 0,
        longest_period,
    };
    let branches = search.run().unwrap();
    let widths = BandwidthSearch {
        base: &base,
        parameter: &parameter,
        range,
        tolerance,
    }
    .run(&branches);
    (branches, widths)
}

fn widths(file: &SpecFile, range: (f64, f64), tolerance: f64) -> Bandwidths {
    branches_with_widths(file, range, tolerance, 1).1
}

/// Power of a purely resistive load follows the speed:
/// `P ~ w^2 / ((w0^2 - w^2)^2 + (2 zeta w0 w)^2)`. It is largest at `w0` and half at
/// `w0 (sqrt(1 + zeta^2) +- zeta)`, so the bandwidth is exactly `2 zeta w0`. The load adds 1e-9 of
/// the damping.
///
/// Measured at tolerance 1e-10: peak off by 1e-9 Hz, edges by 2e-9 Hz, inside the stated errors.
#[test]
fn the_bandwidth_of_one_mode_is_that_of_the_closed_form() {
    let widths_found = widths(&SpecFile::from_text(OSCILLATOR), (8.0, 12.0), 1e-10);
    let width = widths_found.branches[0].as_ref().unwrap();
    let (zeta, own_hz) = (0.02_f64, 10.0);
    eprintln!("{width:?}");
    assert!((width.peak.parameter - own_hz).abs() < 1e-7 && width.peak.at == BandLimit::Maximum);
    assert!((width.peak.parameter - own_hz).abs() < width.peak.parameter_error);
    let [interval] = width.intervals[..] else {
        panic!("{:?}", width.intervals)
    };
    for (edge, sign) in [(interval.from, -1.0), (interval.to, 1.0)] {
        let exact = own_hz * ((1.0 + zeta * zeta).sqrt() + sign * zeta);
        let error = (edge.parameter - exact).abs();
        eprintln!(
            "edge {:.12} Hz, closed form {exact:.12}, off {error:.1e}, stated {:.1e}",
            edge.parameter, edge.parameter_error
        );
        assert!(
            error < 1e-7
                && error < edge.parameter_error.max(2e-8)
                && edge.at == BandLimit::HalfPower
        );
    }
    assert!((width.width - 2.0 * zeta * own_hz).abs() < 1e-7);
    assert_eq!(widths_found.together.as_ref(), Some(width));
}

/// The branch of two cycles is stable up to the two doublings of its parent, which the bandwidth does
/// not locate.
#[test]
fn the_error_of_an_end_at_a_doubling_covers_the_doubling() {
    let file = bench_with_keys(&[
        ("drive.shaker.amplitude", "\"80 N\""),
        ("stop.tip.gap", "\"3 mm\""),
    ]);
    let range = (4.0, 5.2);
    let (branches, widths) = branches_with_widths(&file, range, 1e-9, 2);
    let doublings: Vec<f64> = (branches.iter().flat_map(|branch| &branch.bifurcations))
        .filter(|label| label.kind == BranchKind::PeriodDoubling)
        .map(|label| label.at.parameter)
        .collect();
    let doubled = (branches.iter().zip(&widths.branches))
        .filter_map(|(branch, width)| width.as_ref().filter(|_| branch.period_cycles == 2));
    let ends: Vec<_> = doubled
        .flat_map(|width| &width.intervals)
        .flat_map(|interval| [interval.from, interval.to])
        .filter(|edge| edge.at == BandLimit::End && ![range.0, range.1].contains(&edge.parameter))
        .collect();
    assert_eq!(ends.len(), 2, "{ends:?}");
    for end in ends {
        let off = |doubling: &f64| (end.parameter - doubling).abs();
        let nearest = doublings.iter().map(off).fold(f64::INFINITY, f64::min);
        eprintln!("{nearest:.1e} Hz off, stated {:.1e}", end.parameter_error);
        assert!(nearest <= end.parameter_error, "{end:?} {doublings:?}");
    }
}

/// A range that ends on the flank of the peak truncates the interval there, and the result states
/// this.
#[test]
fn a_range_that_cuts_the_peak_is_reported() {
    let widths_found = widths(&SpecFile::from_text(OSCILLATOR), (9.0, 9.9), 1e-9);
    let width = widths_found.together.unwrap();
    assert!(
        width.peak.parameter == 9.9 && width.peak.at == BandLimit::End,
        "{:?}",
        width.peak
    );
    assert!(
        width.intervals.len() == 1
            && width.intervals[0].to.at == BandLimit::End
            && width.intervals[0].from.at == BandLimit::HalfPower
    );
}

/// The paper's harvester with its stop out of reach: peak and edges of the steady power of all its
/// modes.
///
/// Measured at tolerance 1e-10: peak off by 3e-10 Hz, edges by 2e-10 Hz.
#[test]
fn the_bandwidth_without_contact_is_that_of_the_steady_power() {
    let mut file = bench();
    file.set("stop.tip.gap", "\"500 mm\"").unwrap();
    let width = widths(&file, (8.3, 9.1), 1e-10).together.unwrap();
    let base = Model::new(file.spec().unwrap()).unwrap();
    let power_w = |frequency_hz: f64| {
        let mut drives = base.kernel.plant.system.drives.clone();
        drives[0].frequency_hz = frequency_hz;
        steady_power_w(&base.kernel.plant.with_drives(drives).unwrap())
    };
    assert!((width.peak.mean_power_w / power_w(width.peak.parameter) - 1.0).abs() < 1e-8);
    // Symmetric about the maximum to third order, so the slope there is zero.
    let (step, at) = (1e-4, width.peak.parameter);
    let (below, above) = (power_w(at - step), power_w(at + step));
    let error = (above - below) / (above + below - 2.0 * power_w(at)) * 0.5 * step;
    eprintln!(
        "peak {at:.10} Hz, off {error:.1e}, stated {:.1e}",
        width.peak.parameter_error
    );
    assert!(error.abs() < 1e-7);
    for edge in [width.intervals[0].from, width.intervals[0].to] {
        let slope = (power_w(edge.parameter + 1e-6) - power_w(edge.parameter - 1e-6)) / 2e-6;
        let error = (power_w(edge.parameter) - 0.5 * width.peak.mean_power_w) / slope;
        eprintln!(
            "edge {:.10} Hz, off {error:.1e}, stated {:.1e}",
            edge.parameter, edge.parameter_error
        );
        assert!(error.abs() < 1e-7);
    }
}

/// With contact the stable part ends at the upper fold; at the lower edge a run reaches half the
/// peak power.
#[test]
fn the_bandwidth_of_the_impact_branch_ends_where_it_stops_being_stable() {
    let (file, range) = (bench(), (11.0, 14.0));
    let widths_found = widths(&file, range, 1e-9);
    let width = widths_found.together.unwrap();
    eprintln!("{width:?}");
    let last = width.intervals.last().unwrap();
    assert!(
        last.to.at == BandLimit::Stability && (last.to.parameter - 12.3218).abs() < 1e-3,
        "{last:?}"
    );
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let parameter = Parameter::new(&base, &key, 3.0);
    let first = width.intervals[0].from;
    assert_eq!(first.at, BandLimit::HalfPower);
    let rest = vec![0.0; base.kernel.plant.len()];
    let orbit = settled_orbit(&parameter, first.parameter, &rest, 1e-9, 1e-9).unwrap();
    let error = orbit.mean_power_w / (0.5 * width.peak.mean_power_w) - 1.0;
    eprintln!(
        "half power at {:.9} Hz, march off by {error:.1e}",
        first.parameter
    );
    assert!(error.abs() < 1e-6);
}

//! Designs with known optima, limits, bad input and interruptions.
#![allow(clippy::unwrap_used, reason = "tests")]

mod bistable;
mod budgets;
mod choices;
mod closed_forms;
mod derivatives;
mod limits;
mod measured;
mod paper;
mod peaks;
mod power_band;
mod robustness;
mod sensor;
mod wrong_input;

use jounce_allocator as _;

use jounce_analysis::Journal;
use jounce_control::Control;
use jounce_design::{DesignError, DesignOutcome, Problem, SearchEnd, design};
use jounce_linalg::c64;
use jounce_model::reference::PiezoResistor;
use jounce_spec::SpecFile;
use std::f64::consts::TAU;
use std::path::Path;

const LINEAR: &str = r#"
[modal.m]
frequency_hz = [10.0]
damping_ratio = [0.02]
[modal.m.point]
tip = [1.3]
[modal.m.patch.p]
coupling_n_per_v = [0.004]
capacitance = "150 nF"
[circuit.load]
patch = "m.p"
resistance = "80 kohm"
[drive.d]
at = "m.tip"
kind = "force"
amplitude = "0.7 N"
frequency = "9.7 Hz"
[run]
duration = "1 s"
average_over = "1 s"
"#;

fn problem_of(spec: &str, text: &str) -> Result<Problem, DesignError> {
    let folder = Path::new("");
    Problem::with_spec(SpecFile::from_text(spec), folder, text, folder)
}

fn outcome_of(spec: &str, text: &str) -> DesignOutcome {
    design(
        &problem_of(spec, text).unwrap(),
        &Control::default(),
        None,
        None,
    )
    .unwrap()
}

fn problem(text: &str) -> Result<Problem, DesignError> {
    problem_of(LINEAR, text)
}

fn outcome(text: &str) -> DesignOutcome {
    outcome_of(LINEAR, text)
}

/// Amplitude of the force, N, and frequency of the drive, Hz.
const FORCE_N: f64 = 0.7;
const DRIVE_HZ: f64 = 9.7;

/// The linear harvester: its mode shape is `1 / sqrt(m)`.
fn harvester(resistance_ohm: f64) -> PiezoResistor {
    let mass_kg = 1.3_f64.powi(-2);
    PiezoResistor {
        mass_kg,
        frequency_rad_s: TAU * 10.0,
        damping_ratio: 0.02,
        coupling_n_per_v: 0.004 * mass_kg.sqrt(),
        capacitance_f: 150e-9,
        resistance_ohm,
    }
}

/// Voltage amplitude and mean power with a resistance at a frequency of the drive.
fn linear_at(resistance_ohm: f64, drive_hz: f64) -> (f64, f64) {
    let per_newton = harvester(resistance_ohm).voltage_per_newton(drive_hz);
    let voltage_v = FORCE_N * per_newton.norm();
    (voltage_v, 0.5 * voltage_v.powi(2) / resistance_ohm)
}

fn linear(resistance_ohm: f64) -> (f64, f64) {
    linear_at(resistance_ohm, DRIVE_HZ)
}

/// The electric port is linear, so the largest power is at `R = 1 / |Y|`, with the admittance `Y` of
/// the port without the load.
fn optimal_resistance() -> f64 {
    let one = harvester(1.0);
    let (w, w0) = (TAU * DRIVE_HZ, one.frequency_rad_s);
    // Y = i w C + i w theta^2 / (m (w0^2 - w^2 + 2 i zeta w0 w))
    let mechanical = c64::new(w0 * w0 - w * w, 2.0 * one.damping_ratio * w0 * w) * one.mass_kg;
    let motion = one.coupling_n_per_v.powi(2) / mechanical;
    1.0 / ((motion + one.capacitance_f) * w).norm()
}

const LOAD: &str = "[free]\n\"circuit.load.resistance\" = \"1kohm:10Mohm:log\"\n\
    [goal]\nmaximise = \"expected-power\"\nstarts = 4\n";

#[test]
fn the_optimal_load_of_a_linear_harvester_has_its_closed_form() {
    let found = outcome(LOAD);
    let expected = linear(optimal_resistance()).1;
    let power = found.best.mean_power_w;
    assert!((power / expected - 1.0).abs() < 1e-8, "{power} {expected}");
    assert!(found.feasible && found.best.stable && found.best.basin_fraction == 1.0);
    assert_eq!(found.ended_by, SearchEnd::Converged);
    let before = linear(80e3).1;
    assert!((found.before.expected_power_w / before - 1.0).abs() < 1e-7);
}

/// The voltage rises with the resistance, so a limit below the voltage at the optimal load binds,
/// and its price is the slope of power by voltage.
#[test]
fn a_binding_limit_has_its_price() {
    let limit = 0.8 * linear(optimal_resistance()).0;
    let found = outcome(&format!(
        "{LOAD}[limits]\n\"patch.m.p.voltage\" = \"{limit} V\"\n"
    ));
    let (mut low, mut high) = (1e3, optimal_resistance());
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if linear(middle).0 < limit {
            low = middle;
        } else {
            high = middle;
        }
    }
    let [voltage] = &found.limits[..] else {
        panic!("{found:?}")
    };
    assert!(found.feasible && voltage.active && voltage.value <= limit);
    // The search stays a thousandth below a limit.
    assert!((found.best.mean_power_w / linear(low).1 - 1.0).abs() < 3e-3);
    let slope = (linear(1.001 * low).1 - linear(0.999 * low).1)
        / (linear(1.001 * low).0 - linear(0.999 * low).0);
    let price = voltage.price.unwrap();
    assert!((price / slope - 1.0).abs() < 1e-2, "{price} {slope}");
}

#[test]
fn limits_that_cannot_be_kept_leave_the_least_violation() {
    let found = outcome(&format!(
        "{LOAD}[limits]\n\"patch.m.p.voltage\" = \"1 mV\"\n"
    ));
    let (share, largest) = (1.0 - found.violation, 1e-3 / linear(1e3).0);
    assert!(!found.feasible && share < 1.1 * largest && share > 0.9 * largest);
}

/// The drive at twice the weight of another one: the weighted mean is maximised.
#[test]
fn conditions_have_weights() {
    let found = outcome(&format!(
        "evaluations = 400\n{LOAD}\
         [[conditions]]\nset = {{ \"drive.d.amplitude\" = \"0.7 N\" }}\nweight = 2\n\
         [[conditions]]\nset = {{ \"drive.d.amplitude\" = \"1.4 N\" }}\n"
    ));
    // Power grows with the square of the force: (2 + 4) / 3 of that at 0.7 N.
    let expected = 2.0 * linear(optimal_resistance()).1;
    let power = found.best.goals["expected-power"];
    assert!((power / expected - 1.0).abs() < 1e-5, "{power} {expected}");
}

#[test]
fn all_faults_of_a_file_are_listed_at_once() {
    let text = "sed = 1\nevaluations = 0\n[free]\n\"circuit.load.resistance\" = \"10kohm:1kohm\"\n\
        \"stop.x.gap\" = \"1mm:2mm\"\n[goal]\nmaximise = \"power\"\n[limits]\n\"patch.m.q.voltage\" = \"3 V\"\n\
        [tolerance]\n\"drive.d.amplitude\" = \"-1 N\"\n";
    let Err(DesignError::Faults(faults)) = problem(text) else {
        panic!("no faults")
    };
    let messages: Vec<String> = faults.iter().map(ToString::to_string).collect();
    let all = messages.join("\n");
    for expected in [
        "sed",
        "evaluations",
        "circuit.load.resistance",
        "stop.x.gap",
        "expected-power",
        "patch.m.p.voltage",
        "drive.d.amplitude",
    ] {
        assert!(all.contains(expected), "{expected}: {all}");
    }
    assert!(
        faults
            .iter()
            .all(|fault| fault.line > 0 || fault.key.is_empty()),
        "{all}"
    );
    let missing = problem("[goal]\nmaximise = \"expected-power\"").unwrap_err();
    assert!(missing.to_string().contains("[free]"), "{missing}");
}

/// A search keeps its budget: through probes, refinements and generations.
#[test]
fn a_search_evaluates_no_more_designs_than_allowed() {
    let limit = format!("{LOAD}[limits]\n\"patch.m.p.voltage\" = \"5 V\"\n");
    let sensor = LOAD.replace("expected-power", "mean-power");
    for text in [LOAD, &limit, &sensor] {
        for most in [10, 25, 70, 150] {
            let mut problem = problem(text).unwrap();
            problem.evaluations = most;
            let found = design(&problem, &Control::default(), None, None).unwrap();
            assert!(found.evaluations <= most, "{} of {most}", found.evaluations);
        }
    }
}

/// No run of two cycles settles; the result says why its power is 0.
#[test]
fn a_power_of_unsettled_runs_is_explained() {
    let spec = LINEAR.replace("1 s", "0.2 s");
    let text = LOAD.replace("expected-power", "mean-power");
    let found = outcome_of(&spec, &format!("evaluations = 10\n{text}"));
    let explains = |text: &String| text.contains("increase run.duration");
    assert_eq!(found.best.goals["mean-power"], 0.0);
    assert!(found.warnings.iter().any(explains), "{:?}", found.warnings);
}

/// A search that a budget interrupts leaves a journal, from which the complete search gives the
/// result of an uninterrupted one.
#[test]
fn an_interrupted_search_continues_from_its_journal() {
    let folder = tempfile::tempdir().unwrap();
    let complete = problem(LOAD).unwrap();
    let mut short = complete.clone();
    short.evaluations = 20;
    let open = || Journal::open(folder.path(), "key").unwrap();
    let control = Control::default();
    let begun = design(&short, &control, Some(&open()), None).unwrap();
    assert_eq!(begun.ended_by, SearchEnd::Evaluations);
    assert!(open().found().len() >= 3);
    let continued = design(&complete, &control, Some(&open()), None).unwrap();
    let expected = design(&complete, &control, None, None).unwrap();
    assert_eq!(continued.best, expected.best);
    assert_eq!(continued.trace, expected.trace);
}

/// Far below its resonance a beam of the softer material bends more, and its patch has more power.
#[test]
fn a_choice_is_searched_and_compared_with_the_spec_as_given() {
    let spec = "[beam.b]\nmaterial = \"steel\"\nlength = \"100 mm\"\nwidth = \"20 mm\"\nthickness = \"1 mm\"\n\
        [patch.p]\non = \"b\"\nmaterial = \"MFC-P2\"\nstart = \"0 mm\"\nlength = \"50 mm\"\nwidth = \"20 mm\"\nthickness = \"0.3 mm\"\n\
        [circuit.load]\npatch = \"p\"\nresistance = \"100 kohm\"\n\
        [drive.d]\nat = \"b.end\"\namplitude = \"0.1 N\"\nfrequency = \"20 Hz\"\n[damping]\nbeyond = 0.01\n\
        [reduction]\nmodes = 4\n[run]\nduration = \"1 s\"\naverage_over = \"1 s\"\n";
    let text = "evaluations = 60\n[free]\n\"beam.b.material\" = [\"aluminium\", \"steel\"]\n\
        [goal]\nmaximise = \"expected-power\"\nstarts = 2\n";
    let found = outcome_of(spec, text);
    let [material] = &found.best.keys[..] else {
        panic!("{found:?}")
    };
    assert_eq!(
        (material.value.as_str(), material.before.as_str()),
        ("aluminium", "steel")
    );
    assert!(
        found.best.expected_power_w > 1.5 * found.before.expected_power_w,
        "{found:?}"
    );
}

#[test]
fn a_stopped_search_without_a_design_says_so() {
    let control = Control::default();
    control.stop();
    let stopped = design(&problem(LOAD).unwrap(), &control, None, None);
    assert!(matches!(stopped, Err(DesignError::Stopped)), "{stopped:?}");
}

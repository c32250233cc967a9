//! Designs under band-limited noise and under a recorded gait.

use super::{
    DRIVE_HZ, FORCE_N, LINEAR, harvester, linear, optimal_resistance, outcome_of, problem_of,
};
use jounce_design::Problem;
use jounce_linalg::c64;
use jounce_signal::RandomStream;
use jounce_spec::{Quantity, SpecFile};
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::io::Write;
use std::path::Path;

const CANTILEVER: &str = "[beam.b]\nmaterial = \"steel\"\nlength = \"100 mm\"\nwidth = \"15 mm\"\nthickness = \"0.4 mm\"\n\
    [patch.p]\non = \"b\"\nmaterial = \"MFC-P2\"\nstart = \"2 mm\"\nlength = \"40 mm\"\nwidth = \"14 mm\"\nthickness = \"0.3 mm\"\n\
    [mass.tip]\non = \"b.end\"\nmass = \"20 g\"\n\
    [stop.above]\nat = \"b.end\"\ngap = \"20 mm\"\nlaw = \"kelvin-voigt\"\nstiffness = \"2e3 N/m\"\ndamping = \"1 N s/m\"\n\
    [circuit.load]\npatch = \"p\"\nresistance = \"200 kohm\"\n\
    [damping]\nbeyond = 0.01\n[reduction]\nmodes = 2\n";

/// Band-limited noise drives a linear harvester: the best load is that of a scan over loads.
#[test]
fn the_best_load_under_noise_is_that_of_a_scan() {
    let spec = LINEAR
        .replace(
            "amplitude = \"0.7 N\"",
            "signal = \"noise\"\npsd = \"0.1 N^2/Hz\"\nlow = \"5 Hz\"",
        )
        .replace("frequency = \"9.7 Hz\"", "high = \"20 Hz\"")
        .replace("duration = \"1 s\"", "duration = \"8 s\"")
        .replace("average_over = \"1 s\"", "average_over = \"6 s\"");
    let goal = "[goal]\nmaximise = \"mean-power\"\n";
    let design = |range: &str, evaluations: usize| {
        let free = format!(
            "evaluations = {evaluations}\n[free]\n\"circuit.load.resistance\" = \"{range}\"\n"
        );
        outcome_of(&spec, &format!("{free}{goal}"))
    };
    let found = design("10kohm:1Mohm:log", 100);
    // A range of 0.1 % about each load has its power.
    let scan = (0..21).map(|k| {
        let load_ohm = 1e4 * 100_f64.powf(f64::from(k) / 20.0);
        design(&format!("{load_ohm}ohm:{}ohm", 1.001 * load_ohm), 4)
            .best
            .mean_power_w
    });
    let best_w = scan.fold(0.0, f64::max);
    let power_w = found.best.mean_power_w;
    assert!(
        power_w >= best_w && power_w < 1.02 * best_w,
        "{power_w} {best_w}"
    );
    let noise = found.best.noise.unwrap();
    let exact_w = mean_power_under_noise_w(load_ohm(&found.best.keys[0].value));
    assert!(noise.realisations == 16 && noise.mean_power_high_w < 1.2 * exact_w);
    assert!(
        noise.mean_power_low_w < exact_w && exact_w < noise.mean_power_high_w,
        "{noise:?} {exact_w}"
    );
}

/// Returns a resistance from its text with the unit.
fn load_ohm(text: &str) -> f64 {
    Quantity::Resistance.read(text).unwrap()
}

/// Returns `S / R` times the integral of `|V / F|^2` over the band from 5 to 20 Hz.
fn mean_power_under_noise_w(resistance_ohm: f64) -> f64 {
    const LINES: u32 = 30_000;
    let step_hz = 15.0 / f64::from(LINES);
    let harvester = harvester(resistance_ohm);
    let square = |k: u32| {
        harvester
            .voltage_per_newton(5.0 + (f64::from(k) + 0.5) * step_hz)
            .norm_sqr()
    };
    0.1 / resistance_ohm * step_hz * (0..LINES).map(square).sum::<f64>()
}

/// Writes a recorded sine with half the force of the spec.
fn write_force(path: &Path) {
    let rate_hz = 200.0 * DRIVE_HZ;
    let row = |k: u32| {
        let time_s = f64::from(k) / rate_hz;
        format!(
            "{time_s:.9},{:.9}\n",
            0.5 * FORCE_N * (TAU * DRIVE_HZ * time_s).sin()
        )
    };
    let rows: String = (0..=(8.5 * rate_hz) as u32).map(row).collect();
    std::fs::write(path, format!("time [s],force [N]\n{rows}")).unwrap();
}

/// A recorded force next to the sine of the spec, with half its amplitude: a quarter of its power, by the
/// closed form of the linear response.
#[test]
fn a_recording_is_a_condition_with_its_weight() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("force.csv");
    write_force(&path);
    let spec = LINEAR
        .replace("duration = \"1 s\"", "duration = \"8 s\"")
        .replace(
            "average_over = \"1 s\"",
            &format!("average_over = \"{} s\"", 20.0 / DRIVE_HZ),
        );
    let text = |recorded: &str| {
        format!(
            "evaluations = 60\n[free]\n\"circuit.load.resistance\" = \"10kohm:1Mohm:log\"\n\
             [goal]\nmaximise = \"mean-power\"\n[limits]\n\"patch.m.p.voltage\" = \"1 kV\"\n\
             [[conditions]]\nset = {{ \"run.start\" = \"linear\" }}\nweight = 1\n\
             [[conditions]]\nset = {{ {recorded} }}\nweight = 3\n"
        )
    };
    let file = path.display();
    let table = format!(
        "\"drive.d\" = {{ at = \"m.tip\", kind = \"force\", signal = \"recording\", file = '{file}' }}"
    );
    let keys = format!(
        "\"drive.d.amplitude\" = \"\", \"drive.d.frequency\" = \"\", \"drive.d.signal\" = \"recording\", \"drive.d.file\" = '{file}'"
    );
    let found = [table, keys].map(|recorded| outcome_of(&spec, &text(&recorded)));
    // The same condition with its table below a header.
    let header = text("").replace("set = {  }\n", "");
    let header = format!(
        "{header}[conditions.set.\"drive.d\"]\nat = \"m.tip\"\nkind = \"force\"\nsignal = \"recording\"\nfile = '{file}'\n"
    );
    assert_eq!(outcome_of(&spec, &header).before, found[0].before);
    let (voltage_v, power_w) = linear(80e3);
    let expected_w = power_w * (1.0 + 3.0 / 4.0) / 4.0;
    let before_w = found[0].before.goals["mean-power"];
    assert!(
        (before_w / expected_w - 1.0).abs() < 2e-3,
        "{before_w} {expected_w}"
    );
    // Both powers are largest at the same load.
    let best_w = found[0].best.goals["mean-power"];
    let largest_w = linear(optimal_resistance()).1 * 7.0 / 16.0;
    assert!(
        (best_w / largest_w - 1.0).abs() < 2e-3,
        "{best_w} {largest_w}"
    );
    assert!(found[0].limits[0].value > voltage_v && found[0].limits[0].noise.is_none());
    assert_eq!(found[0].best, found[1].best);
    let error = problem_of(&spec, &text("\"drive.d.fil\" = \"a.csv\"")).unwrap_err();
    assert!(error.to_string().contains("drive.d.fil"), "{error}");
    let orbits = text(&format!(
        "\"drive.d\" = {{ at = \"m.tip\", kind = \"force\", signal = \"recording\", file = '{file}' }}"
    ));
    let orbits = orbits.replace("mean-power", "expected-power");
    let error = problem_of(&spec, &orbits).unwrap_err().to_string();
    assert!(error.contains("choose \"mean-power\""), "{error}");
}

/// The largest voltage of a run under noise, from sums of sinusoids of random amplitudes through the
/// closed form of the response: runs in which it exceeds its median are half of all, and the median is
/// that of Rice's crossings, `s sqrt(2 ln(2 f T / ln 2))`, which for a narrow band is a little large.
#[test]
fn limits_under_noise_are_exceeded_as_often_as_in_simulated_responses() {
    let peaks_v = simulated_peaks_v();
    let median_v = 0.5 * (peaks_v[SIMULATED / 2 - 1] + peaks_v[SIMULATED / 2]);
    let deviation_v = (mean_power_under_noise_w(80e3) * 80e3).sqrt();
    let crossings = 2.0 * 9.9 * WINDOW_S / 2.0_f64.ln();
    let rice_v = deviation_v * (2.0 * crossings.ln()).sqrt();
    assert!(
        (0.85..1.0).contains(&(median_v / rice_v)),
        "{median_v} {rice_v}"
    );
    let found = outcome_of(
        &noisy(),
        &format!(
            "evaluations = 1\n[free]\n\"circuit.load.resistance\" = \"79kohm:81kohm\"\n\
             [goal]\nmaximise = \"mean-power\"\n[limits]\n\"patch.m.p.voltage\" = \"{median_v} V\"\n"
        ),
    );
    let voltage = &found.limits[0];
    let noise = voltage.noise.unwrap();
    eprintln!(
        "{} of 16 above {median_v} V, largest {} V",
        noise.exceeded, voltage.value
    );
    // 99 % of a binomial distribution.
    assert!(noise.realisations == 16 && (3..=13).contains(&noise.exceeded));
    let share = noise.exceeded as f64 / 16.0;
    assert!((noise.exceeded_fraction_low..noise.exceeded_fraction_high).contains(&share));
    // The largest of 17 runs: the share of runs below it is at least 0.005^(1/17).
    let low_v = peaks_v[(0.73 * SIMULATED as f64) as usize];
    let high_v = 1.1 * peaks_v[SIMULATED - 1];
    assert!(
        (low_v..high_v).contains(&voltage.value),
        "{low_v} {high_v} {voltage:?}"
    );
    assert!(!found.feasible && voltage.violation > 0.0, "{found:?}");
}

const SIMULATED: usize = 600;
const WINDOW_S: f64 = 6.0;

fn noisy() -> String {
    LINEAR
        .replace(
            "amplitude = \"0.7 N\"",
            "signal = \"noise\"\npsd = \"0.1 N^2/Hz\"\nlow = \"5 Hz\"",
        )
        .replace("frequency = \"9.7 Hz\"", "high = \"20 Hz\"")
        .replace("duration = \"1 s\"", "duration = \"10 s\"")
        .replace(
            "average_over = \"1 s\"",
            &format!("average_over = \"{WINDOW_S} s\""),
        )
}

/// Returns the largest voltages of simulated runs, in order.
fn simulated_peaks_v() -> Vec<f64> {
    const STEP_HZ: f64 = 1.0 / 24.0;
    const SAMPLES: u32 = 1440;
    let harvester = harvester(80e3);
    let lines_hz: Vec<f64> = (0..360)
        .map(|k| 5.0 + (f64::from(k) + 0.5) * STEP_HZ)
        .collect();
    let gains: Vec<c64> = lines_hz
        .iter()
        .map(|hz| harvester.voltage_per_newton(*hz))
        .collect();
    let peak_v = |run: usize| {
        let mut stream = RandomStream::new(7, run as u64);
        let mut lines: Vec<[c64; 2]> = Vec::with_capacity(lines_hz.len());
        for (hz, gain) in lines_hz.iter().zip(&gains) {
            let [re, im] = stream.normal_pair();
            let turn = c64::cis(TAU * hz * WINDOW_S / f64::from(SAMPLES));
            lines.push([*gain * c64::new(re, im) * (0.1 * STEP_HZ).sqrt(), turn]);
        }
        let mut largest_v = 0.0_f64;
        for _ in 0..SAMPLES {
            let sum_v: f64 = lines.iter().map(|[value, _]| value.re).sum();
            largest_v = largest_v.max(sum_v.abs());
            lines.iter_mut().for_each(|[value, turn]| *value *= *turn);
        }
        largest_v
    };
    let mut peaks_v: Vec<f64> = (0..SIMULATED).into_par_iter().map(peak_v).collect();
    peaks_v.sort_by(f64::total_cmp);
    peaks_v
}

/// A foot that walks from 50 s to 180 s after 6 s of zeros.
#[test]
fn a_gait_has_a_design_within_the_strain_of_its_patch() {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/human_gait/foot_data.mat");
    if !path.exists() {
        let _ = writeln!(
            std::io::stderr(),
            "SKIPPED: the recording human_gait/foot_data.mat is missing"
        );
        return;
    }
    let spec = format!(
        "{CANTILEVER}[drive.foot]\nkind = \"base-acceleration\"\nsignal = \"recording\"\nfile = {path:?}\n\
         channel = \"foot_data(5)\"\nscale = 9.80665\n[run]\nduration = \"70 s\"\naverage_over = \"15 s\"\n"
    );
    let found = outcome_of(
        &spec,
        "evaluations = 80\n[free]\n\"mass.tip.mass\" = \"2g:60g\"\n\"stop.above.gap\" = \"2mm:40mm\"\n\
         \"circuit.load.resistance\" = \"30kohm:10Mohm:log\"\n\
         [goal]\nmaximise = \"mean-power\"\n[limits]\n\"patch.p.strain\" = \"2000 ppm\"\n\"stop.above.contact_force\" = \"50 N\"\n",
    );
    let [strain, force] = &found.limits[..] else {
        panic!("{found:?}")
    };
    assert!(
        found.feasible && strain.value > 0.0 && force.value <= 50.0,
        "{found:?}"
    );
    assert!(
        found.best.mean_power_w > found.before.goals["mean-power"],
        "{found:?}"
    );
}

/// The key of the journal depends on the recording of a condition and on the start state by their
/// content, which may change under their names.
#[test]
fn the_digest_depends_on_the_files_that_the_spec_names() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let spec = format!("{LINEAR}start = \"state.json\"\n");
    let text = format!(
        "[free]\n\"circuit.load.resistance\" = \"10kohm:1Mohm:log\"\n\
         [goal]\nmaximise = \"mean-power\"\n[limits]\n\"patch.m.p.voltage\" = \"1 kV\"\n\
         [[conditions]]\nset = {{ \"drive.d\" = {{ at = \"m.tip\", kind = \"force\", signal = \"recording\", file = '{}' }} }}\n",
        at("force.csv").display()
    );
    let digest = || {
        let file = SpecFile::from_text(&spec);
        let problem = Problem::with_spec(file, folder.path(), &text, folder.path()).unwrap();
        problem.hash_hex().to_owned()
    };
    let write_force = |last: &str| {
        let content = format!("time [s],force [N]\n0,0\n0.5,1\n1,{last}\n");
        std::fs::write(at("force.csv"), content).unwrap();
    };
    write_force("2");
    std::fs::write(at("state.json"), "{}").unwrap();
    let before = digest();
    assert_eq!(digest(), before);
    std::fs::write(at("state.json"), "{ }").unwrap();
    let with_state = digest();
    write_force("3");
    assert!(before != with_state && with_state != digest());
}

//! Designs under band-limited noise and under a recorded gait.

use super::{LINEAR, harvester, outcome_of};
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
    let (number, unit) = text.split_once(' ').unwrap();
    let factor = match unit {
        "ohm" => 1.0,
        "kohm" => 1e3,
        other => panic!("{other}"),
    };
    factor * number.parse::<f64>().unwrap()
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

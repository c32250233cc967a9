//! Limits of sizes, of the nearest fold and of runs; a band as conditions.

use super::{LINEAR, linear_at, outcome, outcome_of, problem};
use jounce_spec::Quantity;

const CANTILEVER: &str = "[beam.b]\nyoungs_modulus = \"200 GPa\"\ndensity = \"7800 kg/m^3\"\nlength = \"100 mm\"\nwidth = \"20 mm\"\nthickness = \"1 mm\"\n\
    [patch.p]\non = \"b\"\nmaterial = \"MFC-P2\"\nstart = \"0 mm\"\nlength = \"20 mm\"\nwidth = \"20 mm\"\nthickness = \"0.3 mm\"\n\
    [circuit.load]\npatch = \"p\"\nresistance = \"100 kohm\"\n\
    [drive.d]\nat = \"b.end\"\namplitude = \"0.1 N\"\nfrequency = \"20 Hz\"\n[damping]\nbeyond = 0.01\n\
    [reduction]\nmodes = 3\n[run]\nduration = \"1 s\"\naverage_over = \"1 s\"\n";

/// Below its resonance the beam gives more power with a heavier tip and a longer patch, so a limit of
/// the mass binds: what the patch takes, the tip lacks.
#[test]
fn a_limit_of_mass_binds_and_has_its_price() {
    let spec = format!("{CANTILEVER}[mass.tip]\non = \"b.end\"\nmass = \"1 g\"\n");
    let design = |limit_g: f64| {
        outcome_of(
            &spec,
            &format!(
                "[free]\n\"mass.tip.mass\" = \"1g:20g\"\n\"patch.p.length\" = \"5mm:60mm\"\n\
                 [goal]\nmaximise = \"expected-power\"\nstarts = 2\n[limits]\nmass = \"{limit_g} g\"\n"
            ),
        )
    };
    let [lighter, best, heavier] = [25.9, 26.0, 26.1].map(design);
    let [mass] = &best.limits[..] else {
        panic!("{best:?}")
    };
    assert!(best.feasible && mass.active, "{best:?}");
    let slope = (heavier.best.mean_power_w - lighter.best.mean_power_w) / 0.2e-3;
    let price = mass.price.unwrap();
    assert!((price / slope - 1.0).abs() < 0.02, "{price} {slope}");
}

/// A load has no mass: the limit of the mass has no price, met or not.
#[test]
fn a_limit_that_no_key_affects_has_no_price() {
    let design = |limit_g: f64| {
        outcome_of(
            CANTILEVER,
            &format!(
                "[free]\n\"circuit.load.resistance\" = \"10kohm:1Mohm:log\"\n\
                 [goal]\nmaximise = \"expected-power\"\nstarts = 2\n[limits]\nmass = \"{limit_g} g\"\n"
            ),
        )
    };
    let heavy = design(10.0);
    assert!(!heavy.feasible && heavy.limits[0].price.is_none());
    assert_eq!(heavy.limits[0].state(), "not met");
    let light = design(1001.0 * heavy.limits[0].value);
    assert!(light.limits[0].active && light.limits[0].price.is_none());
}

/// The branch of a linear harvester has no fold within 30 % of the frequency of its drive, 9.7 Hz.
#[test]
fn a_distance_to_the_nearest_fold_is_at_most_that_of_the_searched_range() {
    let text = |limit: &str| {
        format!(
            "evaluations = 40\n[free]\n\"circuit.load.resistance\" = \"50kohm:100kohm\"\n\
             [goal]\nmaximise = \"stable-power\"\nstarts = 2\n[limits]\nfold_distance = \"{limit}\"\n"
        )
    };
    let kept = outcome(&text("2.9 Hz"));
    assert!(kept.feasible && (kept.limits[0].value - 0.3 * 9.7).abs() < 1e-12);
    let broken = outcome(&text("3 Hz"));
    assert!(!broken.feasible && broken.violation < 0.04, "{broken:?}");
}

/// The orbit of the 2019 harvester at 13 Hz loses its stability at 12.802 Hz, where runs stop settling;
/// its nearest fold lies at 12.590 Hz.
#[test]
fn a_bifurcation_nearer_than_the_fold_is_a_warning() {
    let spec = include_str!("../../../../examples/impact-harvester-2019/harvester.toml");
    let found = outcome_of(
        spec,
        "evaluations = 1\n[free]\n\"circuit.load.resistance\" = \"900kohm:1Mohm\"\n\
         [goal]\nmaximise = \"stable-power\"\nstarts = 2\n",
    );
    let fold = found.best.nearest_fold.as_ref().unwrap();
    assert!((fold.frequency_hz - 12.590).abs() < 1e-3, "{fold:?}");
    let [warning] = &found.warnings[..] else {
        panic!("{:?}", found.warnings)
    };
    assert!(
        warning.contains("neimark-sacker at 12.802") && warning.contains("197.7 mHz away"),
        "{warning}"
    );
}

/// Under noise the voltage of the averaging window has a limit too.
#[test]
fn a_run_under_noise_keeps_a_limit_of_the_voltage() {
    let spec = LINEAR
        .replace(
            "amplitude = \"0.7 N\"",
            "signal = \"noise\"\npsd = \"0.1 N^2/Hz\"\nlow = \"5 Hz\"",
        )
        .replace("frequency = \"9.7 Hz\"", "high = \"20 Hz\"")
        .replace("duration = \"1 s\"", "duration = \"8 s\"")
        .replace("average_over = \"1 s\"", "average_over = \"6 s\"");
    let design = |limits: &str| {
        outcome_of(
            &spec,
            &format!(
                "evaluations = 80\n[free]\n\"circuit.load.resistance\" = \"10kohm:1Mohm:log\"\n\
                 [goal]\nmaximise = \"mean-power\"\n{limits}"
            ),
        )
    };
    let free = design("[limits]\n\"patch.m.p.voltage\" = \"1 kV\"\n");
    let reached = free.limits[0].value;
    assert!(free.feasible && reached > 1.0, "{free:?}");
    let limit = 0.7 * reached;
    let kept = design(&format!(
        "[limits]\n\"patch.m.p.voltage\" = \"{limit} V\"\n"
    ));
    assert!(
        kept.feasible && kept.limits[0].value > 0.95 * limit,
        "{kept:?}"
    );
    assert!(kept.best.mean_power_w < free.best.mean_power_w);
}

/// A band is the mean over its frequencies.
#[test]
fn a_band_is_a_condition_for_each_of_its_frequencies() {
    let found = outcome(
        "evaluations = 150\n[free]\n\"circuit.load.resistance\" = \"80kohm:81kohm\"\n\
         [goal]\nmaximise = \"stable-power\"\nstarts = 2\n\
         [[conditions]]\nset = { \"drive.d.frequency\" = \"9Hz:11Hz:3x\" }\n",
    );
    let given = found.before.goals["stable-power"];
    let expected: f64 = [9.0, 10.0, 11.0]
        .map(|hz| linear_at(80e3, hz).1 / 3.0)
        .iter()
        .sum();
    assert!((given / expected - 1.0).abs() < 1e-6, "{given} {expected}");
}

#[test]
fn an_unknown_limit_is_refused_with_those_that_exist() {
    let error = problem(
        "[free]\n\"circuit.load.resistance\" = \"1kohm:2kohm\"\n[goal]\nmaximise = \"expected-power\"\n[limits]\nweight = \"3 g\"\n",
    )
    .unwrap_err()
    .to_string();
    // Without beams there is no size.
    assert!(
        error.contains("fold_distance = \"0.2 Hz\"") && !error.contains("mass ="),
        "{error}"
    );
}

/// Two frequencies on both sides of the resonance: a limit holds in each of them, where a mean of them
/// would hide the smaller power and the smaller voltage.
#[test]
fn limits_hold_in_each_condition() {
    let text = |limits: &str| {
        format!(
            "evaluations = 60\n[free]\n\"circuit.load.resistance\" = \"20kohm:500kohm:log\"\n\
             [goal]\nmaximise = \"expected-power\"\nstarts = 2\n[limits]\n{limits}\n\
             [[conditions]]\nset = {{ \"drive.d.frequency\" = \"9 Hz\" }}\n\
             [[conditions]]\nset = {{ \"drive.d.frequency\" = \"10 Hz\" }}\n"
        )
    };
    let found = outcome(&text(
        "mean_power = \"1 uW\"\n\"patch.m.p.voltage\" = \"1 kV\"",
    ));
    let load = &found.best.set["circuit.load.resistance"];
    let load_ohm = Quantity::Resistance.read(load).unwrap();
    let [low, high] = [9.0, 10.0].map(|hz| linear_at(load_ohm, hz));
    let [power, voltage] = [0, 1].map(|index| found.limits[index].value);
    assert!((power / low.1.min(high.1) - 1.0).abs() < 1e-6, "{found:?}");
    assert!(
        (voltage / low.0.max(high.0) - 1.0).abs() < 1e-6,
        "{found:?}"
    );
    // Between the smaller power and the mean: the mean would keep it.
    let between_w = 2.0 * power;
    assert!(between_w < 0.5 * (low.1 + high.1), "{low:?} {high:?}");
    let broken = outcome(&text(&format!("mean_power = \"{between_w} W\"")));
    assert!(!broken.feasible, "{broken:?}");
}

//! Quantiles and Sobol indices under the tolerances.

use super::{LOAD, linear, outcome};
use jounce_analysis::{Basins, Cloud, InitialStates, Model, Recognition};
use jounce_control::Control;
use jounce_design::{Problem, Robustness, design};
use jounce_signal::RandomStream;
use jounce_spec::{NumericKey, Quantity, SpecFile};
use rayon::prelude::*;
use std::io::Write;
use std::path::Path;

/// Scatter of the force alone: its square is all of the variance, and the quantiles follow.
#[test]
fn tolerances_give_quantiles_and_indices() {
    let found = outcome(&format!(
        "draws = 256\n{LOAD}[tolerance]\n\"drive.d.amplitude\" = \"0.07 N\"\n\"modal.m.damping_ratio.1\" = \"1e-9\"\n"
    ));
    let robust = found.robust.unwrap();
    let power = |force: f64| found.best.mean_power_w * (force / 0.7).powi(2);
    for one in &robust.quantiles {
        let expected = power(0.63 + 0.14 * one.share);
        assert!(
            (one.mean_power_w / expected - 1.0).abs() < 3e-3,
            "{one:?} {expected}"
        );
    }
    let [force, damping] = &robust.sobol[..] else {
        panic!("{robust:?}")
    };
    assert!(
        force.first > 0.9 && force.total > 0.95 && damping.total < 1e-3,
        "{robust:?}"
    );
    assert_eq!(robust.lost_fraction, 0.0);
}

/// Compares quantiles with those of drawn powers. The quantiles of a skew distribution with 10,000
/// draws scatter by some per mille of its width.
fn check_quantiles(robust: Robustness, mut powers: Vec<f64>) {
    powers.sort_by(f64::total_cmp);
    let at = |share: f64| powers[(share * (powers.len() - 1) as f64) as usize];
    let width = at(0.99) - at(0.01);
    for one in robust.quantiles {
        let deviation = (one.mean_power_w - at(one.share)).abs() / width;
        assert!(deviation < 0.02, "{one:?} {deviation}");
    }
}

/// Quantiles of the power from the closed form at 10,000 drawn resistances, and of the same
/// tolerance by the design.
#[test]
fn quantiles_are_those_of_designs_computed_one_by_one() {
    let found = outcome(&format!(
        "draws = 1024\n{LOAD}[tolerance]\n\"circuit.load.resistance\" = \"20 kohm normal\"\n"
    ));
    let text = &found.best.set["circuit.load.resistance"];
    let nominal = Quantity::Resistance.read(text).unwrap();
    let mut stream = RandomStream::new(7, 0);
    let powers: Vec<f64> = (0..10_000)
        .map(|_| linear((nominal + 20e3 * stream.normal_pair()[0]).max(1.0)).1)
        .collect();
    check_quantiles(found.robust.unwrap(), powers);
}

/// The first index of a tolerance is the variance of the mean over all others. Computed from a grid
/// of both by the closed form.
#[test]
fn sobol_indices_are_those_of_a_grid() {
    let found = outcome(&format!(
        "draws = 2048\n{LOAD}[tolerance]\n\"circuit.load.resistance\" = \"60 kohm\"\n\"drive.d.amplitude\" = \"0.05 N\"\n"
    ));
    let text = &found.best.set["circuit.load.resistance"];
    let nominal = Quantity::Resistance.read(text).unwrap();
    let cells = 400;
    let place = |k: usize| 2.0 * (k as f64 + 0.5) / f64::from(cells) - 1.0;
    let cells = cells as usize;
    let of_load: Vec<f64> = (0..cells)
        .map(|k| linear(nominal + 60e3 * place(k)).1)
        .collect();
    let of_force: Vec<f64> = (0..cells)
        .map(|k| (1.0 + 0.05 / 0.7 * place(k)).powi(2))
        .collect();
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let square = |values: &[f64]| mean(&values.iter().map(|x| x * x).collect::<Vec<f64>>());
    let (load, force) = (mean(&of_load), mean(&of_force));
    let (load_2, force_2) = (square(&of_load), square(&of_force));
    // The power is the product of both.
    let variance = load_2 * force_2 - (load * force).powi(2);
    let first = [
        (load_2 - load * load) * force * force / variance,
        (force_2 - force * force) * load * load / variance,
    ];
    let sobol = found.robust.unwrap().sobol;
    for (index, one) in sobol.iter().enumerate() {
        let (alone, total) = (first[index], 1.0 - first[1 - index]);
        assert!(
            one.first_low < alone && alone < one.first_high,
            "{one:?} {alone}"
        );
        assert!(
            one.total_low < total && total < one.total_high,
            "{one:?} {total}"
        );
    }
}

/// Quantiles of the paper's harvester with another stop against `JOUNCE_DRAWN_DESIGNS` drawn
/// designs, such as 10,000, each from its own starts.
#[test]
fn quantiles_of_the_impact_harvester_are_those_of_drawn_designs() {
    let Some(count) = std::env::var("JOUNCE_DRAWN_DESIGNS").ok() else {
        let _ = writeln!(
            std::io::stderr(),
            "SKIPPED: JOUNCE_DRAWN_DESIGNS gives the number of designs"
        );
        return;
    };
    let count: u64 = count.parse().unwrap();
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples/impact-harvester-2019/harvester.toml");
    let mut file = SpecFile::read(&path).unwrap();
    for (key, value) in [
        ("drive.shaker.frequency", "11 Hz"),
        ("drive.shaker.amplitude", "50 N"),
        ("stop.tip.gap", "2.7 mm"),
        ("stop.tip.stiffness", "662 N/m^1.5"),
    ] {
        file.set(key, value).unwrap();
    }
    let text = "evaluations = 40\ndraws = 4096\n[free]\n\"circuit.load.resistance\" = \"80kohm:81kohm\"\n\
        [goal]\nmaximise = \"expected-power\"\nstarts = 20\n\
        [tolerance]\n\"stop.tip.gap\" = \"0.05 mm\"\n\"stop.tip.stiffness\" = \"30 N/m^1.5\"\n";
    let problem = Problem::with_spec(file.clone(), Path::new(""), text, Path::new("")).unwrap();
    let found = design(&problem, &Control::default(), None, None).unwrap();
    let (key, value) = found.best.set.first_key_value().unwrap();
    file.set(key, value).unwrap();
    let model = Model::new(file.spec().unwrap()).unwrap();
    let keys = ["stop.tip.gap", "stop.tip.stiffness"].map(|path| file.numeric_key(path).unwrap());
    let power = |index: u64| {
        let mut stream = RandomStream::new(11, index);
        let gap_m = 2.7e-3 + 0.05e-3 * stream.symmetric();
        let stiffness = 662.0 + 30.0 * stream.symmetric();
        let mut spec = model.spec.clone();
        NumericKey::set_all(&mut spec, &[(&keys[0], gap_m), (&keys[1], stiffness)]).unwrap();
        let study = Basins {
            base: &model.changed(spec).unwrap(),
            starts: InitialStates::Cloud(Cloud {
                starts: 4,
                seed: 1,
                spread: 10.0,
            }),
            recognition: Recognition::at(1e-7),
        };
        let attractors = study.run().unwrap().attractors;
        let main = attractors
            .iter()
            .max_by(|a, b| a.share.fraction.total_cmp(&b.share.fraction));
        main.unwrap().mean_power_w
    };
    let powers: Vec<f64> = (0..count).into_par_iter().map(power).collect();
    check_quantiles(found.robust.unwrap(), powers);
}

/// A force of 0.7 N at twice the weight of one of 1.4 N: the power of each drawn load is that at 0.7 N
/// times (2 + 4) / 3, not that in the first condition.
#[test]
fn quantiles_are_those_of_the_mean_over_the_conditions() {
    let found = outcome(
        "evaluations = 3\ndraws = 1024\n[free]\n\"circuit.load.resistance\" = \"50kohm:50.001kohm\"\n\
         [goal]\nmaximise = \"expected-power\"\nstarts = 2\n\
         [tolerance]\n\"circuit.load.resistance\" = \"5 kohm\"\n\
         [[conditions]]\nset = { \"drive.d.amplitude\" = \"0.7 N\" }\nweight = 2\n\
         [[conditions]]\nset = { \"drive.d.amplitude\" = \"1.4 N\" }\n",
    );
    let draws = (0..1000).map(|k| linear(45e3 + 10e3 * (f64::from(k) + 0.5) / 1000.0).1);
    check_quantiles(
        found.robust.unwrap(),
        draws.map(|power| 2.0 * power).collect(),
    );
}

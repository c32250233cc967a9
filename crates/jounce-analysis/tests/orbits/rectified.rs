//! Orbits of rectified circuits: against closed forms and runs in steady state, and their stability
//! against the decay of a run.

use crate::rows::folder;
use jounce_analysis::{AnalysisError, BranchSearch, Model, OrbitMethodKind, Parameter};
use jounce_continuation::{Corrector, Metric, Position, correct_at};
use jounce_dynamics::Integrator;
use jounce_orbits::{Orbit, OrbitError, OrbitMethod, ParametricModel, Shooting};
use jounce_spec::SpecFile;
use std::f64::consts::TAU;

/// The example without the lines of the given keys.
fn example_without(keys: &[&str]) -> SpecFile {
    let text =
        std::fs::read_to_string(folder("rectified-shu-lien-2006").join("harvester.toml")).unwrap();
    let stays = |line: &&str| {
        !keys
            .iter()
            .any(|key| line.split_whitespace().next() == Some(key))
    };
    SpecFile::from_text(
        text.lines()
            .filter(stays)
            .map(|line| format!("{line}\n"))
            .collect::<String>(),
    )
}

/// The example with changed keys and default diodes: not every interface has them.
fn file(settings: &[(&str, &str)]) -> SpecFile {
    let mut file = example_without(&["diode_resistance"]);
    settings
        .iter()
        .for_each(|(key, value)| file.set(key, value).unwrap());
    file
}

/// Orbit of one drive cycle that Newton finds from the linear response and a voltage of the
/// storage.
pub fn orbit(file: &SpecFile, storage_v: f64) -> (Model, Orbit) {
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.amplitude").unwrap();
    let orbit = {
        let parameter = Parameter::new(&base, &key, 1.0);
        let kernel = parameter.at(1.0).unwrap().kernel;
        let shooting = Shooting::new(&parameter, &kernel, 1, 1e-10);
        let mut guess = kernel
            .plant
            .to_physical(&vec![0.0; kernel.plant.len()], 0.0);
        if let Some(node) = kernel.plant.electrical.bridges[0].storage {
            guess[2 * kernel.plant.system.modes.len() + node] = storage_v;
        }
        let position = Position {
            unknown: shooting.unknown(&guess),
            parameter: 1.0,
        };
        let solution = correct_at(
            &shooting,
            &Corrector {
                goal: 1e-9,
                most: 30,
            },
            &Metric::at(&position, 1.0),
            position,
        )
        .unwrap();
        shooting.orbit(&solution.local, solution.error).unwrap()
    };
    (base, orbit)
}

/// Power of the strongly coupled cell by direct integration at a fixed voltage of 1 V, 2.37962. A
/// battery gives it to 2.1e-5, as in a run; 2000 F of smoothing ripple, which makes 1.8e-4. Newton
/// finds the orbit in a few steps; a run needs thousands of cycles to charge the storage.
#[test]
fn the_orbit_has_the_power_of_direct_integration() {
    for (settings, allowed) in [
        (&[][..], 3e-4),
        (&[("circuit.rectifier.battery", "1 V")][..], 6e-5),
    ] {
        let mut file =
            example_without(&["storage", "resistance", "diode_resistance"][..2 * settings.len()]);
        file.set("circuit.rectifier.diode_resistance", "1 uohm")
            .unwrap();
        settings
            .iter()
            .for_each(|(key, value)| file.set(key, value).unwrap());
        let (_, orbit) = orbit(&file, 1.0);
        let error = orbit.mean_power_w / 2.37962 - 1.0;
        eprintln!(
            "{settings:?}: {error:.1e}, multiplier {:.6}, error estimate {:.1e}",
            orbit.floquet_max_abs(),
            orbit.error_estimate
        );
        assert!(error.abs() < allowed && orbit.is_stable() && orbit.error_estimate < 1e-6);
    }
}

/// Coefficients of `prod (x - m)`, that of the constant first.
fn polynomial(multipliers: &[jounce_linalg::c64]) -> Vec<jounce_linalg::c64> {
    let mut polynomial = vec![jounce_linalg::c64::new(1.0, 0.0)];
    for value in multipliers {
        let higher =
            std::iter::once(jounce_linalg::c64::new(0.0, 0.0)).chain(polynomial.iter().copied());
        let lower = polynomial
            .iter()
            .map(|c| -*c * *value)
            .chain([jounce_linalg::c64::new(0.0, 0.0)]);
        polynomial = higher.zip(lower).map(|(a, b)| a + b).collect();
    }
    polynomial
}

/// A perturbation obeys the polynomial of the multipliers from cycle to cycle: `sum_k c_k d_k = 0`,
/// `prod (x - m) = sum_k c_k x^k`.
#[test]
fn a_disturbance_decays_by_the_multipliers() {
    for (interface, quality) in [
        ("bridge", None),
        ("parallel-sshi", Some("5")),
        ("series-sshi", Some("5")),
        ("sece", None),
    ] {
        let mut settings = vec![
            ("circuit.rectifier.interface", interface),
            ("circuit.rectifier.storage", "20 F"),
        ];
        settings.extend(quality.map(|quality| ("circuit.rectifier.quality_factor", quality)));
        let (base, orbit) = orbit(&file(&settings), 1.0);
        let kernel = &base.kernel;
        let scale: Vec<f64> = [1.0, 1.0]
            .into_iter()
            .chain(kernel.plant.electrical.energy_scale())
            .collect();
        let mut on: Vec<f64> = orbit
            .start()
            .iter()
            .zip(&scale)
            .map(|(u, w)| u / w)
            .collect();
        let polynomial = polynomial(&orbit.multipliers);
        let cycle_s = TAU / kernel.plant.tones[0].angular_frequency_rad_s;
        let mut perturbed_state: Vec<f64> = on
            .iter()
            .enumerate()
            .map(|(i, x)| x + [2e-7, -1e-7, 3e-7, 1e-7][i])
            .collect();
        let (mut sum, mut largest) = (vec![0.0; 4], 0.0_f64);
        for c in &polynomial {
            for i in 0..4 {
                let term = c.re * scale[i] * (perturbed_state[i] - on[i]);
                sum[i] += term;
                largest = largest.max(term.abs());
            }
            for state in [&mut on, &mut perturbed_state] {
                let mut integrator =
                    Integrator::new(kernel, &kernel.plant.from_physical(state, 0.0), 0.0, 1e-12)
                        .unwrap();
                integrator.advance_to(cycle_s).unwrap();
                *state = kernel.plant.to_physical(&integrator.state(), 0.0);
            }
        }
        let error = sum.iter().fold(0.0_f64, |max, s| max.max(s.abs())) / largest;
        eprintln!(
            "{interface}: {:.6e} W, {error:.1e}, {:?}",
            orbit.mean_power_w, orbit.multipliers
        );
        assert!(error < 1e-4 && orbit.is_stable(), "{interface}: {error:e}");
    }
}

/// Power over the load along a branch, against runs long enough to reach steady state.
#[test]
fn a_branch_over_the_load_has_the_power_of_settled_runs() {
    let settings = [
        ("circuit.rectifier.storage", "20 F"),
        ("circuit.rectifier.diode_resistance", "1 mohm"),
    ];
    let file = file(&settings);
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("circuit.rectifier.resistance").unwrap();
    let range = (0.3, 1.2);
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range,
        method: OrbitMethodKind::Shooting,
        tolerance: 1e-9,
        seeds: 0,
        longest_period: 1,
    };
    let branches = search.run().unwrap();
    let [branch] = &branches[..] else {
        panic!("{} branches", branches.len())
    };
    assert!(branch.points.len() > 5 && branch.points.iter().all(|point| point.orbit.is_stable()));
    for point in [
        &branch.points[0],
        &branch.points[branch.points.len() / 2],
        &branch.points[branch.points.len() - 1],
    ] {
        let kernel = parameter.at(point.parameter).unwrap().kernel;
        let period_s = TAU / kernel.plant.tones[0].angular_frequency_rad_s;
        let plan = jounce_analysis::run::RunPlan {
            duration_s: 400.0 * period_s,
            average_over_s: 10.0 * period_s,
            tolerance: 1e-9,
            record_s: 0.0,
        };
        let result = jounce_analysis::run::simulate(
            &kernel,
            &jounce_analysis::run::StartState::rest(&kernel.plant),
            &plan,
        )
        .unwrap();
        let error = point.orbit.mean_power_w / result.mean_power_w - 1.0;
        eprintln!(
            "{:.4} ohm: {:.8} W, march {error:.1e}, error estimate {:.1e}",
            point.parameter, result.mean_power_w, point.orbit.error_estimate
        );
        assert!(error.abs() < 1e-6, "{} ohm: {error:e}", point.parameter);
    }
}

/// A battery above the open-circuit voltage receives no current, and the charge of the patch is
/// arbitrary: the orbit has the charge of the start.
#[test]
fn diodes_that_never_conduct_keep_the_charge() {
    let mut file = example_without(&["storage", "resistance"]);
    file.set("circuit.rectifier.battery", "50 V").unwrap();
    let (base, orbit) = orbit(&file, 0.0);
    let steady = base
        .kernel
        .plant
        .to_physical(&vec![0.0; base.kernel.plant.len()], 0.0);
    eprintln!("{:?} {steady:?} {:?}", orbit.start(), orbit.multipliers);
    assert!(orbit.is_stable() && orbit.mean_power_w == 0.0 && orbit.switches == 0);
    assert!(
        orbit
            .start()
            .iter()
            .zip(&steady)
            .all(|(a, b)| (a - b).abs() < 1e-8)
    );
}

#[test]
fn harmonic_balance_names_shooting() {
    let file = file(&[]);
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("circuit.rectifier.resistance").unwrap();
    let parameter = Parameter::new(&base, &key, 1.0);
    let method = OrbitMethodKind::HarmonicBalance { harmonics: 16 };
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range: (0.3, 1.3),
        method,
        tolerance: 1e-8,
        seeds: 0,
        longest_period: 1,
    };
    let refused: OrbitError<AnalysisError> = search.run().unwrap_err();
    assert!(
        matches!(&refused, OrbitError::Rectified { circuit } if circuit == "rectifier"),
        "{refused}"
    );
    assert!(refused.to_string().contains("use the method shooting"));
}

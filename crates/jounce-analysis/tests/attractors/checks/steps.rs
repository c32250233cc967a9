//! Brute force against a tenth of its error, and against the classical Runge-Kutta method without
//! events.

use crate::brute::{Flow, ReferenceModel, STEP_TOLERANCE};
use crate::random_specs::random_spec;
use jounce_analysis::{Cloud, Model};
use jounce_model::plant::Plant;
use jounce_spec::SpecFile;

const CLOUD: Cloud = Cloud {
    starts: 3,
    seed: 9,
    spread: 3.0,
};

fn plant(index: u64) -> Plant {
    Model::new(SpecFile::from_text(random_spec(22, index)).spec().unwrap())
        .unwrap()
        .kernel
        .plant
        .clone()
}

/// Calls a function with the model of a random harvester and its starts.
macro_rules! with_model {
    ($plant:expr, $function:ident) => {{
        let starts: Vec<Vec<f64>> = (0..CLOUD.starts)
            .map(|index| CLOUD.start(&$plant, index))
            .collect();
        match $plant.system.modes.len() {
            1 => $function(&ReferenceModel::<1, 4>::of(&$plant.system), &starts),
            2 => $function(&ReferenceModel::<2, 6>::of(&$plant.system), &starts),
            _ => $function(&ReferenceModel::<3, 8>::of(&$plant.system), &starts),
        }
    }};
}

fn distance<const N: usize, const D: usize>(
    model: &ReferenceModel<N, D>,
    a: &[f64; D],
    b: &[f64; D],
) -> f64 {
    model
        .weights
        .square(&std::array::from_fn(|i| a[i] - b[i]))
        .sqrt()
}

/// Largest difference over one cycle, for 30 cycles of every start, to the same cycle at a tenth of
/// the error per step. The difference is relative to the size of the motion, that of the energy to
/// its square, and both to the growth over the cycle of a perturbation of 1e-9 of that size.
fn refined<const N: usize, const D: usize>(
    model: &ReferenceModel<N, D>,
    starts: &[Vec<f64>],
) -> f64 {
    let [coarse, fine] = [STEP_TOLERANCE, 0.1 * STEP_TOLERANCE].map(|tolerance| Flow {
        model,
        tolerance,
        has_series: true,
    });
    between(coarse, fine, starts)
}

/// Same difference, between steps by series and those of Dormand and Prince.
fn methods<const N: usize, const D: usize>(
    model: &ReferenceModel<N, D>,
    starts: &[Vec<f64>],
) -> f64 {
    let [series, runge_kutta] = [true, false].map(|has_series| Flow {
        model,
        tolerance: STEP_TOLERANCE,
        has_series,
    });
    between(series, runge_kutta, starts)
}

fn between<const N: usize, const D: usize>(
    coarse: Flow<'_, N, D>,
    fine: Flow<'_, N, D>,
    starts: &[Vec<f64>],
) -> f64 {
    let model = coarse.model;
    let mut largest = 0.0_f64;
    for start in starts {
        let mut motion = coarse.start(model.state(start));
        for _ in 0..30 {
            let (mut finer, mut perturbed) = (motion.clone(), motion.clone());
            // Along the velocities, where an error of a contact force appears.
            (0..N).for_each(|i| perturbed.state[N + i] *= 1.0 + 1e-7);
            let initial_distance =
                distance(model, &motion.state, &perturbed.state).max(1e-12 * motion.size);
            coarse.cycle(&mut motion);
            fine.cycle(&mut finer);
            fine.cycle(&mut perturbed);
            let growth = distance(model, &finer.state, &perturbed.state) / initial_distance;
            assert!(!motion.is_lost && !finer.is_lost);
            let energy =
                (motion.state[D - 1] - finer.state[D - 1]).abs() / motion.size / motion.size;
            let difference = distance(model, &motion.state, &finer.state) / motion.size;
            largest = largest.max(difference.max(energy) / growth.max(1.0));
        }
    }
    largest
}

/// The end of a cycle equals that of a cycle with a start perturbed by at most 1e-9 of the size of
/// the motion.
#[test]
#[ignore = "long: runs with ./test --long"]
fn steps_of_a_tenth_of_the_error_change_a_cycle_by_less_than_1e_9() {
    let mut all: Vec<(f64, u64)> = (0..40)
        .map(|index| (with_model!(plant(index), refined), index))
        .collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    eprintln!("{:?}", &all[..8]);
    assert!(all[0].0 < 1e-9, "{:?}", &all[..8]);
}

/// Two methods without a common formula, from event to event.
#[test]
#[ignore = "long: runs with ./test --long"]
fn steps_by_series_equal_those_of_dormand_and_prince() {
    let mut all: Vec<(f64, u64)> = (0..60)
        .map(|index| (with_model!(plant(index), methods), index))
        .collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    eprintln!("{:?}", &all[..8]);
    assert!(all[0].0 < 1e-9, "{:?}", &all[..8]);
}

/// Largest differences after a cycle from 20,000 and 160,000 steps of the classical fourth-order
/// method.
fn plain<const N: usize, const D: usize>(
    model: &ReferenceModel<N, D>,
    starts: &[Vec<f64>],
) -> [f64; 2] {
    let flow = Flow {
        model,
        tolerance: STEP_TOLERANCE,
        has_series: true,
    };
    let mut largest = [0.0_f64; 2];
    for start in starts {
        let mut motion = flow.start(model.state(start));
        let begin = motion.state;
        flow.cycle(&mut motion);
        for (largest, steps) in largest.iter_mut().zip([20_000, 160_000]) {
            *largest = largest.max(
                distance(model, &motion.state, &plain_cycle(model, begin, steps)) / motion.size,
            );
        }
    }
    largest
}

fn plain_cycle<const N: usize, const D: usize>(
    model: &ReferenceModel<N, D>,
    mut y: [f64; D],
    steps: u32,
) -> [f64; D] {
    let h = model.cycle_s / f64::from(steps);
    let rate = |t: f64, y: &[f64; D]| model.rate(t, y, &model.phases(y), usize::MAX);
    let perturbed = |y: &[f64; D], h: f64, k: &[f64; D]| -> [f64; D] {
        std::array::from_fn(|i| y[i] + h * k[i])
    };
    for step in 0..steps {
        let t = f64::from(step) * h;
        let k1 = rate(t, &y);
        let k2 = rate(t + 0.5 * h, &perturbed(&y, 0.5 * h, &k1));
        let k3 = rate(t + 0.5 * h, &perturbed(&y, 0.5 * h, &k2));
        let k4 = rate(t + h, &perturbed(&y, h, &k3));
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
    }
    y
}

/// With steps shorter by a factor of eight, a method without events converges to this motion. Its
/// error falls with the square of the step where a force has a kink, and linearly where it jumps,
/// with a random position of the jump within the step. A missed contact or a wrong phase would
/// leave both distances equal.
#[test]
fn a_plain_method_without_events_converges_to_the_same_motion() {
    let compliant = (0..40).filter(|index| !random_spec(22, *index).contains("rigid"));
    let mut all: Vec<([f64; 2], u64)> = compliant
        .map(|index| (with_model!(plant(index), plain), index))
        .collect();
    all.sort_by(|a, b| b.0[1].total_cmp(&a.0[1]));
    eprintln!("{all:?}");
    let converges = |[coarse, fine]: [f64; 2]| fine < 1e-9 || fine < 0.6 * coarse;
    assert!(
        all.len() > 20 && all.iter().all(|(errors, _)| converges(*errors)),
        "{all:?}"
    );
}

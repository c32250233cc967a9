//! Free masses in a row that strike each other: momentum, energy, closed forms.

use crate::plants::{integrate, kernel, physical, springs};
use jounce_model::contact::{Hertz, Law, Rigid};
use jounce_model::plant::{Stop, System};

/// Masses on a line, each a free mode, with a contact between neighbours. Coordinates are
/// displacements from the positions with the given gaps between neighbours.
fn mass_row(masses_kg: &[f64], gaps_m: &[f64], law: Law) -> System {
    let contacts: Vec<_> = gaps_m
        .iter()
        .enumerate()
        .map(|(i, gap_m)| ([i, i + 1], *gap_m, law))
        .collect();
    linked_masses(masses_kg, &contacts)
}

/// Free masses with contacts between pairs of them.
fn linked_masses(masses_kg: &[f64], contacts: &[([usize; 2], f64, Law)]) -> System {
    let mut system = springs(&vec![0.0; masses_kg.len()], 0.0);
    for (i, ([from, to], gap_m, law)) in contacts.iter().enumerate() {
        let mut shape = vec![0.0; masses_kg.len()];
        (shape[*from], shape[*to]) = (1.0 / masses_kg[*from].sqrt(), -1.0 / masses_kg[*to].sqrt());
        system.stops.push(Stop {
            name: format!("contact {i}"),
            shape,
            gap_m: *gap_m,
            law: *law,
            bases: Vec::new(),
        });
    }
    system
}

/// Velocities after the first mass has come in at 1 m/s.
struct After {
    speeds_m_s: Vec<f64>,
    momentum_error: f64,
    energy_error: f64,
    contacts: Vec<u64>,
}

fn after_impact(masses_kg: &[f64], gaps_m: &[f64], law: Law, end_s: f64) -> After {
    struck_in(mass_row(masses_kg, gaps_m, law), masses_kg, end_s)
}

fn struck_in(system: System, masses_kg: &[f64], end_s: f64) -> After {
    let n = masses_kg.len();
    let kernel = kernel(system);
    let mut start = vec![0.0; 2 * n];
    start[n] = masses_kg[0].sqrt();
    let integrator = integrate(&kernel, &start, 0.0, end_s, 1e-12);
    let state = physical(&integrator, &kernel);
    let speeds_m_s: Vec<f64> = (0..n).map(|i| state[n + i] / masses_kg[i].sqrt()).collect();
    let momentum: f64 = speeds_m_s.iter().zip(masses_kg).map(|(v, m)| m * v).sum();
    let energy: f64 = speeds_m_s
        .iter()
        .zip(masses_kg)
        .map(|(v, m)| m * v * v)
        .sum();
    let after = After {
        momentum_error: momentum / masses_kg[0] - 1.0,
        energy_error: energy / masses_kg[0] - 1.0,
        contacts: integrator
            .statistics_by_stop()
            .iter()
            .map(|statistics| statistics.contacts)
            .collect(),
        speeds_m_s,
    };
    let residual = integrator.energies().residual_relative();
    eprintln!(
        "{:?}: momentum {:.1e}, energy {:.1e}, residual {residual:.1e}, contacts {:?}",
        after.speeds_m_s, after.momentum_error, after.energy_error, after.contacts
    );
    assert!(residual.abs() < 1e-12, "{residual:e}");
    after
}

const HERTZ: Law = Law::Hertz(Hertz {
    stiffness: 1e8,
    exponent: 1.5,
});

/// Two equal masses exchange their velocities; later the second passes its velocity to a third one
/// far away.
#[test]
fn equal_masses_hand_the_velocity_on() {
    let after = after_impact(&[0.3; 3], &[1e-3, 2e-3], HERTZ, 0.01);
    let error = (after.speeds_m_s[0].abs())
        .max(after.speeds_m_s[1].abs())
        .max((after.speeds_m_s[2] - 1.0).abs());
    assert!(error < 1e-9, "{error:e}");
    assert_eq!(after.contacts, [1, 1]);
}

/// Masses that touch are all in contact at once. The speeds have no closed form, but momentum and
/// energy are conserved.
#[test]
fn touching_masses_conserve_momentum_and_energy() {
    for masses_kg in [[0.3, 0.3, 0.3], [0.1, 0.5, 0.2], [0.7, 0.2, 0.1]] {
        for gaps_m in [[1e-3, 0.0], [1e-3, 1e-9], [0.0, 0.0]] {
            let after = after_impact(&masses_kg, &gaps_m, HERTZ, 0.02);
            assert!(
                after.momentum_error.abs() < 1e-9 && after.energy_error.abs() < 1e-9,
                "{masses_kg:?} {gaps_m:?}"
            );
            // The last of equal masses leaves with most of the speed; the first rebounds (Herrmann
            // and Schmalzle 1981).
            assert!(
                masses_kg[1] != 0.3 || (after.speeds_m_s[2] > 0.9 && after.speeds_m_s[0] < 0.0)
            );
        }
    }
}

/// One mass strikes two others at the same instant, with different contacts and any remaining time.
#[test]
fn one_mass_strikes_two_at_once() {
    let hertz = |stiffness: f64| {
        Law::Hertz(Hertz {
            stiffness,
            exponent: 1.5,
        })
    };
    let spring = Law::Hertz(Hertz {
        stiffness: 1e6,
        exponent: 1.0,
    });
    for masses_kg in [[5e-3, 2e-2, 1e-2], [5e-3, 1e-2, 1e-2], [5e-3, 1e-3, 1e-2]] {
        for gap_m in [0.0, 1e-3] {
            for laws in [
                [hertz(1e7), hertz(3e6)],
                [hertz(1e7), spring],
                [hertz(3e9), hertz(1e7)],
            ] {
                for end_s in [5e-3, 0.018, 0.02, 1.0] {
                    let contacts = [([0, 1], gap_m, laws[0]), ([0, 2], gap_m, laws[1])];
                    let after = struck_in(linked_masses(&masses_kg, &contacts), &masses_kg, end_s);
                    assert!(
                        after.momentum_error.abs() < 1e-9 && after.energy_error.abs() < 1e-9,
                        "{masses_kg:?} {gap_m} {laws:?} {end_s}"
                    );
                    assert!(
                        after.contacts.iter().all(|contacts| *contacts > 0)
                            && after.speeds_m_s[1] > after.speeds_m_s[0]
                    );
                }
            }
        }
    }
}

/// Three equal masses with linear springs: both springs act from the start until the first mass
/// leaves, in closed form.
#[test]
fn linear_springs_agree_with_their_closed_form() {
    let (m, k): (f64, f64) = (0.3, 1e6);
    let after = after_impact(
        &[m; 3],
        &[0.0, 0.0],
        Law::Hertz(Hertz {
            stiffness: k,
            exponent: 1.0,
        }),
        0.02,
    );
    // Compressions a and b of the two springs: a'' = -(2 a - b) k/m, b'' = -(2 b - a) k/m with
    // a'(0) = 1, b'(0) = 0, until a = 0.
    let (slow, fast) = ((k / m).sqrt(), (3.0 * k / m).sqrt());
    let a = |t: f64| 0.5 * ((slow * t).sin() / slow + (fast * t).sin() / fast);
    let (mut low, mut high) = (
        0.5 * std::f64::consts::PI / slow,
        1.5 * std::f64::consts::PI / slow,
    );
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if a(middle) > 0.0 {
            low = middle
        } else {
            high = middle
        }
    }
    let (s, f) = ((slow * low).cos(), (fast * low).cos());
    let (rate_a, rate_b) = (0.5 * (s + f), 0.5 * (s - f));
    // Speeds from the centre of mass at 1/3 m/s: v0 - v1 = a', v1 - v2 = b'.
    let first = (1.0 + 2.0 * rate_a + rate_b) / 3.0;
    // Then the last two separate by energy and momentum: only their compression b remains and their
    // relative velocity reverses.
    let b = 0.5 * ((slow * low).sin() / slow - (fast * low).sin() / fast);
    let parting = -(rate_b * rate_b + 2.0 * k / m * b * b).sqrt();
    let pair = 1.0 - first;
    let exact = [first, 0.5 * (pair + parting), 0.5 * (pair - parting)];
    let error = (0..3)
        .map(|i| (after.speeds_m_s[i] - exact[i]).abs())
        .fold(0.0, f64::max);
    eprintln!("exact {exact:?}: {error:.1e}");
    assert!(error < 1e-9, "{error:e}");
}

/// Successive rigid impacts: equal masses that touch pass the velocity on, whatever their number.
#[test]
fn rigid_masses_pass_the_velocity_through() {
    for gaps_m in [[1e-3, 2e-3, 1e-3], [1e-3, 0.0, 0.0]] {
        let after = after_impact(
            &[0.3; 4],
            &gaps_m,
            Law::Rigid(Rigid { restitution: 1.0 }),
            0.02,
        );
        let error = (0..3)
            .map(|i| after.speeds_m_s[i].abs())
            .fold((after.speeds_m_s[3] - 1.0).abs(), f64::max);
        assert!(error < 1e-12, "{error:e}");
    }
}

/// Newton's law between two masses in turn, with losses.
#[test]
fn rigid_masses_follow_newtons_law() {
    let (masses, e) = ([0.4, 0.1, 0.2], 0.6);
    let after = after_impact(
        &masses,
        &[1e-3, 0.0],
        Law::Rigid(Rigid { restitution: e }),
        2e-3,
    );
    let mut speeds = [1.0, 0.0, 0.0];
    // In the order of the stops, until all pairs separate.
    while let Some(i) = (0..2).find(|i| speeds[*i] - speeds[i + 1] > 1e-13) {
        let (m, n) = (masses[i], masses[i + 1]);
        let impulse = (1.0 + e) * (speeds[i] - speeds[i + 1]) * m * n / (m + n);
        (speeds[i], speeds[i + 1]) = (speeds[i] - impulse / m, speeds[i + 1] + impulse / n);
    }
    let error = (0..3)
        .map(|i| (after.speeds_m_s[i] - speeds[i]).abs())
        .fold(0.0, f64::max);
    eprintln!("expected {speeds:?}: {error:.1e}");
    assert!(
        error < 1e-12 && after.momentum_error.abs() < 1e-13,
        "{error:e}"
    );
}

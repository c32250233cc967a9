//! Both runs of one harvester, to understand a difference.

use super::independent::{Start, distance, energy_coordinates, run, run_at};
use super::library;
use super::system::{Drawn, drawn};
use jounce_dynamics::Trajectory;

/// Prints a harvester, its contacts and energies, and the convergence of both methods.
pub fn show(index: u64) {
    let harvester = drawn(index).unwrap();
    let Drawn {
        merged,
        cycles,
        tolerance,
        graze,
        ..
    } = &harvester;
    eprintln!("{merged:#?}\n{:?}", harvester.start);
    eprintln!("{cycles} cycles, tolerance {tolerance:e}, {graze:?}");
    let start = Start {
        physical: &harvester.start,
        drive: 1.0,
    };
    let own = run(merged, &start, *cycles);
    eprintln!("brute force: {:#?}\n{:?}", own.passages, own.energies);
    let theirs = library::run(&harvester).unwrap();
    let result = &theirs.result;
    eprintln!("library: {:#?}\n{:?}", theirs.contacts, result.energies);
    eprintln!("{:?}\n{:?}", result.stops, result.settlement);
    (0..merged.stops.len()).for_each(|stop| forces(&result.trajectory, stop));
    let last = own.strobe.last().unwrap();
    for error in [1e-16, 1e-15, 1e-13, 1e-12] {
        let other = run_at(merged, &start, *cycles, error);
        let distance = distance(last, other.strobe.last().unwrap()) / own.size;
        eprintln!("brute force with {error:e} a step: end {distance:.2e}");
    }
    for tolerance in [1e-6, 1e-8, 1e-10, 1e-12] {
        let other = Drawn {
            tolerance,
            ..drawn(index).unwrap()
        };
        let other = library::run(&other).unwrap();
        let end = energy_coordinates(merged, &other.end);
        let distance = distance(last, &end) / own.size;
        let work = other.result.work;
        eprintln!("library with tolerance {tolerance:e}: end {distance:.2e}, {work:?}");
    }
}

/// Prints when the force of a stop begins and ends in a record.
fn forces(trajectory: &Trajectory, stop: usize) {
    let mut acts = false;
    for segment in trajectory.segments() {
        let has_force = segment.forces.iter().any(|force| force.port == stop);
        if has_force != acts {
            let word = if acts { "ends" } else { "begins" };
            eprintln!("force of stop {stop} {word} at {:.15} s", segment.start_s);
        }
        acts = has_force;
    }
}

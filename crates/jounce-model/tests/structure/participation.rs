//! Participation of the modes in a uniform acceleration of the base.

use crate::paper::{attached_mass, bare_cantilever, paper, table};
use jounce_model::reference::Cantilever;
use jounce_model::structure::{modes, modes_holding};
use jounce_spec::Section;

const MASS_PER_LENGTH_KG_M: f64 = 2750.0 * 0.03 * 0.98e-3;

/// Closed form `2 s sqrt(m L) / l`; 0.7830 sqrt(m L) in mode 1. Measured: 7e-16 in mode 1, 4e-12
/// sqrt(m L) in the worst of 40.
#[test]
fn cantilever_has_its_closed_form() {
    let modal = modes(&bare_cantilever(40)).unwrap();
    let exact = Cantilever {
        bending_stiffness_n_m2: 1.0,
        mass_per_length_kg_m: MASS_PER_LENGTH_KG_M,
        length_m: 0.315,
    };
    let root_mass = (MASS_PER_LENGTH_KG_M * 0.315).sqrt();
    assert!((modal.participation_sqrt_kg[0] / root_mass - 0.7830).abs() < 5e-5);
    for (mode, value) in modal.participation_sqrt_kg.iter().enumerate() {
        let error = (value - exact.participation_sqrt_kg(mode)).abs() / root_mass;
        assert!(error < 5e-11, "mode {mode}: {error:e}");
    }
}

/// The squares sum to the moving mass; for a clamped beam each omitted mode contributes `4 / l^2`.
#[test]
fn squares_sum_to_the_moving_mass() {
    let exact = Cantilever {
        bending_stiffness_n_m2: 1.0,
        mass_per_length_kg_m: MASS_PER_LENGTH_KG_M,
        length_m: 0.315,
    };
    let modal = modes(&bare_cantilever(40)).unwrap();
    let computed: f64 = modal
        .participation_sqrt_kg
        .iter()
        .map(|value| value * value)
        .sum();
    let remaining: f64 = (40..200_000)
        .map(|mode| exact.participation_sqrt_kg(mode).powi(2))
        .sum();
    // The sum after mode 200000 is 4 / (pi^2 200000) of the mass.
    assert!(((computed + remaining) / (MASS_PER_LENGTH_KG_M * 0.315) - 1.0).abs() < 3e-6);
}

/// On its table the paper's harvester moves as a rigid body in mode 0, with the mass of table and
/// beam. A fixed table does not contribute.
#[test]
fn a_free_body_participates_only_in_its_rigid_motion() {
    let mut spec = paper(Section::Laminate);
    spec.mass
        .insert("table".into(), attached_mass("nothing", 12.0, 0.0));
    let total_kg: f64 = 12.0 + MASS_PER_LENGTH_KG_M * 0.315 + 5440.0 * 0.03 * 0.3e-3 * 0.085;
    let free = modes(&spec).unwrap().participation_sqrt_kg;
    assert!((free[0] / total_kg.sqrt() - 1.0).abs() < 1e-14);
    assert!(
        free[1..].iter().all(|value| value.abs() < 1e-10),
        "{free:?}"
    );
    let held_mass: f64 = modes_holding(&spec, &table())
        .unwrap()
        .participation_sqrt_kg
        .iter()
        .map(|value| value * value)
        .sum();
    assert!(
        held_mass < total_kg - 12.0 && held_mass > 0.9 * (total_kg - 12.0),
        "{held_mass}"
    );
}

//! Modes of beams and masses against closed forms, the impact-harvester paper (2019) and a second mesh.
#![allow(clippy::unwrap_used, reason = "tests")]

use jounce::spec::{Beam, Damping, Mass, Modal, Patch, Reduction, Section, Spec};
use jounce::structure::{Modes, StructureError, modes, modes_holding, modes_on_cubic_mesh, shapes_along_beams};
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

fn paper_beam(root: &str) -> Beam {
    Beam {
        length_m: 0.315,
        width_m: 0.03,
        thickness_m: 0.98e-3,
        youngs_modulus_pa: 65e9,
        density_kg_m3: 2750.0,
        root: root.into(),
        point: BTreeMap::from([("tip".into(), 0.305), ("hammer".into(), 0.015)]),
    }
}

fn paper_patch(section: Section) -> Patch {
    Patch {
        on: "beam".into(),
        start_m: 0.009,
        length_m: 0.085,
        width_m: 0.03,
        thickness_m: 0.3e-3,
        youngs_modulus_pa: 30.336e9,
        density_kg_m3: 5440.0,
        d31_m_per_v: -170e-12,
        capacitance_f: 177e-9,
        section,
    }
}

fn paper_table() -> Mass {
    Mass { mass_kg: 12.0, stiffness_n_m: 12.0 * TAU * TAU, damping_ratio: 0.3 }
}

/// `examples/impact-harvester-2019/harvester.toml`, as far as its structure goes.
fn paper(section: Section) -> Spec {
    Spec {
        beam: BTreeMap::from([("beam".into(), paper_beam("table"))]),
        patch: BTreeMap::from([("mfc".into(), paper_patch(section))]),
        mass: BTreeMap::from([("table".into(), paper_table())]),
        damping: Damping { ratios: vec![0.00194, 0.00925, 0.00864, 0.00359, 0.00126, 0.00274, 0.00160], beyond: None },
        ..Spec::default()
    }
}

fn bare_cantilever(kept: usize) -> Spec {
    Spec {
        beam: BTreeMap::from([("beam".into(), paper_beam("ground"))]),
        damping: Damping { ratios: Vec::new(), beyond: Some(0.01) },
        reduction: Reduction { modes: kept, mesh_tolerance: 1e-9 },
        ..Spec::default()
    }
}

fn table() -> [String; 1] {
    ["table".to_owned()]
}

fn frequency_hz(modes: &Modes) -> Vec<f64> {
    modes.frequency_rad_s.iter().map(|frequency| frequency / TAU).collect()
}

fn greatest_relative_difference(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    found.iter().zip(expected).map(|(one, other)| ((one - other) / other).abs()).fold(0.0, f64::max)
}

/// Table 2 of the paper, model column, as printed; further digits from a mesh of 2.5 mm cubic elements.
#[test]
fn table_2_to_every_printed_digit() {
    let found = frequency_hz(&modes_holding(&paper(Section::ThinSkin), &table()).unwrap());
    assert!((found[0] - 8.66).abs() <= 0.005, "{}", found[0]);
    for (found, printed) in found.iter().zip([8.66, 50.3, 140.9, 278.9, 457.6, 681.9, 960.5]).skip(1) {
        assert!((found - printed).abs() <= 0.05, "{found} {printed}");
    }
    for (found, printed) in found.iter().zip([8.663, 50.258, 140.910, 278.914, 457.638, 681.933, 960.515]) {
        assert!((found - printed).abs() <= 6e-4, "{found} {printed}");
    }
}

/// Full composite section with the patch's own mass: within 0.9 % of the measured column.
#[test]
fn laminate_with_patch_mass_predicts_the_measured_column() {
    let found = frequency_hz(&modes_holding(&paper(Section::Laminate), &table()).unwrap());
    assert!(greatest_relative_difference(&found, &[9.01, 49.71, 133.18, 262.58, 435.25, 648.28, 910.21]) < 5e-4, "{found:?}");
    assert!(greatest_relative_difference(&found, &[9.01, 49.7, 133.2, 262.8, 436.2, 651.3, 918.1]) < 0.009, "{found:?}");
}

/// Without the patch's mass: 9.02 Hz and the rest of the row "composite, about shifted NA" of a 2.5 mm mesh.
#[test]
fn laminate_without_patch_mass() {
    let mut spec = paper(Section::Laminate);
    spec.patch.get_mut("mfc").unwrap().density_kg_m3 = 0.0;
    let found = frequency_hz(&modes_holding(&spec, &table()).unwrap());
    for (found, expected) in found.iter().zip([9.02, 50.92, 142.54, 283.70, 465.05, 690.91, 975.43]) {
        assert!((found - expected).abs() < 0.01, "{found} {expected}");
    }
}

/// Roots of `cos(b) cosh(b) = -1`, by Newton's method on `cos(b) + 1/cosh(b)`.
fn cantilever_root(mode: usize) -> f64 {
    let mut root = if mode == 0 { 1.875 } else { (mode as f64 + 0.5) * PI };
    for _ in 0..50 {
        root += (root.cos() + 1.0 / root.cosh()) / (root.sin() + root.tanh() / root.cosh());
    }
    root
}

#[test]
fn uniform_cantilever_has_its_closed_form() {
    for (kept, allowed) in [(7, 1e-12), (40, 2e-11)] {
        let found = modes(&bare_cantilever(kept)).unwrap();
        let scale = (65e9 * 0.98e-3_f64.powi(2) / 12.0 / 2750.0).sqrt() / 0.315_f64.powi(2);
        let exact: Vec<f64> = (0..kept).map(|mode| cantilever_root(mode).powi(2) * scale).collect();
        let error = greatest_relative_difference(&found.frequency_rad_s, &exact);
        assert!(error < allowed, "{kept} modes: {error:e}");
        // Mass-normalised cantilever modes end at 2 / sqrt(mass).
        let end = 2.0 / (2750.0 * 0.03 * 0.98e-3 * 0.315_f64).sqrt();
        let error = found.shape["beam.end"].iter().map(|value| (value / end - 1.0).abs()).fold(0.0, f64::max);
        assert!(error < 1e-9, "{kept} modes, ends: {error:e}");
    }
}

/// Frequencies and shapes of the paper's harvester on its table: literature values from a 2.5 mm cubic mesh.
#[test]
fn table_coupled_modes_of_the_paper() {
    let found = modes(&paper(Section::ThinSkin)).unwrap();
    let frequencies = [0.9989318, 8.669057, 50.26820, 140.919, 278.9235, 457.648, 681.9407, 960.5178];
    assert!(greatest_relative_difference(&frequency_hz(&found), &frequencies) < 2e-6);
    let tip = [0.29414, 12.13914, 10.58325, 9.52673, 8.15715, 6.81263, 5.67309, 4.41866];
    let table = [0.288364, 0.010461, 0.005877, 0.003357, 0.002459, 0.001976, 0.001542, 0.001269];
    let slope = [0.0127, 25.5627, 56.5846, 49.5722, 333.002, 586.987, 531.998, 195.718];
    let absolute = |values: &[f64]| values.iter().map(|value| value.abs()).collect::<Vec<_>>();
    assert!(greatest_relative_difference(&absolute(&found.shape["beam.tip"]), &tip) < 2e-5);
    for (found, printed) in absolute(&found.shape["table"]).iter().zip(table) {
        assert!((found - printed).abs() < 1e-6, "{found} {printed}");
    }
    let couplings: Vec<f64> = slope.iter().map(|difference| difference * 8.6639e-5).collect();
    let found = absolute(&found.patch["mfc"].coupling_n_per_v);
    assert!((found[0] - couplings[0]).abs() < 5e-9);
    assert!(greatest_relative_difference(&found[1..], &couplings[1..]) < 1e-5, "{found:?}");
}

/// `shared/plant/paper-plant.toml` holds the same modes on a mesh of about 5 mm: products that no choice of sign changes.
#[test]
fn modes_agree_with_the_plant_given_as_numbers() {
    let found = modes(&paper(Section::ThinSkin)).unwrap();
    let frequencies = [0.99893740470155179, 8.6690552090301676, 50.268201825168148, 140.91935889423661];
    let table_times_tip = [0.28836423723126786 * 0.29413599852937317, -0.010460611757434613 * 12.139139756805843];
    let table_times_coupling = [0.28836423723126786 * -1.098177670673766e-06, 0.010460611757434613 * 0.0022147153917224734];
    assert!(greatest_relative_difference(&frequency_hz(&found)[..4], &frequencies) < 1e-5);
    let product = |other: &[f64]| found.shape["table"].iter().zip(other).take(2).map(|(a, b)| a * b).collect::<Vec<_>>();
    assert!(greatest_relative_difference(&product(&found.shape["beam.tip"]), &table_times_tip) < 1e-5);
    assert!(greatest_relative_difference(&product(&found.patch["mfc"].coupling_n_per_v), &table_times_coupling) < 2e-4);
}

/// Roundoff does not grow with the mesh: cubic elements approach the converged frequencies from above, as h^4, and never below.
#[test]
fn low_frequencies_hold_on_any_cubic_mesh() {
    let spec = paper(Section::ThinSkin);
    let converged = modes(&spec).unwrap().frequency_rad_s;
    for elements in [10, 100, 400] {
        let found = modes_on_cubic_mesh(&spec, &[], 0.315 / f64::from(elements)).unwrap();
        let above: Vec<f64> = found.frequency_rad_s.iter().zip(&converged).map(|(one, other)| one / other - 1.0).collect();
        assert!(above.iter().all(|above| *above > -2e-12), "{elements}: {above:?}");
        assert!(above[1] < 2e-5 * (10.0 / f64::from(elements)).powi(4) + 2e-12, "{elements}: {above:?}");
        assert!(above[0].abs() < 1e-12, "{elements}: {above:?}");
    }
}

/// Literature: mode 7 of the table-coupled model on elements of at most 20, 10, 5, 2.5 mm.
#[test]
fn cubic_meshes_converge_as_published() {
    for (longest_m, expected_hz) in [(20e-3, 961.79), (10e-3, 960.61), (5e-3, 960.524), (2.5e-3, 960.518)] {
        let found = frequency_hz(&modes_on_cubic_mesh(&paper(Section::ThinSkin), &[], longest_m).unwrap())[7];
        println!("{longest_m} {found} {expected_hz}");
        assert!((found / expected_hz - 1.0).abs() < 2e-5, "{longest_m}: {found}");
    }
}

/// The first mesh is fine enough: couplings and shapes do not move when the tolerance is tightened.
#[test]
fn shapes_and_couplings_are_converged() {
    let mut spec = paper(Section::ThinSkin);
    let found = modes(&spec).unwrap();
    spec.reduction.mesh_tolerance = 1e-12;
    let finer = modes(&spec).unwrap();
    for (name, values) in &finer.shape {
        let largest = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        for (one, other) in found.shape[name].iter().zip(values) {
            assert!((one - other).abs() < 1e-9 * largest, "{name}: {one} {other}");
        }
    }
    let couplings = |modes: &Modes| modes.patch["mfc"].coupling_n_per_v.clone();
    assert!(greatest_relative_difference(&couplings(&found), &couplings(&finer)) < 1e-8);
    assert!(found.discretisation_error.iter().all(|error| *error > 0.0 && *error <= 1e-9));
}

/// `sum shape^2 / w^2` is the static flexibility: `x^3 / (3 EI)` on a bare cantilever; the modes left out add only positive parts.
#[test]
fn modal_sum_approaches_the_static_deflection() {
    let flexibility = 0.305_f64.powi(3) / (3.0 * 65e9 * 0.03 * 0.98e-3_f64.powi(3) / 12.0);
    let missing = |kept| {
        let found = modes(&bare_cantilever(kept)).unwrap();
        let sum: f64 = found.shape["beam.tip"].iter().zip(&found.frequency_rad_s).map(|(phi, w)| (phi / w).powi(2)).sum();
        1.0 - sum / flexibility
    };
    let (few, many) = (missing(5), missing(60));
    assert!(few > 0.0 && few < 1e-3, "{few:e}");
    assert!(many > 0.0 && many < 2e-6, "{many:e}");
}

#[test]
fn table_mode_takes_the_damping_of_the_table() {
    let found = modes(&paper(Section::ThinSkin)).unwrap();
    assert_eq!(found.damping_ratio, [0.3, 0.00194, 0.00925, 0.00864, 0.00359, 0.00126, 0.00274, 0.00160]);
    let clamped = modes_holding(&paper(Section::ThinSkin), &table()).unwrap();
    assert_eq!(clamped.damping_ratio, found.damping_ratio[1..]);
    assert_eq!(clamped.shape["table"], [0.0; 7]);
    // A stiff spring puts the table's mode above all kept ones: its ratio is used by none of them.
    let mut stiff = paper(Section::ThinSkin);
    stiff.mass.get_mut("table").unwrap().stiffness_n_m = 12.0 * (TAU * 20e3).powi(2);
    assert_eq!(modes(&stiff).unwrap_err(), StructureError::MissingDamping { flexible: 8, given: 7 });
}

#[test]
fn structures_side_by_side_keep_their_modes() {
    let alone = modes(&paper(Section::ThinSkin)).unwrap();
    let mut spec = paper(Section::ThinSkin);
    spec.mass.insert("anvil".into(), Mass { mass_kg: 2.0, stiffness_n_m: 2.0 * (TAU * 20.0).powi(2), damping_ratio: 0.1 });
    spec.beam.insert("clamped".into(), Beam { point: BTreeMap::new(), ..paper_beam("ground") });
    spec.modal.insert(
        "other".into(),
        Modal {
            frequency_hz: vec![0.5, 100.0],
            damping_ratio: vec![0.01, 0.02],
            point: BTreeMap::from([("tip".into(), vec![3.0, 4.0])]),
            patch: BTreeMap::new(),
        },
    );
    spec.damping.beyond = Some(0.005);
    spec.reduction.modes = 12;
    let found = modes(&spec).unwrap();
    assert_eq!(found.len(), 14);
    assert!(found.frequency_rad_s.windows(2).all(|pair| pair[0] <= pair[1]));
    let of_table: Vec<usize> = (0..14).filter(|mode| found.shape["table"][*mode] != 0.0).collect();
    for (mode, place) in of_table.iter().enumerate() {
        assert!((found.frequency_rad_s[*place] / alone.frequency_rad_s[mode] - 1.0).abs() < 1e-12);
        assert!((found.shape["beam.tip"][*place] / alone.shape["beam.tip"][mode] - 1.0).abs() < 1e-8);
        assert_eq!(found.shape["clamped.end"][*place], 0.0);
    }
    let anvil = found.shape["anvil"].iter().position(|value| *value != 0.0).unwrap();
    assert!((found.frequency_rad_s[anvil] / TAU - 20.0).abs() < 1e-12);
    assert!((found.shape["anvil"][anvil] - 0.5_f64.sqrt()).abs() < 1e-15);
    assert_eq!(found.damping_ratio[anvil], 0.1);
    assert_eq!((found.shape["other.tip"][0], found.damping_ratio[0]), (3.0, 0.01));
    assert_eq!(found.discretisation_error[0], 0.0);
}

/// Two beams on one light mass: with equal beams the odd modes are those of the clamped beam, and the mass is at rest in them.
#[test]
fn equal_beams_on_one_mass_split_into_even_and_odd() {
    let mut spec = paper(Section::ThinSkin);
    spec.patch.clear();
    spec.beam.insert("second".into(), paper_beam("table"));
    spec.mass.get_mut("table").unwrap().mass_kg = 0.05;
    spec.damping.beyond = Some(0.01);
    let found = modes(&spec).unwrap();
    let clamped = modes(&bare_cantilever(3)).unwrap();
    for (mode, exact) in clamped.frequency_rad_s.iter().enumerate() {
        let odd = found.frequency_rad_s.iter().position(|frequency| (frequency / exact - 1.0).abs() < 1e-10).unwrap();
        assert!(found.shape["table"][odd].abs() < 1e-9, "{mode}");
        assert!((found.shape["beam.end"][odd] + found.shape["second.end"][odd]).abs() < 1e-8);
        assert!(found.shape["beam.end"][odd] > 0.0);
    }
}

/// A mass without a spring: frequency 0, shape `1/sqrt(total mass)` everywhere; the others are the limit of a soft spring.
#[test]
fn free_mass_has_a_rigid_body_mode() {
    let mut spec = paper(Section::ThinSkin);
    let table = spec.mass.get_mut("table").unwrap();
    (table.mass_kg, table.stiffness_n_m) = (0.1, 0.0);
    let free = modes(&spec).unwrap();
    let total_kg: f64 = 0.1 + 2750.0 * 0.03 * 0.98e-3 * 0.315;
    assert_eq!((free.frequency_rad_s[0], free.damping_ratio[0], free.discretisation_error[0]), (0.0, 0.0, 0.0));
    for point in ["table", "beam.tip", "beam.end", "beam.root"] {
        assert!((free.shape[point][0] * total_kg.sqrt() - 1.0).abs() < 1e-14);
    }
    assert!(free.patch["mfc"].coupling_n_per_v[0].abs() < 1e-18);
    spec.mass.get_mut("table").unwrap().stiffness_n_m = 1e-6;
    let soft = modes(&spec).unwrap();
    assert!(greatest_relative_difference(&free.frequency_rad_s[1..], &soft.frequency_rad_s[1..]) < 1e-8);
    assert!(greatest_relative_difference(&free.shape["beam.tip"][1..], &soft.shape["beam.tip"][1..]) < 1e-6);
    assert!((soft.frequency_rad_s[0] / (1e-6 / total_kg).sqrt() - 1.0).abs() < 1e-8);
}

#[test]
fn shapes_along_beams_pass_through_the_points() {
    let spec = paper(Section::ThinSkin);
    let found = modes(&spec).unwrap();
    let along = &shapes_along_beams(&spec, &[], 64).unwrap()["beam"];
    assert_eq!((along.place_m[0], along.place_m[63]), (0.0, 0.315));
    for mode in 0..8 {
        let shape = along.mode(mode).unwrap();
        assert!((shape[0] - found.shape["table"][mode]).abs() < 1e-13);
        assert!((shape[61] - found.shape["beam.tip"][mode]).abs() < 1e-10, "305 mm is place 61 of 63 to rounding");
        // Sturm: flexible mode n of a cantilever has n - 1 nodes.
        let crossings = shape.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count();
        assert_eq!(crossings, mode.saturating_sub(1) + usize::from(mode > 0), "mode {mode}: one more where the table moves against the beam");
    }
    assert_eq!(along.mode(8), None);
}

#[test]
fn faults_are_errors_with_numbers() {
    let with = |change: fn(&mut Spec)| {
        let mut spec = paper(Section::ThinSkin);
        change(&mut spec);
        modes(&spec).unwrap_err().to_string()
    };
    let patch_beyond = with(|spec| spec.patch.get_mut("mfc").unwrap().start_m = 0.25);
    assert!(patch_beyond.contains("patch.mfc covers 0.25 m to 0.335 m"), "{patch_beyond}");
    let overlap = with(|spec| {
        spec.patch.insert("second".into(), Patch { start_m: 0.05, ..paper_patch(Section::ThinSkin) });
    });
    assert!(overlap.contains("patches must not overlap"), "{overlap}");
    let outside = with(|spec| {
        spec.beam.get_mut("beam").unwrap().point.insert("far".into(), 0.4);
    });
    assert!(outside.contains("beam.beam.point.far is 0.4 m"), "{outside}");
    let nan = with(|spec| spec.beam.get_mut("beam").unwrap().youngs_modulus_pa = f64::NAN);
    assert!(nan.contains("beam.beam.youngs_modulus is NaN"), "{nan}");
    let huge = with(|spec| spec.beam.get_mut("beam").unwrap().youngs_modulus_pa = 1e300);
    assert!(huge.contains("outside the range"), "{huge}");
    let root = with(|spec| spec.beam.get_mut("beam").unwrap().root = "tabel".into());
    assert!(root.contains("\"tabel\"") && root.contains("(table)"), "{root}");
    let many = with(|spec| spec.reduction.modes = 5000);
    assert!(many.contains("at most 400"), "{many}");
    let tolerance = with(|spec| spec.reduction.mesh_tolerance = 1e-17);
    assert!(tolerance.contains("mesh_tolerance"), "{tolerance}");
    let damping = with(|spec| spec.reduction.modes = 10);
    assert!(damping.contains("9 flexible modes") && damping.contains("add 2"), "{damping}");
    let masses_only = with(|spec| {
        spec.beam.clear();
        spec.patch.clear();
    });
    assert!(masses_only.contains("8 modes are asked for and the structure has 1"), "{masses_only}");
    let held = modes_holding(&paper(Section::ThinSkin), &["beam.tip".into()]).unwrap_err().to_string();
    assert!(held.contains("only a mass can be held (table)"), "{held}");
    let coarse = modes_on_cubic_mesh(&paper(Section::ThinSkin), &[], 1e-5).unwrap_err().to_string();
    assert!(coarse.contains("use longer elements"), "{coarse}");
}

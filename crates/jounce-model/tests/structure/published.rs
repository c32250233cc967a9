//! Modes against the paper and numbers published for its model.

use crate::paper::{frequency_hz, greatest_relative_difference, paper, table};
use jounce_model::structure::{modes, modes_holding, modes_on_cubic_mesh};
use jounce_spec::Section;

/// Table 2 of the paper, model column, as printed.
#[test]
fn table_2_to_every_printed_digit() {
    let computed_hz = frequency_hz(&modes_holding(&paper(Section::ThinSkin), &table()).unwrap());
    assert!((computed_hz[0] - 8.66).abs() <= 0.005, "{}", computed_hz[0]);
    for (hz, printed) in computed_hz
        .iter()
        .zip([8.66, 50.3, 140.9, 278.9, 457.6, 681.9, 960.5])
        .skip(1)
    {
        assert!((hz - printed).abs() <= 0.05, "{hz} {printed}");
    }
}

/// Full composite section with the patch's own mass: within 0.9 % of the measured column.
#[test]
fn laminate_with_patch_mass_predicts_the_measured_column() {
    let computed_hz = frequency_hz(&modes_holding(&paper(Section::Laminate), &table()).unwrap());
    assert!(
        greatest_relative_difference(
            &computed_hz,
            &[9.01, 49.71, 133.18, 262.58, 435.25, 648.28, 910.21]
        ) < 5e-4,
        "{computed_hz:?}"
    );
    assert!(
        greatest_relative_difference(
            &computed_hz,
            &[9.01, 49.7, 133.2, 262.8, 436.2, 651.3, 918.1]
        ) < 0.009,
        "{computed_hz:?}"
    );
}

/// Without the patch's mass: 9.02 Hz and the rest of the row "composite, about shifted NA" of a 2.5
/// mm mesh.
#[test]
fn laminate_without_patch_mass() {
    let mut spec = paper(Section::Laminate);
    spec.patch.get_mut("mfc").unwrap().density_kg_m3 = 0.0;
    let computed_hz = frequency_hz(&modes_holding(&spec, &table()).unwrap());
    for (hz, expected) in computed_hz
        .iter()
        .zip([9.02, 50.92, 142.54, 283.70, 465.05, 690.91, 975.43])
    {
        assert!((hz - expected).abs() < 0.01, "{hz} {expected}");
    }
}

/// Shapes of the paper's harvester on its table: published values from a mesh of 2.5 mm cubic
/// elements, as printed.
#[test]
fn table_coupled_modes_of_the_paper() {
    let modal = modes(&paper(Section::ThinSkin)).unwrap();
    let tip = [
        0.29414, 12.13914, 10.58325, 9.52673, 8.15715, 6.81263, 5.67309, 4.41866,
    ];
    let table = [
        0.288364, 0.010461, 0.005877, 0.003357, 0.002459, 0.001976, 0.001542, 0.001269,
    ];
    let slope = [
        0.0127, 25.5627, 56.5846, 49.5722, 333.002, 586.987, 531.998, 195.718,
    ];
    let absolute = |values: &[f64]| values.iter().map(|value| value.abs()).collect::<Vec<_>>();
    assert!(greatest_relative_difference(&absolute(&modal.shape["beam.tip"]), &tip) < 2e-5);
    for (value, printed) in absolute(&modal.shape["table"]).iter().zip(table) {
        assert!((value - printed).abs() < 1e-6, "{value} {printed}");
    }
    let couplings: Vec<f64> = slope
        .iter()
        .map(|difference| difference * 8.6639e-5)
        .collect();
    let coupling = absolute(&modal.patch["mfc"].coupling_n_per_v);
    assert!((coupling[0] - couplings[0]).abs() < 5e-9);
    assert!(
        greatest_relative_difference(&coupling[1..], &couplings[1..]) < 1e-5,
        "{coupling:?}"
    );
}

/// `shared/plant/paper-plant.toml`, made by another program on cubic elements of at most 5 mm
/// between 0, 9, 94, 305 and 315 mm; its signs are arbitrary. Its first two frequencies have the
/// roundoff of a plain solve (6e-6 and 2e-7), which ours must not have.
#[test]
fn a_cubic_mesh_gives_the_plant_given_as_numbers() {
    let mut spec = paper(Section::ThinSkin);
    spec.beam.get_mut("beam").unwrap().point.remove("hammer");
    let modal = modes_on_cubic_mesh(&spec, &[], 5e-3).unwrap();
    let frequencies = [457.6487341226, 681.9430586802, 960.5247575291];
    let tip = [6.812658275635, 5.673139253107, 4.418725984466];
    let table = [0.001976333709613, 0.001541885795661, 0.001268572331023];
    let coupling = [0.05085583505485, 0.0460918804803, 0.01695679511644];
    let last = |values: &[f64]| {
        values[5..]
            .iter()
            .map(|value| value.abs())
            .collect::<Vec<_>>()
    };
    for (values, expected) in [
        (last(&frequency_hz(&modal)), frequencies),
        (last(&modal.shape["beam.tip"]), tip),
        (last(&modal.shape["table"]), table),
        (last(&modal.patch["mfc"].coupling_n_per_v), coupling),
    ] {
        let error = greatest_relative_difference(&values, &expected);
        assert!(error < 1e-8, "{error:e}");
    }
}

/// Published: mode 7 of the table-coupled model on elements of at most 20, 10, 5, 2.5 and 1.25 mm.
#[test]
fn cubic_meshes_converge_as_published() {
    let mut spec = paper(Section::ThinSkin);
    spec.beam.get_mut("beam").unwrap().point.remove("hammer");
    for (longest_m, expected_hz, printed_hz) in [
        (20e-3, 961.79, 1e-2),
        (10e-3, 960.61, 1e-2),
        (5e-3, 960.524, 1e-3),
        (2.5e-3, 960.518, 5e-4),
        (1.25e-3, 960.518, 5e-4),
    ] {
        let top_hz = frequency_hz(&modes_on_cubic_mesh(&spec, &[], longest_m).unwrap())[7];
        assert!(
            (top_hz - expected_hz).abs() <= printed_hz,
            "{longest_m}: {top_hz}"
        );
    }
}

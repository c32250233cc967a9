//! Points of a design and their rows.

use crate::{GRID, example_folder, study};
use jounce_analysis::Model;
use jounce_analysis::run::{RunPlan, StartState, simulate};
use jounce_control::Control;
use jounce_io::table::Values;
use jounce_spec::SpecFile;

#[test]
fn a_grid_runs_through_its_first_key_fastest() {
    let study = study(GRID);
    assert_eq!(
        (study.design.len(), study.parts(), study.points(2)),
        (8, 3, 6..8)
    );
    assert_eq!(study.design.point(0), [0.5e-3, 11.0, 1e5]);
    assert_eq!(study.design.point(1), [1e-3, 11.0, 1e5]);
    assert_eq!(study.design.point(6), [0.5e-3, 13.0, 1e6]);
}

#[test]
fn a_list_takes_its_values_side_by_side_and_drawn_points_stay_in_their_range() {
    let list = study(&GRID.replace("spec =", "sampling = \"list\"\nspec ="));
    assert_eq!(
        (list.design.len(), list.design.point(1)),
        (2, vec![1e-3, 13.0, 1e6])
    );
    for sampling in ["random", "latin-hypercube", "sobol"] {
        let text = format!(
            "spec = \"harvester.toml\"\nsampling = \"{sampling}\"\npoints = 64\n[vary]\n\"stop.tip.gap\" = \"0.5mm:1.5mm\"\n\
             \"circuit.load.resistance\" = \"1kohm:1Mohm:log\"\n"
        );
        let drawn = study(&text);
        let points: Vec<Vec<f64>> = (0..64).map(|index| drawn.design.point(index)).collect();
        assert!(
            points
                .iter()
                .all(|point| (0.5e-3..=1.5e-3).contains(&point[0])
                    && (1e3..=1e6).contains(&point[1])),
            "{sampling}"
        );
        // Half of the loads lie below the geometric mean of the ends: exactly so for cells of one
        // point each.
        let low = points
            .iter()
            .filter(|point| point[1] < 1e3 * 1e3_f64.sqrt())
            .count();
        assert!(
            if sampling == "random" {
                (16..48).contains(&low)
            } else {
                low == 32
            },
            "{sampling}: {low}"
        );
    }
}

#[test]
fn a_row_is_the_run_that_the_changed_spec_gives() {
    let study = study(GRID);
    let table = study.part(1, &Control::default()).unwrap().unwrap();
    let mut file = SpecFile::read(example_folder().join("harvester.toml")).unwrap();
    // Point 5: the second gap, the first frequency, the second load.
    let keys = [
        ("stop.tip.gap", "1 mm"),
        ("drive.shaker.frequency", "11 Hz"),
        ("circuit.load.resistance", "1 Mohm"),
    ];
    for (key, value) in keys
        .into_iter()
        .chain([("run.duration", "0.5 s"), ("run.average_over", "0.25 s")])
    {
        file.set(key, value).unwrap();
    }
    let prepared = Model::new(file.spec().unwrap()).unwrap();
    let plan = RunPlan {
        duration_s: 0.5,
        average_over_s: 0.25,
        tolerance: prepared.spec.run.tolerance,
        record_s: 0.0,
    };
    let result = simulate(
        &prepared.kernel,
        &StartState::rest(&prepared.kernel.plant),
        &plan,
    )
    .unwrap();
    assert_eq!(
        table.floats("mean_power_w").unwrap()[2],
        result.mean_power_w
    );
    assert_eq!(
        table.floats("voltage_rms_v").unwrap()[2],
        result.loads[0].voltage_rms_v
    );
    assert!(result.mean_power_w > 0.0);
}

#[test]
fn a_point_without_a_result_has_a_reason() {
    let study = study(&GRID.replace("0.5mm,1mm", "1mm,2mm").replace(
        "\"circuit.load.resistance\" = \"100kohm:1Mohm:2log\"",
        "\"patch.mfc.start\" = \"9mm,300mm\"",
    ));
    let table = study.part(1, &Control::default()).unwrap().unwrap();
    let Values::Text(reasons) = &table.column("failure").unwrap().values else {
        panic!("reasons are texts")
    };
    let power = table.floats("mean_power_w").unwrap();
    assert!(
        reasons[0].is_empty()
            && power[0] > 0.0
            && reasons[1].contains("patch.mfc")
            && power[1].is_nan(),
        "{reasons:?} {power:?}"
    );
}

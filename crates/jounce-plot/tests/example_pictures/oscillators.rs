//! `bouncing-and-impact-oscillators`: the resonance curve of Duffing's oscillator with its folds.

use crate::comparison::check;
use crate::rows::folder;
use jounce_analysis::{Bifurcation, Branch, BranchSearch, Model, OrbitMethodKind, Parameter};
use jounce_plot::{Axis, BranchLine, BranchMark, Colour, branches};
use jounce_spec::SpecFile;

const EXAMPLE: &str = "bouncing-and-impact-oscillators";

fn line(branch: &Branch) -> BranchLine {
    BranchLine {
        label: format!("period {}", branch.period_cycles),
        colour: Colour::of_period(branch.period_cycles),
        parameter: branch.points.iter().map(|point| point.parameter).collect(),
        // The cubic spring is relaxed at 0, so its penetration is the displacement.
        value: branch
            .points
            .iter()
            .map(|point| point.orbit.max_penetration_m)
            .collect(),
        stable: branch
            .points
            .iter()
            .map(|point| point.orbit.is_stable())
            .collect(),
    }
}

fn branch_mark(bifurcation: &Bifurcation) -> BranchMark {
    BranchMark {
        kind: bifurcation.kind.name().to_owned(),
        parameter: bifurcation.at.parameter,
        value: bifurcation.at.orbit.max_penetration_m,
    }
}

#[test]
fn resonance_curve_with_both_folds() {
    let file = SpecFile::read(folder(EXAMPLE).join("duffing.toml")).unwrap();
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let range = (0.95, 1.4);
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    let method = OrbitMethodKind::Shooting;
    let result = BranchSearch {
        base: &base,
        parameter: &parameter,
        range,
        method,
        tolerance: 1e-10,
        seeds: 0,
        longest_period: 1,
    }
    .run();
    let result = result.unwrap();
    let lines: Vec<BranchLine> = result.iter().map(line).collect();
    let marks: Vec<BranchMark> = result
        .iter()
        .flat_map(|branch| branch.bifurcations.iter().map(branch_mark))
        .collect();
    let axes = (
        Axis::linear("Drive frequency", "Hz"),
        Axis::linear("Largest displacement", "m"),
    );
    check(
        EXAMPLE,
        "resonance",
        &branches(
            "Duffing's oscillator at 1 N",
            axes.0,
            axes.1,
            &lines,
            &marks,
        ),
    );
}

//! Picture of `jounce diagram`: displacement at the start of each drive cycle, and power, over the
//! branches.

use super::DiagramResult;
use crate::failure::Failure;
use jounce_core::analysis::{
    AnalysisError, Branch, DiagramPoint, Model, Parameter, SectionPoint, SweepDirection,
};
use jounce_core::picture::{self, Axis, BranchLine, DiagramDots, DiagramView, Figure};
use jounce_core::spec::NumericKey;

/// Draws both panels.
pub fn figure(
    (base, parameter): (&Model, &Parameter),
    key: &NumericKey,
    result: &DiagramResult,
) -> Result<Figure, Failure> {
    let mut displacements = Vec::new();
    for branch in &result.branches {
        displacements.extend(sections((base, parameter), branch)?);
    }
    let powers = result.branches.iter().map(|branch| {
        line(
            branch,
            branch
                .points
                .iter()
                .map(|point| point.orbit.mean_power_w)
                .collect(),
        )
    });
    let views = [
        DiagramView {
            value: Axis::linear("Displacement once per cycle", "m"),
            lines: displacements,
            dots: dots(result, |point| {
                point
                    .section
                    .iter()
                    .map(|point| point.displacement_m)
                    .collect()
            }),
        },
        DiagramView {
            value: Axis::log("Mean power", "W"),
            lines: powers.collect(),
            dots: dots(result, |point| vec![point.mean_power_w]),
        },
    ];
    Ok(picture::diagram(
        &format!("Bifurcation diagram over {}", key.path()),
        &Axis::linear(key.path(), &key.unit()),
        &views,
    ))
}

/// Returns a line for each drive cycle of a branch.
fn sections(
    (base, parameter): (&Model, &Parameter),
    branch: &Branch,
) -> Result<Vec<BranchLine>, AnalysisError> {
    let section_of = |point: &jounce_core::analysis::BranchPoint| {
        SectionPoint::of_orbit(base, parameter, point.parameter, &point.orbit)
    };
    let sections_by_point = branch
        .points
        .iter()
        .map(section_of)
        .collect::<Result<Vec<_>, _>>()?;
    let cycles = branch.period_cycles as usize;
    Ok((0..cycles)
        .map(|cycle| {
            line(
                branch,
                sections_by_point
                    .iter()
                    .map(|section| section[cycle].displacement_m)
                    .collect(),
            )
        })
        .collect())
}

fn line(branch: &Branch, value: Vec<f64>) -> BranchLine {
    BranchLine {
        label: format!("branch of period {}", branch.period_cycles),
        parameter: branch.points.iter().map(|point| point.parameter).collect(),
        value,
        stable: branch
            .points
            .iter()
            .map(|point| point.orbit.is_stable())
            .collect(),
    }
}

/// Returns the points by direction, or by attractor where it is known.
fn dots(result: &DiagramResult, values: impl Fn(&DiagramPoint) -> Vec<f64>) -> Vec<DiagramDots> {
    let dots_of = |label: &str, is_selected: &dyn Fn(usize, &DiagramPoint) -> bool| {
        let mut dots = DiagramDots {
            label: label.to_owned(),
            parameter: Vec::new(),
            value: Vec::new(),
        };
        for (_, point) in result
            .points
            .iter()
            .enumerate()
            .filter(|(k, point)| is_selected(*k, point))
        {
            let values = values(point);
            dots.parameter
                .extend(std::iter::repeat_n(point.parameter, values.len()));
            dots.value.extend(values);
        }
        (!dots.value.is_empty()).then_some(dots)
    };
    match &result.history {
        Some(history) => (history.attractors.iter().enumerate())
            .filter_map(|(index, attractor)| {
                dots_of(&attractor.id, &|k, _| history.homes[k] == Some(index))
            })
            .collect(),
        None => [
            (SweepDirection::Up, "stepped up"),
            (SweepDirection::Down, "stepped down"),
        ]
        .into_iter()
        .filter_map(|(direction, label)| dots_of(label, &|_, point| point.direction == direction))
        .collect(),
    }
}

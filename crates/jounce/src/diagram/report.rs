//! Figure and warnings of a bifurcation diagram.

use super::{DiagramPoint, DiagramResult};
use crate::branch::branch_line;
use jounce_analysis::{AttractorTrack, SweepDirection};
use jounce_plot as picture;
use jounce_plot::{
    Axis, BranchLine, Colour, DOWN_WORDS, DiagramDots, DiagramView, Figure, Marker, UP_WORDS,
};

/// Markers of the attractors of one period, in the order of their letters.
const MARKERS: [Marker; 4] = [
    Marker::Circle,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
];

impl DiagramResult {
    /// Returns the figure: displacement at the start of each drive cycle, and mean power where there
    /// is one, over the branches.
    pub fn figure(&self) -> Figure {
        let mut views = vec![DiagramView {
            value: Axis::linear("Displacement once per cycle", "m"),
            lines: self.displacement_lines(),
            dots: self.dots(|point| {
                let section = point.section.iter();
                section.map(|point| point.displacement_m).collect()
            }),
        }];
        // A harvester without a load has no power to draw.
        if self.points.iter().any(|point| point.mean_power_w > 0.0) {
            views.push(DiagramView {
                value: Axis::log("Mean power", "W"),
                lines: self.power_lines(),
                dots: self.dots(|point| vec![point.mean_power_w]),
            });
        }
        let values: Vec<f64> = self.points.iter().map(|point| point.parameter).collect();
        picture::diagram(
            &format!("Bifurcation diagram over {}", self.key),
            &Axis::for_steps(&self.key, &self.unit, &values),
            &views,
        )
    }

    fn power_lines(&self) -> Vec<BranchLine> {
        let branches = self.branches.iter();
        branches
            .map(|branch| {
                branch_line(branch, label(branch.period_cycles), |point| {
                    point.mean_power_w
                })
            })
            .collect()
    }

    /// Returns a line for each drive cycle of each branch.
    fn displacement_lines(&self) -> Vec<BranchLine> {
        let mut lines = Vec::new();
        for (branch, displacement_m) in self.branches.iter().zip(&self.branch_displacement_m) {
            for cycle in 0..branch.period_cycles as usize {
                let mut values = displacement_m.iter().map(|section_m| section_m[cycle]);
                lines.push(branch_line(branch, label(branch.period_cycles), |_| {
                    values.next().unwrap_or(f64::NAN)
                }));
            }
        }
        lines
    }

    /// Returns the points by direction, or by attractor where it is known.
    fn dots(&self, values: impl Fn(&DiagramPoint) -> Vec<f64>) -> Vec<DiagramDots> {
        let dots_of = |(label, colour, marker): (&str, Colour, Marker),
                       is_selected: &dyn Fn(&DiagramPoint) -> bool| {
            let mut dots = DiagramDots {
                label: label.to_owned(),
                colour,
                marker,
                parameter: Vec::new(),
                value: Vec::new(),
            };
            for point in self.points.iter().filter(|point| is_selected(point)) {
                let values = values(point);
                dots.parameter
                    .extend(std::iter::repeat_n(point.parameter, values.len()));
                dots.value.extend(values);
            }
            (!dots.value.is_empty()).then_some(dots)
        };
        match &self.attractors {
            Some(attractors) => (attractors.iter().enumerate())
                .filter_map(|(index, track)| {
                    let look = (
                        track.id.as_str(),
                        Colour::of_period(track.period_cycles),
                        marker(&attractors[..index], track),
                    );
                    let id = Some(&track.id);
                    dots_of(look, &|point| point.attractor.as_ref() == id)
                })
                .collect(),
            None => [
                (SweepDirection::Up, (UP_WORDS, Colour::Ink, Marker::Right)),
                (
                    SweepDirection::Down,
                    (DOWN_WORDS, Colour::Grey, Marker::Left),
                ),
            ]
            .into_iter()
            .filter_map(|(direction, look)| dots_of(look, &|point| point.direction == direction))
            .collect(),
        }
    }

    /// Returns the warnings about failed runs.
    pub fn warnings(&self) -> Vec<String> {
        let (lost, of) = (
            self.points.iter().filter(|point| point.is_lost()).count(),
            self.points.len(),
        );
        if lost == 0 {
            Vec::new()
        } else if lost == of {
            vec!["every run failed; try a larger `tolerance` or another range".to_owned()]
        } else {
            vec![format!(
                "{lost} of {of} runs failed; their motion is `lost`"
            )]
        }
    }
}

/// Returns the marker of an attractor by its number among those of its period.
fn marker(before: &[AttractorTrack], of: &AttractorTrack) -> Marker {
    let period_cycles = of.period_cycles;
    let is_same = |track: &&AttractorTrack| track.period_cycles == period_cycles;
    MARKERS[before.iter().filter(is_same).count() % MARKERS.len()]
}

fn label(period_cycles: u32) -> String {
    format!("branch of period {period_cycles}")
}

//! Results that stepped sweeps cannot give: all branches of figure 6, and the jumps as functions of
//! the gap.

use super::power_over_frequency::{LEVELS_N, PowerOverFrequency};
use crate::harvester::{MEGOHM, PaperHarvester};
use crate::named::column;
use crate::{NamedFigure, NamedTable, ReproduceError};
use jounce_analysis::{
    BifurcationCurve, BifurcationCurvePoint, BifurcationSearch, Branch, BranchPoint, BranchSearch,
    Model, OrbitMethodKind, Parameter,
};
use jounce_control::Control;
use jounce_io::table::{Table, TableError};
use jounce_plot::{
    Axis, BifurcationLine, BranchLine, BranchMark, Colour, Marker, Series, bifurcations, branches,
};
use jounce_spec::NumericKey;
use rayon::prelude::*;

/// Frequency range of figure 6, Hz.
const FREQUENCIES_HZ: (f64, f64) = (4.0, 20.0);

/// Frequency range (Hz), gap range (m) and force (N) of the map of jumps.
const MAP_HZ: (f64, f64) = (9.0, 15.0);
const GAPS_M: (f64, f64) = (0.25e-3, 2e-3);
const MAP_LEVEL_N: f64 = 50.0;

/// Number of frequencies at which time integration searches for branches, and the longest period of
/// an orbit, drive cycles.
const START_VALUES: usize = 15;
const MAX_PERIOD_CYCLES: u32 = 4;

/// Relative tolerance of the runs.
const TOLERANCE: f64 = 1e-9;

/// Branches of every force level, N, and the map of jumps.
pub(crate) struct PaperOrbits {
    levels: Vec<(f64, Vec<Branch>)>,
    jumps: Vec<BifurcationCurve>,
}

impl PaperOrbits {
    /// Continues all branches and jumps, with the stop on the ground.
    pub fn compute(control: &Control) -> Result<Self, ReproduceError> {
        let (levels, jumps) = rayon::join(
            || {
                LEVELS_N
                    .into_par_iter()
                    .map(|level| Ok((level, traced_branches(level, control)?)))
                    .collect::<Result<Vec<_>, ReproduceError>>()
            },
            || map_of_jumps(control),
        );
        Ok(Self {
            levels: levels?,
            jumps: jumps?,
        })
    }

    /// Returns the figure of the branches, with the points of the stepped sweeps.
    pub fn figure(&self, swept: &PowerOverFrequency) -> NamedFigure {
        let (mut lines, mut marks) = (Vec::new(), Vec::new());
        for (number, (level, bifurcations)) in self.levels.iter().enumerate() {
            let power = |point: &BranchPoint| point.orbit.mean_power_w / (level * level);
            lines.extend(bifurcations.iter().map(|branch| {
                BranchLine {
                    label: format!("{level} N"),
                    colour: Colour::nth(number),
                    parameter: branch.points.iter().map(|point| point.parameter).collect(),
                    value: branch.points.iter().map(power).collect(),
                    stable: branch
                        .points
                        .iter()
                        .map(|point| point.orbit.is_stable())
                        .collect(),
                }
            }));
            marks.extend(
                bifurcations
                    .iter()
                    .flat_map(|branch| &branch.bifurcations)
                    .map(|bifurcations| BranchMark {
                        kind: bifurcations.kind.name().to_owned(),
                        parameter: bifurcations.at.parameter,
                        value: power(&bifurcations.at),
                    }),
            );
        }
        let (x, y) = (
            Axis::linear("Drive frequency", "Hz"),
            Axis::log("Mean power per force squared", "W/N²"),
        );
        let mut figure = branches("Branches of periodic orbits", x, y, &lines, &marks);
        for (k, level) in swept.levels.iter().enumerate() {
            for sweep_branch in [&level.up, &level.down] {
                let points = Series::points(
                    sweep_branch.frequency_hz.clone(),
                    sweep_branch.power_w_n2.clone(),
                    Marker::Circle,
                );
                figure
                    .panels
                    .iter_mut()
                    .for_each(|panel| panel.series.push(points.clone().colour(Colour::nth(k))));
            }
        }
        let caption = "Figure 6 with the periodic orbits of one to four drive cycles: stable segments solid, unstable ones dashed. The \
                       points are from the stepped sweeps.";
        NamedFigure::new("figure-6-branches", caption, figure)
    }

    /// Returns the map of jumps over frequency and gap.
    pub fn map(&self) -> NamedFigure {
        let lines: Vec<BifurcationLine> = (self.jumps.iter())
            .map(|curve| BifurcationLine {
                kind: curve.kind.name().to_owned(),
                x: curve.points.iter().map(|point| point.parameter).collect(),
                y: curve
                    .points
                    .iter()
                    .map(|point| 1e3 * point.parameter_2)
                    .collect(),
            })
            .collect();
        let (x, y) = (
            Axis::linear("Drive frequency", "Hz"),
            Axis::linear("Gap", "mm"),
        );
        let caption = "Frequencies of the jumps at 50 N over the gap: the position of the stop tunes the harvester.";
        NamedFigure::new(
            "jumps-over-gap",
            caption,
            bifurcations("Bifurcation curves", x, y, &lines),
        )
    }

    /// Returns the data of both figures.
    pub fn tables(&self) -> Result<Vec<NamedTable>, ReproduceError> {
        Ok(vec![
            NamedTable::new(
                "figure-6-branches",
                "Periodic orbits of figure 6.",
                5,
                self.branch_points()?,
            ),
            NamedTable::new(
                "jumps-over-gap",
                "Jumps over frequency and gap at 50 N.",
                5,
                self.jump_points()?,
            ),
        ])
    }

    /// Returns the points of all branches, with the force level and the number of the branch.
    fn branch_points(&self) -> Result<Table, TableError> {
        let points: Vec<(f64, u64, &BranchPoint)> = (self.levels.iter())
            .flat_map(|(level, found)| {
                found
                    .iter()
                    .enumerate()
                    .map(move |(k, branch)| (*level, k as u64, branch))
            })
            .flat_map(|(level, k, branch)| branch.points.iter().map(move |point| (level, k, point)))
            .collect();
        Table::new(vec![
            column(
                &points,
                ("amplitude_n", "N", "Force, peak"),
                |(level, ..)| *level,
            ),
            column(
                &points,
                ("branch", "", "Number of the branch"),
                |(_, k, _)| *k,
            ),
            column(
                &points,
                ("period_cycles", "", "Period in drive cycles"),
                |(.., point)| u64::from(point.orbit.period_cycles),
            ),
            column(
                &points,
                ("frequency_hz", "Hz", "Drive frequency"),
                |(.., point)| point.parameter,
            ),
            column(
                &points,
                ("power_w_n2", "W/N^2", "Mean power per force squared"),
                |(level, _, point)| point.orbit.mean_power_w / (level * level),
            ),
            column(&points, ("stable", "", "Attracts"), |(.., point)| {
                point.orbit.is_stable()
            }),
        ])
    }

    /// Returns the points of the curves of jumps.
    fn jump_points(&self) -> Result<Table, TableError> {
        let jumps: Vec<(&BifurcationCurve, &BifurcationCurvePoint)> = self
            .jumps
            .iter()
            .flat_map(|curve| curve.points.iter().map(move |point| (curve, point)))
            .collect();
        Table::new(vec![
            column(&jumps, ("kind", "", "What happens"), |(curve, _)| {
                curve.kind.name().to_owned()
            }),
            column(
                &jumps,
                ("frequency_hz", "Hz", "Drive frequency"),
                |(_, point)| point.parameter,
            ),
            column(&jumps, ("gap_m", "m", "Gap"), |(_, point)| {
                point.parameter_2
            }),
            column(&jumps, ("mean_power_w", "W", "Mean power"), |(_, point)| {
                point.mean_power_w
            }),
        ])
    }
}

/// Prepares the harvester at a force level, with its frequency as a key.
fn prepared(level_n: f64, control: &Control) -> Result<(Model, NumericKey), ReproduceError> {
    let set = |key: &str, value: String| (key.to_owned(), value);
    let settings = [
        set("drive.shaker.amplitude", format!("{level_n} N")),
        set("circuit.load.resistance", format!("{MEGOHM} ohm")),
    ];
    let spec = PaperHarvester::spec(&settings)?;
    let key = NumericKey::find(&spec, "drive.shaker.frequency")?;
    Ok((Model::watched(spec, control)?, key))
}

fn traced_branches(level_n: f64, control: &Control) -> Result<Vec<Branch>, ReproduceError> {
    let (base, key) = prepared(level_n, control)?;
    let parameter = Parameter::new(&base, &key, FREQUENCIES_HZ.1 - FREQUENCIES_HZ.0);
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range: FREQUENCIES_HZ,
        method: OrbitMethodKind::Shooting,
        tolerance: TOLERANCE,
        seeds: START_VALUES,
        longest_period: MAX_PERIOD_CYCLES,
    };
    Ok(search.run()?)
}

fn map_of_jumps(control: &Control) -> Result<Vec<BifurcationCurve>, ReproduceError> {
    let (base, key) = prepared(MAP_LEVEL_N, control)?;
    let gap = NumericKey::find(&base.spec, "stop.tip.gap")?;
    let (keys, ranges) = ([&key, &gap], [MAP_HZ, GAPS_M]);
    let search = BifurcationSearch {
        base: &base,
        keys,
        ranges,
        tolerance: TOLERANCE,
        seeds: 0,
        longest_period: 1,
        peaks: false,
    };
    Ok(search
        .run()?
        .into_iter()
        .filter(|curve| curve.period_cycles == 1)
        .collect())
}

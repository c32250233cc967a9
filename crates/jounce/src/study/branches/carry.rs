//! Carries branches over to a neighbouring harvester, every point by itself.
//!
//! Where a design changes a little, each of its orbits does. Newton takes every known point onto the curve of the new design, across the
//! chord between its neighbours; points at the edges of the range keep their parameter. No point waits for another, so that all cores work
//! on them and no step is tried in vain. Branches that appear are not found, nor are multipliers that pass a critical value and come back
//! between two points: [`BranchSearch`](super::BranchSearch) finds both.

use super::branch::{Bifurcation, Branch, BranchPoint};
use super::follow::{Following, Place};
use crate::continuation::{Corrector, Direction, Metric, Position, Step, StepControl, correct, tangent};
use crate::march::Kernel;
use crate::orbit::{OrbitMethod, Shooting};
use crate::study::Parameter;
use rayon::prelude::*;

/// Branches to be carried over.
#[derive(Debug)]
pub struct BranchCarry<'s> {
    /// The new harvesters.
    pub harvester: &'s Parameter<'s>,
    /// One of them.
    pub kernel: &'s Kernel,
    /// Ends of the range of the key, those of the known branches.
    pub range: (f64, f64),
    /// Relative tolerance of the marches.
    pub tolerance: f64,
    /// Length in the metric (a twentieth of the range counts as one) to which bifurcations are located.
    pub resolution: f64,
}

/// What came of it.
#[derive(Debug, Default)]
pub struct Carried {
    /// The branches; a branch is cut where points are lost.
    pub branches: Vec<Branch>,
    /// Points whose Newton led nowhere.
    pub lost: usize,
}

impl BranchCarry<'_> {
    /// Carries them over.
    pub fn run(&self, known: &[Branch]) -> Carried {
        let goal = (50.0 * self.tolerance).clamp(1e-11, 1e-3);
        let corrector = Corrector { goal, most: 6 };
        let following = Following {
            range: self.range,
            corrector,
            control: StepControl::default(),
            most_points: usize::MAX,
            resolution: self.resolution,
        };
        let mut carried = Carried::default();
        for branch in known {
            self.carry(&following, branch, &mut carried);
        }
        carried
    }

    fn carry(&self, following: &Following, branch: &Branch, carried: &mut Carried) {
        let shooting = Shooting::new(self.harvester, self.kernel, branch.period_cycles, self.tolerance);
        if branch.points.iter().any(|point| point.orbit.start().len() != shooting.scale.len()) {
            carried.lost += branch.points.len();
            return;
        }
        let place = |index| self.place(following, &shooting, &branch.points, index);
        let found: Vec<_> = (0..branch.points.len()).into_par_iter().map(place).collect();
        carried.lost += found.iter().filter(|place| place.is_none()).count();
        let is_inside = |value: f64| (self.range.0..=self.range.1).contains(&value);
        let ends = |place: &Option<_>| !place.as_ref().is_some_and(|place: &Place<_>| is_inside(place.step.position.parameter));
        for run in found.split(ends).filter(|run| run.len() > 1) {
            let places: Vec<_> = run.iter().flatten().collect();
            let between = places.par_windows(2).map(|pair| following.between(&shooting, pair[0], pair[1]).unwrap_or_default());
            let bifurcations: Vec<Vec<Bifurcation>> = between.collect();
            carried.branches.push(Branch {
                period_cycles: branch.period_cycles,
                points: places.iter().map(|place| place.point.clone()).collect(),
                bifurcations: bifurcations.into_iter().flatten().collect(),
                endings: branch.endings.clone(),
            });
        }
    }

    fn place<M: OrbitMethod>(&self, following: &Following, method: &M, points: &[BranchPoint], index: usize) -> Option<Place<M>> {
        let position = |index: usize| Position { unknown: points[index].orbit.start().to_vec(), parameter: points[index].parameter };
        let here = position(index);
        let metric = Metric::at(&here, following.parameter_scale());
        let chord = metric.unit(position(index.saturating_sub(1)).to(&position((index + 1).min(points.len() - 1))));
        let at_edge = here.parameter == self.range.0 || here.parameter == self.range.1;
        let upright = Direction { unknown: vec![0.0; here.unknown.len()], parameter: metric.parameter };
        let found = correct(method, &following.corrector, &metric, if at_edge { &upright } else { &chord }, here).ok()?;
        let tangent = tangent(&found.local, &metric, &chord)?;
        let step = Step { position: found.position, tangent, local: found.local, error: found.error };
        Place::new(method, step).ok()
    }
}

//! Labels that one search has and another lacks.

use crate::harvesters::bench_with_keys;
use jounce_analysis::{
    Bifurcation, Branch, BranchKind, BranchOptions, BranchPoint, BranchSearch, Model,
    OrbitMethodKind, Parameter,
};
use jounce_orbits::OrbitError;
use jounce_spec::SpecFile;

/// Seed of the harvesters.
const SEED: u64 = 7;

/// Distance in the key, relative to the range and beyond the stated errors, and in the power of
/// their orbits, within which two labels of one kind are equal.
const SAME: f64 = 1e-4;
const SAME_POWER: f64 = 1e-2;

/// Distance to both sides of a label, relative to the range, on which another search must have
/// followed the curve for a comparison.
const BESIDE: f64 = 1e-3;

/// A harvester and the frequencies over which its branches are followed.
pub struct Case {
    file: SpecFile,
    key: &'static str,
    range: (f64, f64),
}

/// Settings of a search.
#[derive(Debug, Clone, Copy)]
struct Settings {
    tolerance: f64,
    largest_step: f64,
    pieces: usize,
    longest_period: u32,
}

const USUAL: Settings = Settings {
    tolerance: 1e-9,
    largest_step: 0.4,
    pieces: 1,
    longest_period: 2,
};

const OTHERS: [Settings; 4] = [
    Settings {
        tolerance: 1e-7,
        ..USUAL
    },
    Settings {
        tolerance: 1e-10,
        ..USUAL
    },
    Settings {
        largest_step: 0.2,
        ..USUAL
    },
    Settings { pieces: 3, ..USUAL },
];

impl Case {
    /// The bench with some keys changed.
    pub fn of_bench(changes: &[(&str, &str)]) -> Self {
        Self {
            file: bench_with_keys(changes),
            key: "drive.shaker.frequency",
            range: (4.0, 20.0),
        }
    }

    /// Random harvester of this number.
    pub fn random(index: u64) -> Self {
        let file = SpecFile::from_text(super::random_specs::random_spec(SEED, index));
        let key = "drive.d.frequency";
        let centre = file
            .numeric_key(key)
            .unwrap()
            .get(&file.spec().unwrap())
            .unwrap();
        Self {
            file,
            key,
            range: (0.85 * centre, 1.15 * centre),
        }
    }

    /// The same harvester over another range.
    pub fn over(self, range: (f64, f64)) -> Self {
        Self { range, ..self }
    }

    /// Labels of the branches of period 1 at a tolerance.
    pub fn labels(&self, tolerance: f64) -> Vec<Bifurcation> {
        let settings = Settings {
            tolerance,
            longest_period: 1,
            ..USUAL
        };
        let branches = self.search(settings);
        branches
            .into_iter()
            .flat_map(|branch| branch.bifurcations)
            .collect()
    }

    fn width(&self) -> f64 {
        self.range.1 - self.range.0
    }

    fn search(&self, settings: Settings) -> Vec<Branch> {
        let base = Model::new(self.file.spec().unwrap()).unwrap();
        let key = self.file.numeric_key(self.key).unwrap();
        let step = self.width() / settings.pieces as f64;
        let cuts: Vec<f64> = (0..=settings.pieces)
            .map(|k| self.range.0 + step * k as f64)
            .collect();
        let of_piece = |ends: &[f64]| {
            let range = (ends[0], ends[1]);
            let parameter = Parameter::new(&base, &key, range.1 - range.0);
            let (method, tolerance) = (OrbitMethodKind::Shooting, settings.tolerance);
            let search = BranchSearch {
                base: &base,
                parameter: &parameter,
                range,
                method,
                tolerance,
                seeds: 0,
                longest_period: settings.longest_period,
            };
            let options = BranchOptions {
                largest_step: settings.largest_step,
                ..BranchOptions::default()
            };
            match search.run_with(&options) {
                Ok(branches) => branches,
                Err(error @ OrbitError::Multipliers { .. }) => panic!("{error}"),
                Err(error) => {
                    eprintln!("{error}");
                    Vec::new()
                }
            }
        };
        cuts.windows(2).flat_map(of_piece).collect()
    }

    /// Labels of one search that the other lacks, although it followed the curve there and lists no
    /// unproved part.
    fn missing<'b>(&self, one: &'b [Branch], other: &[Branch]) -> Vec<&'b Bifurcation> {
        let labels = one
            .iter()
            .flat_map(|branch| branch.bifurcations.iter().map(move |label| (branch, label)));
        let missing_labels = labels.filter(|(branch, label)| {
            !self.has(other, label) && self.has_followed(other, branch, label)
        });
        let is_unproved = |label: &Bifurcation| {
            one.iter()
                .chain(other)
                .any(|branch| self.is_not_proved(branch, label))
        };
        missing_labels
            .map(|(_, label)| label)
            .filter(|label| !is_unproved(label))
            .collect()
    }

    fn has(&self, branches: &[Branch], label: &Bifurcation) -> bool {
        branches
            .iter()
            .flat_map(|branch| &branch.bifurcations)
            .any(|candidate| {
                let (power_w, other_w) =
                    (label.at.orbit.mean_power_w, candidate.at.orbit.mean_power_w);
                let errors = [candidate, label].map(|one| one.parameter_error.unwrap_or(0.0));
                let within = SAME * self.width() + errors.iter().sum::<f64>();
                candidate.kind == label.kind
                    && (candidate.at.parameter - label.at.parameter).abs() < within
                    && (other_w - power_w).abs() <= SAME_POWER * power_w
            })
    }

    /// True where branches pass the points next to a label on both of its sides.
    fn has_followed(&self, branches: &[Branch], branch: &Branch, label: &Bifurcation) -> bool {
        let from_label =
            |index: usize| distance(label.at.orbit.start(), branch.points[index].orbit.start());
        let Some(nearest) =
            (0..branch.points.len()).min_by(|a, b| from_label(*a).total_cmp(&from_label(*b)))
        else {
            return false;
        };
        let neighbours: Vec<_> = [nearest.checked_sub(1), Some(nearest), Some(nearest + 1)]
            .into_iter()
            .flatten()
            .filter_map(|index| branch.points.get(index))
            .filter(|point| {
                (point.parameter - label.at.parameter).abs() > SAME * BESIDE * self.width()
            })
            .collect();
        let same_period = |other: &&Branch| other.period_cycles == branch.period_cycles;
        neighbours.len() > 1
            && neighbours.iter().all(|point| {
                branches
                    .iter()
                    .filter(same_period)
                    .any(|other| passes(other, branch, point))
            })
    }

    fn is_not_proved(&self, branch: &Branch, label: &Bifurcation) -> bool {
        let near = SAME * self.width();
        let at = label.at.parameter;
        branch.not_proved.iter().any(|part| {
            // A missed fold may appear as a branch point, and the reverse.
            let is_alike = part.event == label.kind
                || [part.event, label.kind].iter().all(|kind| is_real(*kind));
            is_alike
                && (part.from.min(part.to) - near..=part.from.max(part.to) + near).contains(&at)
        })
    }

    /// Number of labels that one of two searches lacks, over all settings.
    pub fn check(&self, name: &str) -> usize {
        let begin = std::time::Instant::now();
        let usual = self.search(USUAL);
        let labels = usual
            .iter()
            .map(|branch| branch.bifurcations.len())
            .sum::<usize>();
        let unproved_count = |branches: &[Branch]| {
            branches
                .iter()
                .map(|branch| branch.not_proved.len())
                .sum::<usize>()
        };
        let mut report = format!(
            "{name}: {} branches, {labels} labels, {} doubts",
            usual.len(),
            unproved_count(&usual)
        );
        let mut missing_count = 0;
        for settings in OTHERS {
            let other = self.search(settings);
            report += &format!("; {} {} doubts", other.len(), unproved_count(&other));
            for (which_set, missing) in [
                ("more", self.missing(&other, &usual)),
                ("missing", self.missing(&usual, &other)),
            ] {
                for label in missing {
                    missing_count += 1;
                    let (at, orbit) = (label.at.parameter, &label.at.orbit);
                    let at_error = label.parameter_error.unwrap_or(0.0);
                    let (cycles, power_w, error) = (
                        orbit.period_cycles,
                        orbit.mean_power_w,
                        orbit.error_estimate,
                    );
                    report += &format!(
                        "\n  {settings:?}: {which_set} {:?} of period {cycles} at {at} +- {at_error:e}, {power_w:e} W +- {error:e}",
                        label.kind
                    );
                }
            }
        }
        eprintln!("{report} ({:.1} s)", begin.elapsed().as_secs_f64());
        missing_count
    }
}

fn distance(one: &[f64], two: &[f64]) -> f64 {
    one.iter()
        .zip(two)
        .map(|(a, b)| (a - b).powi(2))
        .sum::<f64>()
        .sqrt()
}

/// True where a branch of another search passes a point of a branch. Beyond a fold the branch has
/// another state at the same key; one that ended early before the fold, which is reported, passes
/// only the first.
fn passes(other: &Branch, branch: &Branch, point: &BranchPoint) -> bool {
    let (start, power_w) = (point.orbit.start(), point.orbit.mean_power_w);
    let sheets = branch.crossings(point.parameter);
    other
        .crossings(point.parameter)
        .iter()
        .any(|(state, other_w)| {
            let state_error = distance(state, start);
            state_error < SAME_POWER * point.orbit.size()
                && (other_w - power_w).abs() <= SAME_POWER * power_w
                && (other.is_complete()
                    || sheets
                        .iter()
                        .all(|(sheet, _)| state_error <= distance(state, sheet)))
        })
}

fn is_real(kind: BranchKind) -> bool {
    matches!(kind, BranchKind::Fold | BranchKind::BranchPoint)
}

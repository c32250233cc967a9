//! Labels do not depend on the tolerance, the largest step or the subdivision of the range. Where
//! two searches follow the same piece of a curve, each label of one is a label of the other, or
//! lies in a part that one of them lists as not proved.
//!
//! ```text
//! JOUNCE_DRAWN_SYSTEMS=40 cargo test --release -p jounce --test orbits labels_of_drawn -- --nocapture
//! ```

#[path = "../attractors/drawn.rs"]
mod drawn;

use crate::harvesters::bench;
use jounce_core::analysis::{
    Bifurcation, Branch, BranchKind, BranchOptions, BranchSearch, Model, OrbitMethodKind, Parameter,
};
use jounce_core::orbit::OrbitError;
use jounce_core::spec::SpecFile;

/// Seed of the harvesters.
const SEED: u64 = 7;

/// Distance in the key, relative to the range, and in the power of their orbits, within which two
/// labels of one kind are equal.
const SAME: f64 = 1e-4;
const SAME_POWER: f64 = 1e-2;

/// Distance to both sides of a label, relative to the range, on which another search must have
/// followed the curve for a comparison.
const BESIDE: f64 = 1e-3;

/// A harvester and the frequencies over which its branches are followed.
struct Case {
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
}

const USUAL: Settings = Settings {
    tolerance: 1e-9,
    largest_step: 0.4,
    pieces: 1,
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
    fn of_bench(changes: &[(&str, &str)]) -> Self {
        let mut file = bench();
        changes
            .iter()
            .for_each(|(key, value)| file.set(key, value).unwrap());
        Self {
            file,
            key: "drive.shaker.frequency",
            range: (4.0, 20.0),
        }
    }

    fn drawn(index: u64) -> Self {
        let file = SpecFile::from_text(drawn::drawn(SEED, index));
        let key = "drive.d.frequency";
        let own = file
            .numeric_key(key)
            .unwrap()
            .get(&file.spec().unwrap())
            .unwrap();
        Self {
            file,
            key,
            range: (0.85 * own, 1.15 * own),
        }
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
                longest_period: 2,
            };
            let options = BranchOptions {
                largest_step: settings.largest_step,
                ..BranchOptions::default()
            };
            match search.run_with(&options) {
                Ok(found) => found,
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
            .flat_map(|branch| branch.bifurcations.iter().map(move |found| (branch, found)));
        let lacks = labels
            .filter(|(own, found)| !self.has(other, found) && self.has_followed(other, own, found));
        let doubtful = |found: &Bifurcation| {
            one.iter()
                .chain(other)
                .any(|branch| self.doubts(branch, found))
        };
        lacks
            .map(|(_, found)| found)
            .filter(|found| !doubtful(found))
            .collect()
    }

    fn has(&self, branches: &[Branch], label: &Bifurcation) -> bool {
        branches
            .iter()
            .flat_map(|branch| &branch.bifurcations)
            .any(|own| {
                let (power_w, own_w) = (label.at.orbit.mean_power_w, own.at.orbit.mean_power_w);
                own.kind == label.kind
                    && (own.at.parameter - label.at.parameter).abs() < SAME * self.width()
                    && (own_w - power_w).abs() <= SAME_POWER * power_w
            })
    }

    /// True where branches pass the points next to a label on both of its sides.
    fn has_followed(&self, branches: &[Branch], own: &Branch, label: &Bifurcation) -> bool {
        let apart = |index: usize| {
            let (here, there) = (label.at.orbit.start(), own.points[index].orbit.start());
            here.iter()
                .zip(there)
                .map(|(a, b)| (a - b).powi(2))
                .sum::<f64>()
                .sqrt()
        };
        let Some(nearest) = (0..own.points.len()).min_by(|a, b| apart(*a).total_cmp(&apart(*b)))
        else {
            return false;
        };
        let beside: Vec<_> = [nearest.checked_sub(1), Some(nearest), Some(nearest + 1)]
            .into_iter()
            .flatten()
            .filter_map(|index| own.points.get(index))
            .filter(|point| {
                (point.parameter - label.at.parameter).abs() > SAME * BESIDE * self.width()
            })
            .collect();
        let passes = |branch: &Branch, point: &jounce_core::analysis::BranchPoint| {
            let size = point
                .orbit
                .start()
                .iter()
                .map(|u| u * u)
                .sum::<f64>()
                .sqrt();
            branch
                .crossings(point.parameter)
                .iter()
                .any(|(state, power_w)| {
                    let off = state
                        .iter()
                        .zip(point.orbit.start())
                        .map(|(a, b)| (a - b).powi(2))
                        .sum::<f64>()
                        .sqrt();
                    off < SAME_POWER * size
                        && (power_w - point.orbit.mean_power_w).abs()
                            <= SAME_POWER * point.orbit.mean_power_w
                })
        };
        let alike = |branch: &&Branch| branch.period_cycles == own.period_cycles;
        beside.len() > 1
            && beside.iter().all(|point| {
                branches
                    .iter()
                    .filter(alike)
                    .any(|branch| passes(branch, point))
            })
    }

    fn doubts(&self, branch: &Branch, label: &Bifurcation) -> bool {
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

    fn check(&self, name: &str) -> usize {
        let begun = std::time::Instant::now();
        let usual = self.search(USUAL);
        let labels = usual
            .iter()
            .map(|branch| branch.bifurcations.len())
            .sum::<usize>();
        let doubts = |branches: &[Branch]| {
            branches
                .iter()
                .map(|branch| branch.not_proved.len())
                .sum::<usize>()
        };
        let mut listed = format!(
            "{name}: {} branches, {labels} labels, {} doubts",
            usual.len(),
            doubts(&usual)
        );
        let mut wrong = 0;
        for settings in OTHERS {
            let other = self.search(settings);
            listed += &format!("; {} {} doubts", other.len(), doubts(&other));
            for (who, missing) in [
                ("more", self.missing(&other, &usual)),
                ("missing", self.missing(&usual, &other)),
            ] {
                for found in missing {
                    wrong += 1;
                    let (at, orbit) = (found.at.parameter, &found.at.orbit);
                    let (cycles, power_w, error) = (
                        orbit.period_cycles,
                        orbit.mean_power_w,
                        orbit.error_estimate,
                    );
                    listed += &format!(
                        "\n  {settings:?}: {who} {:?} of period {cycles} at {at}, {power_w:e} W +- {error:e}",
                        found.kind
                    );
                }
            }
        }
        eprintln!("{listed} ({:.1} s)", begun.elapsed().as_secs_f64());
        wrong
    }
}

fn is_real(kind: BranchKind) -> bool {
    matches!(kind, BranchKind::Fold | BranchKind::BranchPoint)
}

fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok().map(|text| {
        text.parse()
            .unwrap_or_else(|_| panic!("{name} is `{text}`, no number"))
    })
}

#[test]
fn labels_of_the_cases_of_these_tests_are_the_same_for_all_settings() {
    let cases: [&[(&str, &str)]; 12] = [
        &[],
        &[
            ("drive.shaker.amplitude", "\"80 N\""),
            ("circuit.load.resistance", "\"100 kohm\""),
            ("stop.tip.frame", "\"harvester.table\""),
        ],
        &[
            ("drive.shaker.amplitude", "\"100 N\""),
            ("modal.harvester.damping_ratio.1", "0.3"),
        ],
        &[("stop.tip.gap", "\"0 mm\"")],
        &[
            ("stop.tip.gap", "\"3 mm\""),
            ("drive.shaker.amplitude", "\"100 N\""),
        ],
        &[("stop.tip.gap", "\"-0.2 mm\"")],
        &[("stop.tip.gap", "\"500 mm\"")],
        &[("stop.tip.stiffness", "\"100 N/m^1.5\"")],
        &[("circuit.load.resistance", "\"10 kohm\"")],
        &[
            ("drive.shaker.amplitude", "\"80 N\""),
            ("circuit.load.resistance", "\"100 kohm\""),
        ],
        &[
            ("drive.shaker.amplitude", "\"40 N\""),
            ("stop.tip.stiffness", "\"10000 N/m^1.5\""),
        ],
        &[("stop.tip.stiffness", "\"1e6 N/m^1.5\"")],
    ];
    // The first ones in every run, unless the environment variable gives another number.
    let asked = number("JOUNCE_DRAWN_SYSTEMS")
        .map(|count| (number("JOUNCE_DRAWN_FIRST").unwrap_or(0), count));
    let (first, count) = asked.unwrap_or((0, 5));
    let cases = cases
        .iter()
        .enumerate()
        .skip(first as usize)
        .take(count as usize);
    let wrong: usize = cases
        .map(|(k, changes)| Case::of_bench(changes).check(&format!("case {k}")))
        .sum();
    assert_eq!(wrong, 0, "labels that one search has and another lacks");
}

/// Random harvesters of low cost: their motions at both ends of the range settle soon.
const QUICK: [u64; 6] = [1, 10, 12, 14, 17, 19];

#[test]
fn labels_of_drawn_harvesters_are_the_same_for_all_settings() {
    let asked = number("JOUNCE_DRAWN_SYSTEMS").map(|count| {
        let first = number("JOUNCE_DRAWN_FIRST").unwrap_or(0);
        (first..first + count).collect()
    });
    let indices: Vec<u64> = asked.unwrap_or_else(|| QUICK.to_vec());
    let wrong: usize = indices
        .into_iter()
        .map(|index| Case::drawn(index).check(&format!("drawn {index}")))
        .sum();
    assert_eq!(wrong, 0, "labels that one search has and another lacks");
}

//! Strain and voltage of the patches in a run, compared with their limits.
//!
//! The strain of the outer face is taken at several positions of each patch.

use super::extremes::RecordWindow;
use super::output_row::OutputSource;
use super::subject::named;
use jounce_dynamics::{Kernel, Trajectory};
use jounce_model::plant::Plant;
use jounce_spec::Spec;
use jounce_spec::material;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Quantity of a patch that has limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PatchQuantity {
    /// Strain along the beam or the fibres, or larger principal strain on a plate, dimensionless.
    Strain,
    /// Voltage, V.
    Voltage,
}

/// Limit of a patch that a run exceeds or, from [`Limits::reached`], approaches.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ExceededLimit {
    /// Name of the patch.
    pub patch: String,
    /// Quantity that exceeds its limits.
    pub quantity: PatchQuantity,
    /// Value with the largest excess, or nearest to the limits.
    pub reached: f64,
    /// Lowest and highest allowed value.
    pub limits: [f64; 2],
}

impl fmt::Display for ExceededLimit {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [low, high] = self.limits;
        match self.quantity {
            PatchQuantity::Strain => {
                write!(
                    out,
                    "{}: its strain reaches {:.0} ppm; its limit is {:.0} ppm",
                    named("patch", &self.patch),
                    1e6 * self.reached,
                    1e6 * high
                )
            }
            PatchQuantity::Voltage => {
                write!(
                    out,
                    "{}: its voltage reaches {:.3} V; it bears {low} V to {high} V",
                    named("patch", &self.patch),
                    self.reached
                )
            }
        }
    }
}

impl ExceededLimit {
    /// True where the value is beyond the limits.
    pub fn is_beyond(&self) -> bool {
        self.excess() > 0.0
    }

    /// Returns the excess over the limits, in the unit of the quantity.
    pub fn excess(&self) -> f64 {
        excess(self.reached, self.limits)
    }
}

/// Largest excess over one limit among many results.
#[derive(Debug, Clone, PartialEq)]
pub struct WorstExcess {
    /// The largest excess.
    pub exceeded: ExceededLimit,
    /// Index of its result.
    pub place: usize,
    /// Number of results that exceed the limit.
    pub results_over: usize,
}

impl WorstExcess {
    /// Returns the worst case of each limit that any result exceeds.
    pub fn of<'e>(results: impl IntoIterator<Item = &'e [ExceededLimit]>) -> Vec<Self> {
        let mut worst: Vec<Self> = Vec::new();
        for (index, exceeded) in
            results
                .into_iter()
                .enumerate()
                .flat_map(|(index, all_exceeded)| {
                    all_exceeded.iter().map(move |exceeded| (index, exceeded))
                })
        {
            match worst.iter_mut().find(|known| {
                (&known.exceeded.patch, known.exceeded.quantity)
                    == (&exceeded.patch, exceeded.quantity)
            }) {
                Some(known) => {
                    known.results_over += 1;
                    if exceeded.excess() > known.exceeded.excess() {
                        (known.exceeded, known.place) = (exceeded.clone(), index);
                    }
                }
                None => worst.push(Self {
                    exceeded: exceeded.clone(),
                    place: index,
                    results_over: 1,
                }),
            }
        }
        worst
    }

    /// Returns the worst cases as messages. `noun` names the results, `describe` the result at an
    /// index.
    pub fn messages(
        results: &[&[ExceededLimit]],
        noun: &str,
        describe: impl Fn(usize) -> String,
    ) -> Vec<String> {
        let sentence = |worst: Self| {
            let (count, of) = (worst.results_over, results.len());
            format!(
                "{}; {count} of {of} {noun} exceed the limit, worst at {}",
                worst.exceeded,
                describe(worst.place)
            )
        };
        Self::of(results.iter().copied())
            .into_iter()
            .map(sentence)
            .collect()
    }
}

/// Limits of the patches of a harvester: `strain_limit` and the voltage limits of the material.
#[derive(Debug, Clone)]
pub struct Limits {
    patches: Vec<PatchLimits>,
}

impl Limits {
    /// Collects the limits of the patches of a plant.
    pub fn of(spec: &Spec, plant: &Plant) -> Self {
        let names = plant.system.modes.patch.keys().enumerate();
        Self {
            patches: names
                .filter_map(|(index, name)| PatchLimits::of(spec, index, name))
                .collect(),
        }
    }

    /// True where no patch has a limit.
    pub fn is_empty(&self) -> bool {
        self.patches.is_empty()
    }

    /// Returns the limits that the last `length_s` of a record exceed.
    pub fn exceeded(
        &self,
        kernel: &Kernel,
        trajectory: &Trajectory,
        length_s: f64,
    ) -> Vec<ExceededLimit> {
        let mut limits = self.reached(kernel, trajectory, length_s);
        limits.retain(ExceededLimit::is_beyond);
        limits
    }

    /// Returns each limit with the value in the last `length_s` of a record that exceeds it most or
    /// is nearest to it.
    pub fn reached(
        &self,
        kernel: &Kernel,
        trajectory: &Trajectory,
        length_s: f64,
    ) -> Vec<ExceededLimit> {
        let limited: Vec<(&PatchLimits, PatchQuantity, [f64; 2])> =
            self.patches.iter().flat_map(PatchLimits::each).collect();
        let window = RecordWindow::of(&kernel.plant, trajectory, length_s);
        let Some(window) = window.filter(|_| !limited.is_empty()) else {
            return Vec::new();
        };
        let sources: Vec<Vec<OutputSource>> = limited
            .iter()
            .map(|(patch, quantity, _)| patch.sources(&kernel.plant, *quantity))
            .collect();
        let extremes = window.extremes(kernel, trajectory, &sources);
        let limit =
            |((patch, quantity, limits), [lowest, highest]): (&(&PatchLimits, _, _), [f64; 2])| {
                let is_low = excess(lowest, *limits) > excess(highest, *limits);
                ExceededLimit {
                    patch: patch.name.clone(),
                    quantity: *quantity,
                    reached: if is_low { lowest } else { highest },
                    limits: *limits,
                }
            };
        limited.iter().zip(extremes).map(limit).collect()
    }
}

/// Limits of one patch.
#[derive(Debug, Clone)]
struct PatchLimits {
    name: String,
    /// Index among the patches of the plant.
    index: usize,
    strain: Option<f64>,
    voltages_v: Option<[f64; 2]>,
}

impl PatchLimits {
    fn of(spec: &Spec, index: usize, name: &str) -> Option<Self> {
        let patch = spec.patch.get(name)?;
        let voltages_v =
            material::named(&patch.material).and_then(|material| material.voltage_limits_v);
        let strain = patch.strain_limit;
        (strain.is_some() || voltages_v.is_some()).then(|| Self {
            name: name.to_owned(),
            index,
            strain,
            voltages_v,
        })
    }

    /// Returns each limited quantity with its lowest and highest allowed value.
    fn each(&self) -> impl Iterator<Item = (&Self, PatchQuantity, [f64; 2])> {
        let strain = self.strain.map(|limit| [-limit, limit]);
        let strain = strain.map(|limits| (self, PatchQuantity::Strain, limits));
        let voltage = self.voltages_v;
        let voltage = voltage.map(|limits| (self, PatchQuantity::Voltage, limits));
        strain.into_iter().chain(voltage)
    }

    fn sources(&self, plant: &Plant, quantity: PatchQuantity) -> Vec<OutputSource> {
        match quantity {
            PatchQuantity::Strain => (0..plant.system.modes.patch[&self.name].strain.len())
                .map(|place| OutputSource::Strain(self.index, place))
                .collect(),
            PatchQuantity::Voltage => vec![OutputSource::Patch(self.index)],
        }
    }
}

/// Returns the excess of a value over its limits; negative within them.
fn excess(value: f64, [low, high]: [f64; 2]) -> f64 {
    (low - value).max(value - high)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::run::{RunPlan, StartState, simulate};
    use jounce_model::plant::System;
    use jounce_model::structure::modes;

    /// Cantilever with a patch of known static strain: a force F at the end gives the curvature
    /// `F L / EI` at the root.
    #[test]
    fn a_slow_force_strains_the_patch_as_statics_says() {
        let text = "[beam.b]\nmaterial = \"aluminium\"\nlength = \"100 mm\"\nwidth = \"28 mm\"\nthickness = \"1 mm\"\n\
            [patch.p]\non = \"b\"\nmaterial = \"MFC-P2\"\nstart = \"0 mm\"\nlength = \"50 mm\"\nwidth = \"28 mm\"\nthickness = \"0.3 mm\"\n\
            [circuit.c]\npatch = \"p\"\nresistance = \"1 ohm\"\n[drive.d]\nat = \"b.end\"\namplitude = \"6 N\"\nfrequency = \"0.5 Hz\"\n\
            [damping]\nbeyond = 0.01\n[reduction]\nmodes = 12\n[run]\nstart = \"linear\"\nduration = \"4 s\"\naverage_over = \"2 s\"\n";
        let spec = Spec::from_toml(text).unwrap();
        let plant = Plant::new(System::assemble(&spec, modes(&spec).unwrap()).unwrap()).unwrap();
        let start = StartState::linear(&plant);
        let kernel = Kernel::new(plant).unwrap();
        let plan = RunPlan {
            duration_s: 4.0,
            average_over_s: 2.0,
            tolerance: 1e-9,
            record_s: 2.0,
        };
        let result = simulate(&kernel, &start, &plan).unwrap();
        let warned = Limits::of(&spec, &kernel.plant).exceeded(&kernel, &result.trajectory, 2.0);
        let section = jounce_model::structure::section::CrossSection::covered(
            &spec.beam["b"],
            spec.patch.values(),
        );
        let strain = 6.0 * 0.1 / section.bending_stiffness_n_m2 * (1.3e-3 - section.neutral_axis_m);
        assert_eq!(
            (warned.len(), warned[0].quantity),
            (1, PatchQuantity::Strain)
        );
        // Twelve modes give the curvature at the root to 5 %.
        assert!(
            (warned[0].reached.abs() / strain - 1.0).abs() < 0.05,
            "{} {strain}",
            warned[0].reached
        );
        let message = warned[0].to_string();
        assert!(message.starts_with("patch p: its strain"), "{message}");
        let same_word = ExceededLimit {
            patch: "patch".to_owned(),
            ..warned[0].clone()
        };
        let message = same_word.to_string();
        assert!(message.starts_with("patch: its strain"), "{message}");
        assert!(
            warned[0].to_string().contains("its limit is 600 ppm"),
            "{}",
            warned[0]
        );
        let worse = ExceededLimit {
            reached: 2.0 * warned[0].reached,
            ..warned[0].clone()
        };
        let worst = WorstExcess::of([&warned[..], &[], std::slice::from_ref(&worse)]);
        assert_eq!(
            worst,
            [WorstExcess {
                exceeded: worse,
                place: 2,
                results_over: 2
            }]
        );
    }
}

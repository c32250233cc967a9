//! What a run did to its patches, against what they bear.
//!
//! The strain of the outer face is `sum_i strain_i q_i` at several places of each patch, the voltage that of the patch; both are looked at
//! over the recorded end of the run.

use crate::march::{Kernel, Trajectory};
use crate::material;
use crate::plant::Plant;
use crate::spec::Spec;
use serde::Serialize;
use std::fmt;

/// How many times the record is looked at.
const LOOKS: usize = 2048;

/// A limit of a patch that a run has passed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Exceeded {
    /// Name of the patch.
    pub patch: String,
    /// `"strain"` (dimensionless) or `"voltage"` (V).
    pub quantity: &'static str,
    /// The value furthest beyond.
    pub reached: f64,
    /// Lowest and highest value that it bears.
    pub limits: [f64; 2],
}

impl fmt::Display for Exceeded {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [low, high] = self.limits;
        match self.quantity {
            "strain" => {
                write!(out, "patch {}: its strain reaches {:.0} ppm; {:.0} ppm are recommended", self.patch, 1e6 * self.reached, 1e6 * high)
            }
            _ => write!(out, "patch {}: its voltage reaches {:.3} V; it bears {low} V to {high} V", self.patch, self.reached),
        }
    }
}

/// The limits that the recorded part of a run passes: `strain_limit` of each patch, and the voltages of its material. The record is looked
/// at only where a patch has a limit.
pub fn exceeded(spec: &Spec, kernel: &Kernel, trajectory: &Trajectory) -> Vec<Exceeded> {
    let (Some(first), Some(last)) = (trajectory.segments().first(), trajectory.segments().last()) else { return Vec::new() };
    let plant = &kernel.plant;
    let limited: Vec<Limited> =
        plant.system.modes.patch.keys().enumerate().filter_map(|(index, name)| Limited::of(spec, index, name)).collect();
    if limited.is_empty() {
        return Vec::new();
    }
    let (begin_s, end_s) = (first.start_s, last.start_s + last.length_s);
    let times: Vec<f64> = (0..=LOOKS).map(|k| begin_s + (end_s - begin_s) * k as f64 / LOOKS as f64).collect();
    let states: Vec<Vec<f64>> = trajectory.at(kernel, &times).iter().map(|at| plant.to_physical(&at.state, at.time_s)).collect();
    limited.iter().flat_map(|patch| patch.exceeded(plant, &states)).collect()
}

/// A patch that does not bear everything.
struct Limited<'a> {
    name: &'a str,
    /// Its place among the patches of the plant.
    index: usize,
    strain: Option<f64>,
    voltages_v: Option<[f64; 2]>,
}

impl<'a> Limited<'a> {
    fn of(spec: &Spec, index: usize, name: &'a str) -> Option<Self> {
        let patch = spec.patch.get(name)?;
        let voltages_v = material::named(&patch.material).and_then(|material| material.voltage_limits_v);
        (patch.strain_limit.is_some() || voltages_v.is_some()).then_some(Self { name, index, strain: patch.strain_limit, voltages_v })
    }

    /// What the states do beyond its limits.
    fn exceeded(&self, plant: &Plant, states: &[Vec<f64>]) -> Vec<Exceeded> {
        let strained = self.strain.and_then(|limit| {
            let strain = |x: &Vec<f64>, shape: &Vec<f64>| shape.iter().zip(x).map(|(s, q)| s * q).sum::<f64>();
            let shapes = &plant.system.modes.patch[self.name].strain;
            let strains = states.iter().flat_map(|x| shapes.iter().map(move |shape| strain(x, shape)));
            beyond(self.name, "strain", strains, [-limit, limit])
        });
        let voltages = || states.iter().map(|x| plant.patch_voltages_v(x)[self.index]);
        let charged = self.voltages_v.and_then(|limits| beyond(self.name, "voltage", voltages(), limits));
        strained.into_iter().chain(charged).collect()
    }
}

fn beyond(patch: &str, quantity: &'static str, values: impl Iterator<Item = f64>, limits: [f64; 2]) -> Option<Exceeded> {
    let excess = |value: &f64| (limits[0] - value).max(value - limits[1]);
    let reached = values.max_by(|one, other| excess(one).total_cmp(&excess(other)))?;
    (excess(&reached) > 0.0).then(|| Exceeded { patch: patch.to_owned(), quantity, reached, limits })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::plant::System;
    use crate::run::{RunPlan, StartState, simulate};
    use crate::structure::modes;

    /// A cantilever with a patch of known static strain: a force F at the end bends the root by `F L / EI`.
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
        let plan = RunPlan { duration_s: 4.0, average_over_s: 2.0, tolerance: 1e-9, record_s: 2.0 };
        let answer = simulate(&kernel, &start, &plan).unwrap();
        let warned = exceeded(&spec, &kernel, &answer.trajectory);
        let section = crate::structure::section::CrossSection::covered(&spec.beam["b"], spec.patch.values());
        let strain = 6.0 * 0.1 / section.bending_stiffness_n_m2 * (1.3e-3 - section.neutral_axis_m);
        assert_eq!((warned.len(), warned[0].quantity), (1, "strain"));
        // Twelve modes give the curvature at the root within 5 %.
        assert!((warned[0].reached.abs() / strain - 1.0).abs() < 0.05, "{} {strain}", warned[0].reached);
        assert!(warned[0].to_string().contains("600 ppm are recommended"), "{}", warned[0]);
    }
}

//! Branches of periodic orbits over one key, stable or unstable.

mod conversion;
mod options;
mod report;
mod result;
mod stable_ranges;
mod tables;
mod warnings;

pub use options::{BranchOptions, OrbitMethod};
pub use report::band_limit_text;
pub(crate) use report::branch_line;
pub use result::{
    Bifurcation, Branch, BranchPoint, BranchQuantity, BranchResult, HalfPowerBandwidth, NotProved,
    Termination, TerminationReason,
};
pub(crate) use warnings::{budget_note, search_note};

use crate::continuation_options;
use crate::error::Error;
use crate::harvester::Harvester;
use crate::options::on_threads;
use jounce_analysis as analysis;
use jounce_analysis::run::{ExceededLimit, Limits};
use jounce_analysis::{AnalysisError, BandwidthSearch, BranchSearch, Parameter};
use jounce_model::plant::System;

impl Harvester {
    /// Continues every branch of periodic orbits over the range of a key, with its bifurcations,
    /// its peak and its half-power bandwidth. After a stop by the control the result holds the
    /// finished branches.
    ///
    /// # Errors
    /// [`Error::Option`], [`Error::Range`] for an unknown key, [`Error::Linear`],
    /// [`Error::Analysis`] and [`Error::Orbit`] for drives without a common period, and
    /// [`Error::Stopped`] where no branch was finished.
    ///
    /// ```
    /// use jounce::{BranchOptions, Harvester};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let result = harvester.branch(&BranchOptions {
    ///     over: "drive.shaker.frequency=12.9Hz:13Hz".to_owned(),
    ///     seeds: 0,
    ///     longest_period: 1,
    ///     ..Default::default()
    /// })?;
    /// assert_eq!(result.branches[0].period_cycles, 1);
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn branch(&self, options: &BranchOptions) -> Result<BranchResult, Error> {
        let tolerance = options.tolerance;
        continuation_options::check_search(tolerance, options.seeds, options.longest_period)?;
        let method = options.orbit_method()?;
        let (key, range) = continuation_options::range(self, "over", &options.over)?;
        let base = self.model()?;
        let quantity = BranchQuantity::of(&base.kernel.plant.system)?;
        let parameter = Parameter::new(&base, &key, range.1 - range.0);
        let search = BranchSearch {
            base: &base,
            parameter: &parameter,
            range,
            method,
            tolerance,
            seeds: options.seeds,
            longest_period: options.longest_period,
        };
        let tracer = options.tracer(&base.kernel.plant)?;
        let bandwidth_search = BandwidthSearch {
            base: &base,
            parameter: &parameter,
            range,
            tolerance,
        };
        let limits = Limits::of(&base.spec, &base.kernel.plant);
        let (branches, exceeded, bandwidths) = on_threads(options.threads, || {
            let branches = search.run_with(&tracer)?;
            let exceeded = match exceeded(&branches, &parameter, &limits, tolerance) {
                // The branches found so far are returned without their warnings.
                Err(_) if self.control().is_stopped() => vec![Vec::new(); branches.len()],
                exceeded => exceeded?,
            };
            let bandwidths = bandwidth_search.run(&branches);
            Ok((branches, exceeded, bandwidths))
        })?;
        if branches.is_empty() && self.control().is_stopped() {
            return Err(Error::Stopped);
        }
        let branches = branches.iter().zip(exceeded).zip(&bandwidths.branches);
        let all = bandwidths.together.as_ref();
        Ok(BranchResult {
            key: key.path().to_owned(),
            unit: key.unit(),
            branches: branches
                .map(|((branch, exceeded), bandwidth)| {
                    Branch::new(branch, exceeded, bandwidth.as_ref())
                })
                .collect(),
            peak: all.map(|bandwidth| bandwidth.peak),
            half_power_bandwidth: all.map(HalfPowerBandwidth::new),
            note: search_note(options.seeds, options.longest_period),
            quantity,
            options: options.clone(),
        })
    }
}

/// Returns the exceeded limits of each point of each branch.
fn exceeded(
    branches: &[analysis::Branch],
    parameter: &Parameter<'_>,
    limits: &Limits,
    tolerance: f64,
) -> Result<Vec<Vec<Vec<ExceededLimit>>>, AnalysisError> {
    branches
        .iter()
        .map(|branch| branch.exceeded(parameter, limits, tolerance))
        .collect()
}

impl BranchQuantity {
    fn of(system: &System) -> Result<Self, Error> {
        let has_circuit = !(system.loads.is_empty() && system.bridges.is_empty());
        match (has_circuit, system.stops.is_empty()) {
            (true, _) => Ok(Self::MeanPower),
            (false, false) => Ok(Self::Displacement),
            (false, true) => Err(Error::Linear),
        }
    }
}

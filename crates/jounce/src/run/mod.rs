//! One run: integration from a start over the duration of the spec.

mod history;
mod options;
mod report;
mod result;

pub use history::{History, HistorySamples};
pub use options::RunOptions;
pub use result::{LoadResult, PatchResult, PointResult, RunResult};

use crate::error::Error;
use crate::harvester::Harvester;
use jounce_analysis::run::{OutputPeaks, RunPlan, Warning, charges, output_peaks, simulate};
use jounce_dynamics::Kernel;
use std::time::Instant;

impl Harvester {
    /// Integrates one run over `run.duration` and averages over the last `run.average_over`.
    ///
    /// # Errors
    /// [`Error::Option`] for a record that is longer than the run, [`Error::Analysis`] for a start
    /// that does not fit or an integration that does not converge.
    pub fn run(&self, options: &RunOptions) -> Result<RunResult, Error> {
        let clock = Instant::now();
        if let Some(tolerance) = options.tolerance {
            self.check_tolerance(tolerance)?;
        }
        let model = self.model()?;
        options.check(model.spec.run.duration_s)?;
        let start = match &options.start {
            Some(start) => start.clone(),
            None => model.start(self.folder())?,
        };
        let kernel = model.from_state(&start)?;
        let of_spec = RunPlan::of(&model.spec.run, options.record_s);
        let tolerance = options.tolerance.unwrap_or(of_spec.tolerance);
        let plan = RunPlan {
            tolerance,
            ..of_spec
        };
        let plan = plan
            .watching(&model.spec, &kernel.plant)
            .balancing(&kernel.plant);
        self.control().expect_run(plan.duration_s);
        let result = simulate(&kernel, &start, &plan)?;
        self.control().report_progress(plan.duration_s);
        let history = options.record_s > 0.0;
        let history = history.then(|| History::new(&kernel, &result, &plan, options));
        let mut warnings = Warning::of(&model.spec, &kernel, &plan, &result);
        if history.is_some() {
            let rate_hz = options.sampled_at_hz();
            warnings.extend(Warning::of_sampling(&result.stops, rate_hz));
        }
        let peaks = output_peaks(&kernel, &result);
        warnings.extend(Warning::of_deflections(&model.spec, &kernel.plant, &peaks));
        let result = RunResult::new((&kernel, &plan), result, &peaks, warnings, history);
        Ok(RunResult {
            wall_time_s: clock.elapsed().as_secs_f64(),
            ..result
        })
    }
}

impl RunResult {
    fn new(
        (kernel, plan): (&Kernel, &RunPlan),
        run: jounce_analysis::run::RunResult,
        peaks: &OutputPeaks,
        warnings: Vec<Warning>,
        history: Option<History>,
    ) -> Self {
        let finite = |value: f64| value.is_finite().then_some(value);
        let load = |(load, peak_v): (&jounce_analysis::run::LoadResult, &f64)| LoadResult {
            name: load.name.clone(),
            mean_power_w: load.mean_power_w,
            voltage_rms_v: load.voltage_rms_v,
            voltage_peak_v: finite(*peak_v),
        };
        let modes = &kernel.plant.system.modes;
        let patch = |((name, peak_v), strain): ((&String, &f64), &f64)| PatchResult {
            name: name.clone(),
            voltage_peak_v: finite(*peak_v),
            strain_peak: finite(*strain),
        };
        let points = modes.shape.iter().zip(&peaks.points_m);
        let moving = points.filter(|((_, shape), _)| shape.iter().any(|value| *value != 0.0));
        let point = |((name, _), peak_m): ((&String, _), &f64)| PointResult {
            name: name.clone(),
            displacement_peak_m: finite(*peak_m),
        };
        let settlement = run.settlement;
        Self {
            // A sum of no terms may be -0.
            mean_power_w: run.mean_power_w + 0.0,
            voltage_rms_v: run.voltage_rms_v().and_then(finite),
            voltage_peak_v: peaks.first_v(),
            loads: run.loads.iter().zip(&peaks.loads_v).map(load).collect(),
            patches: (modes.patch.keys().zip(&peaks.patches_v))
                .zip(&peaks.strains)
                .map(patch)
                .collect(),
            points: moving.map(point).collect(),
            charges: charges(kernel, &run, plan),
            is_trivial: run.is_trivial(),
            rectified: run.rectified,
            devices: run.devices,
            leaks: run.leaks,
            max_penetration_m: run.max_penetration_m,
            max_contact_force_n: run.max_contact_force_n,
            contacts: run.contacts,
            contact_duty: run.contact_duty,
            stops: run.stops,
            energy_residual_relative: run.energies.residual_relative(),
            energies: run.energies,
            settled: settlement.map(|found| found.settled),
            period_cycles: settlement.map(|found| found.period_cycles),
            periodicity_change: settlement.and_then(|found| finite(found.change)),
            distance_to_orbit: settlement.and_then(|found| finite(found.distance)),
            warnings,
            work: run.work,
            wall_time_s: run.wall_time_s,
            integration_wall_time_s: run.wall_time_s,
            duration_s: plan.duration_s,
            average_over_s: plan.average_over_s,
            tolerance: plan.tolerance,
            end: run.end,
            history,
        }
    }
}

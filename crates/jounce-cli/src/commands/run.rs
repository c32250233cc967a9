//! `jounce run SPEC`

use crate::failure::Failure;
use crate::output::{self, line, print};
use crate::spec_arguments::{OutputArguments, SpecArguments};
use clap::Args;
use jounce_core::analysis::Model;
use jounce_core::integrate::Kernel;
use jounce_core::picture::{Scale, SpectrumLine, Trace, spectra, time_histories};
use jounce_core::run::{
    ChargeResult, RunPlan, RunResult, StopResult, VoltagePeaks, Warning, charges, simulate,
    voltage_peaks,
};
use jounce_core::signal::{Samples, Window};
use jounce_core::table::{Column, Table};
use std::path::{Path, PathBuf};

/// Sampling rate of the tables and pictures of a run.
const SAMPLE_RATE_HZ: f64 = 4096.0;
/// Minimum number of samples in the averaging window.
const MIN_SAMPLES: f64 = 1024.0;

/// Arguments of `run`.
#[derive(Debug, Args)]
pub struct Run {
    #[command(flatten)]
    spec: SpecArguments,
    /// Required relative error of the response; overrides run.tolerance.
    #[arg(long)]
    tolerance: Option<f64>,
    /// Starts from a state that another run saved; overrides run.start.
    #[arg(long, value_name = "FILE")]
    start: Option<PathBuf>,
    /// Saves the last state, from which another run can start.
    #[arg(long, value_name = "FILE")]
    save_state: Option<PathBuf>,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Run {
    /// Integrates and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let mut file = self.spec.file()?;
        if let Some(tolerance) = self.tolerance {
            file.set("run.tolerance", &format!("{tolerance:e}"))
                .map_err(|fault| Failure::faults(&self.spec.spec, vec![fault]))?;
        }
        let mut spec = self.spec.read(&file)?;
        let mut folder = self.spec.folder();
        if let Some(start) = &self.start {
            spec.run.start = jounce_core::spec::Start::State(start.display().to_string());
            folder = PathBuf::new();
        }
        let prepared = Model::new(spec)?;
        let start = prepared.start(&folder)?;
        let kernel = prepared.from_state(&start)?;
        let run = &prepared.spec.run;
        let plan = RunPlan::of(
            run,
            if self.output.out.is_some() {
                run.average_over_s
            } else {
                0.0
            },
        );
        let plan = plan
            .watching(&prepared.spec, &kernel.plant)
            .balancing(&kernel.plant);
        let answer =
            simulate(&kernel, &start, &plan).map_err(jounce_core::analysis::AnalysisError::from)?;
        if let Some(path) = &self.save_state {
            let text = serde_json::to_string_pretty(&answer.end)
                .map_err(|error| Failure::Input(error.to_string()))?;
            jounce_core::store::write(path, text.as_bytes())?;
        }
        if let Some(folder) = &self.output.out {
            self.write(folder, &prepared, &kernel, &answer, &plan)?;
        }
        let warnings = Warning::of(&prepared.spec, &kernel, &plan, &answer);
        let untold = warnings
            .iter()
            .filter(|warning| !matches!(warning, Warning::Recording { .. }));
        untold.for_each(|warning| eprintln!("warning: {warning}"));
        self.tell(&kernel, &answer, &plan, &warnings);
        Ok(())
    }

    fn tell(&self, kernel: &Kernel, answer: &RunResult, plan: &RunPlan, warnings: &[Warning]) {
        match self.output.json {
            true => print_json(kernel, answer, plan, warnings),
            false => print_lines(kernel, answer, plan),
        }
    }

    /// Writes time histories, spectrum and table of the averaging window.
    fn write(
        &self,
        folder: &Path,
        prepared: &Model,
        kernel: &Kernel,
        answer: &RunResult,
        plan: &RunPlan,
    ) -> Result<(), Failure> {
        let rate_hz = SAMPLE_RATE_HZ.max(MIN_SAMPLES / plan.average_over_s);
        let count = ((plan.average_over_s * rate_hz).round() as usize).max(2);
        let begin = plan.duration_s - plan.average_over_s;
        let time_s: Vec<f64> = (0..count).map(|k| begin + k as f64 / rate_hz).collect();
        let plant = &kernel.plant;
        let instants = answer.trajectory.at(kernel, &time_s);
        let states: Vec<Vec<f64>> = instants
            .iter()
            .map(|at| plant.to_physical(&at.state, at.time_s))
            .collect();
        let mut traces: Vec<Trace> = Vec::new();
        let voltages: Vec<Vec<f64>> = states.iter().map(|x| plant.patch_voltages_v(x)).collect();
        for (patch, name) in plant.system.modes.patch.keys().enumerate() {
            let values = voltages.iter().map(|v| v[patch]).collect();
            traces.push(Trace {
                quantity: format!("Voltage of {name}"),
                unit: "V".into(),
                values,
            });
        }
        for stop in &plant.system.stops {
            let towards = |x: &Vec<f64>| stop.shape.iter().zip(x).map(|(s, q)| s * q).sum::<f64>();
            traces.push(Trace {
                quantity: format!("Towards {}", stop.name),
                unit: "m".into(),
                values: states.iter().map(towards).collect(),
            });
        }
        for (p, stop) in plant.system.stops.iter().enumerate() {
            let quantity = if plant.system.stops.len() > 1 {
                format!("Contact force of {}", stop.name)
            } else {
                "Contact force".into()
            };
            traces.push(Trace {
                quantity,
                unit: "N".into(),
                values: instants.iter().map(|at| at.forces_n[p]).collect(),
            });
        }
        let mut table = Table::new(vec![Column::new("time_s", "s", "time", time_s.clone())])?;
        for trace in &traces {
            table.push(Column::new(
                &trace.quantity.to_lowercase().replace(' ', "_"),
                &trace.unit,
                &trace.quantity,
                trace.values.clone(),
            ))?;
        }
        output::table(
            folder,
            "run",
            &table,
            &self
                .spec
                .manifest(&prepared.spec, "run")
                .with("tolerance", plan.tolerance),
        )?;
        let shown = count.min(SAMPLE_RATE_HZ as usize);
        let last: Vec<Trace> = traces
            .iter()
            .map(|t| Trace {
                values: t.values[count - shown..].to_vec(),
                ..t.clone()
            })
            .collect();
        output::figure(
            folder,
            "run-time",
            &time_histories("End of the run", &time_s[count - shown..], &last),
        )?;
        if let Some(voltage) = traces.first() {
            let spectrum = Samples::new(&voltage.values, rate_hz)?.spectrum(Window::Hann);
            let drive_hz = plant.system.drives.first().map(|drive| drive.frequency_hz);
            let highest = 12.0 * drive_hz.unwrap_or(rate_hz / 24.0);
            let kept = spectrum
                .frequency_hz
                .iter()
                .take_while(|f| **f <= highest)
                .count();
            let shown = SpectrumLine {
                label: voltage.quantity.clone(),
                frequency_hz: spectrum.frequency_hz[..kept].to_vec(),
                amplitude_peak: spectrum.amplitude_peak[..kept].to_vec(),
            };
            output::figure(
                folder,
                "run-spectrum",
                &spectra(
                    "Voltage spectrum, Hann window",
                    &voltage.quantity,
                    "V",
                    Scale::Log,
                    &[shown],
                    drive_hz,
                ),
            )?;
        }
        Ok(())
    }
}

/// Prints the result as one JSON object.
fn print_json(kernel: &Kernel, answer: &RunResult, plan: &RunPlan, warnings: &[Warning]) {
    let settlement = answer.settlement;
    let peaks = voltage_peaks(kernel, answer, plan);
    let names = kernel.plant.system.modes.patch.keys();
    let patches = names.zip(&peaks.patches_v).map(
        |(name, peak_v)| serde_json::json!({ "name": name, "voltage_peak_v": finite(*peak_v) }),
    );
    let loads = answer
        .loads
        .iter()
        .zip(&peaks.loads_v)
        .map(|(load, peak_v)| {
            serde_json::json!({
                "name": load.name,
                "mean_power_w": load.mean_power_w,
                "voltage_rms_v": load.voltage_rms_v,
                "voltage_peak_v": finite(*peak_v),
            })
        });
    print(&serde_json::json!({
        "mean_power_w": answer.mean_power_w,
        "voltage_rms_v": answer.voltage_rms_v().and_then(finite),
        "voltage_peak_v": peaks.first_v(),
        "loads": loads.collect::<Vec<_>>(),
        "patches": patches.collect::<Vec<_>>(),
        "rectified": answer.rectified,
        "charges": charges(kernel, answer, plan),
        "leaks": answer.leaks,
        "max_penetration_m": answer.max_penetration_m,
        "max_contact_force_n": answer.max_contact_force_n,
        "contacts": answer.contacts,
        "contact_duty": answer.contact_duty,
        "stops": answer.stops,
        "energy_residual_relative": answer.energies.residual_relative(),
        "is_trivial": answer.is_trivial(),
        "energies": {
            "input_j": answer.energies.input_j,
            "loads_j": answer.energies.loads_j,
            "rectified": answer.energies.rectified,
            "leaks_j": answer.energies.leaks_j,
            "damping_j": answer.energies.damping_j,
            "contact_loss_j": answer.energies.contact_loss_j,
            "stored_j": answer.energies.stored_j,
        },
        "settled": settlement.map(|found| found.settled),
        "period_cycles": settlement.map(|found| found.period_cycles),
        "periodicity_change": settlement.and_then(|found| finite(found.change)),
        "distance_to_orbit": settlement.and_then(|found| finite(found.distance)),
        "warnings": warnings,
        "work": answer.work,
        "wall_time_s": answer.wall_time_s,
        "tolerance": plan.tolerance,
    }));
}

/// Prints the result as lines of text.
fn print_lines(kernel: &Kernel, answer: &RunResult, plan: &RunPlan) {
    let residual = answer.energies.residual_relative();
    // An empty sum may be -0.
    line(format!(
        "mean power         {:.6e} W",
        answer.mean_power_w + 0.0
    ));
    print_voltages(kernel, answer, &voltage_peaks(kernel, answer, plan));
    let charges = charges(kernel, answer, plan);
    for circuit in &answer.rectified {
        // Synchronous extraction transfers energy, without a charge through diodes.
        let current = if circuit.mean_current_a == 0.0 {
            String::new()
        } else {
            format!(", {:.4e} A", circuit.mean_current_a)
        };
        line(format!(
            "storage            {:.6} V{current}  (circuit {})",
            circuit.voltage_rms_v, circuit.name
        ));
        // A loss of zero may have roundoff of either sign.
        let [diodes, switch, leakage] = [
            circuit.diode_loss_w,
            circuit.switch_loss_w,
            circuit.leakage_w,
        ]
        .map(|loss_w| loss_w.max(0.0));
        line(format!(
            "  delivered        {:.4e} W, filling the storage {:.4e} W",
            circuit.mean_power_w, circuit.storage_w
        ));
        line(format!(
            "  lost             diodes {diodes:.4e} W, switch {switch:.4e} W, leakage {leakage:.4e} W"
        ));
        charges
            .iter()
            .filter(|charge| charge.name == circuit.name)
            .for_each(print_charge);
    }
    for leak in &answer.leaks {
        line(format!(
            "leakage            {:.6e} W  (patch {})",
            leak.mean_power_w, leak.patch
        ));
    }
    if !answer.stops.is_empty() {
        // Contact times of several stops may overlap, so their shares are not added.
        let share = if answer.stops.len() == 1 {
            format!(", {:.2} % of the time", 100.0 * answer.contact_duty)
        } else {
            String::new()
        };
        line(format!(
            "contacts           {} in {} s{share}",
            answer.contacts, plan.average_over_s
        ));
        line(format!(
            "penetration, peak  {:.6e} m, force {:.4e} N",
            answer.max_penetration_m, answer.max_contact_force_n
        ));
    }
    for stop in &answer.stops {
        print_stop(stop, answer.stops.len() > 1);
    }
    match answer.is_trivial() {
        true => line(
            "energy             zero: no contact began, and no energy changed by more than roundoff",
        ),
        false => line(format!(
            "energy residual    {residual:.1e} of the largest energy"
        )),
    }
    match answer.settlement {
        None => line(
            "no period          the drives have no common period, so there is no periodic steady state",
        ),
        Some(found) if found.settled => {
            line(format!(
                "settled            period {} drive cycles, change {:.1e}",
                found.period_cycles, found.change
            ));
        }
        Some(found) => {
            line(format!(
                "NOT settled        change over a period {:.1e}; increase run.duration",
                found.change
            ));
        }
    }
    line(format!(
        "computed in        {:.3} ms, {} flight and {} contact steps",
        1e3 * answer.wall_time_s,
        answer.work.flight_steps,
        answer.work.contact_steps
    ));
}

/// Prints the voltages of the loads, and the largest voltage of each patch without a load.
fn print_voltages(kernel: &Kernel, answer: &RunResult, peaks: &VoltagePeaks) {
    for (load, peak_v) in answer.loads.iter().zip(&peaks.loads_v) {
        line(format!(
            "voltage, rms       {:.6} V  (load {})",
            load.voltage_rms_v, load.name
        ));
        if peak_v.is_finite() {
            line(format!("voltage, peak      {peak_v:.6} V"));
        }
    }
    let patches = kernel.plant.system.modes.patch.keys().zip(&peaks.patches_v);
    for (name, peak_v) in
        patches.filter(|(_, peak_v)| peak_v.is_finite() && !peaks.loads_v.contains(peak_v))
    {
        line(format!("voltage, peak      {peak_v:.6} V  (patch {name})"));
    }
}

/// Prints the charge balance of a circuit and its residual.
fn print_charge(charge: &ChargeResult) {
    let ChargeResult {
        passed_c,
        load_c,
        leakage_c,
        storage_c,
        residual_relative,
        ..
    } = charge;
    line(format!(
        "  charge           diodes {passed_c:.4e} C = load {load_c:.4e} + leakage {leakage_c:.4e} + storage {storage_c:.4e} C"
    ));
    line(format!(
        "  charge residual  {residual_relative:.1e} of the largest charge"
    ));
}

/// Prints the contacts of one stop; with `beside` also the values that `print_lines` prints for all
/// stops.
fn print_stop(stop: &StopResult, beside: bool) {
    if beside {
        let (contacts, depth, force) = (
            stop.contacts,
            stop.max_penetration_m,
            stop.max_contact_force_n,
        );
        let share = 100.0 * stop.contact_duty;
        line(format!(
            "  stop {:<12}  {contacts} contacts, {share:.2} % of the time, penetration {depth:.6e} m, force {force:.4e} N",
            stop.name
        ));
    }
    if stop.contacts > 0 {
        line(format!(
            "  impact velocity  {:.4e} m/s in the mean, {:.4e} m/s at most",
            stop.mean_impact_velocity_m_s, stop.max_impact_velocity_m_s
        ));
        line(format!(
            "  contact duration {:.4e} s in the mean, {:.4e} s at most",
            stop.mean_contact_duration_s, stop.max_contact_duration_s
        ));
    }
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn infinite_distance_is_null_in_json() {
        assert_eq!(finite(f64::INFINITY), None);
        assert_eq!(finite(1.5), Some(1.5));
    }
}

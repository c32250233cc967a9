//! Figure 7: voltage over the last second at 13 Hz and 200 N, its spectrum, and its lines at
//! multiples of the drive frequency.

use crate::harvester::{ABOVE_RESONANCE, PaperHarvester};
use crate::{NamedFigure, NamedTable, ReproduceError};
use jounce_analysis::run::{RunPlan, RunResult, StartState, simulate};
use jounce_io::table::{Column, Table};
use jounce_plot::{Scale, SpectrumLine, Trace, spectra, time_histories};
use jounce_signal::{OrderLine, Samples, Window};

/// Sample rate, Hz.
const RATE_HZ: f64 = 2048.0;
/// Highest frequency in the figure of the spectrum, Hz.
const HIGHEST_HZ: f64 = 120.0;
/// Highest fitted order.
const HIGHEST_ORDER: u32 = 9;

/// Run and its voltage over the averaging window.
pub(crate) struct VoltageRecord {
    pub result: RunResult,
    time_s: Vec<f64>,
    voltage_v: Vec<f64>,
    /// Lines at integer and half orders.
    pub lines: Vec<OrderLine>,
}

impl VoltageRecord {
    /// Runs 13 Hz and 200 N from rest.
    pub fn compute(harvester: &PaperHarvester) -> Result<Self, ReproduceError> {
        let kernel = harvester.kernel(ABOVE_RESONANCE)?;
        let plan = RunPlan {
            record_s: harvester.spec.run.average_over_s,
            ..harvester.plan()
        };
        let result = simulate(&kernel, &StartState::rest(&kernel.plant), &plan)?;
        let from_s = plan.duration_s - plan.average_over_s;
        let count = (plan.average_over_s * RATE_HZ) as usize;
        let time_s: Vec<f64> = (0..count).map(|i| from_s + i as f64 / RATE_HZ).collect();
        let first_voltage = 2 * kernel.plant.system.modes.len();
        let at = result.trajectory.at(&kernel, &time_s);
        let voltage_v: Vec<f64> = at
            .iter()
            .map(|at| kernel.plant.to_physical(&at.state, at.time_s)[first_voltage])
            .collect();
        let orders: Vec<f64> = (1..=2 * HIGHEST_ORDER)
            .map(|i| f64::from(i) / 2.0)
            .collect();
        let lines = Samples::new(&voltage_v, RATE_HZ)?
            .orders(ABOVE_RESONANCE.frequency_hz, &orders)?
            .lines;
        Ok(Self {
            result,
            time_s,
            voltage_v,
            lines,
        })
    }

    /// Returns figure 7 and the spectrum of its run.
    pub fn figures(&self) -> Result<Vec<NamedFigure>, ReproduceError> {
        let from = self.time_s.len() - RATE_HZ as usize;
        let trace = Trace {
            quantity: "Voltage".to_owned(),
            unit: "V".to_owned(),
            values: self.voltage_v[from..].to_vec(),
        };
        let history = time_histories("Voltage at 13 Hz and 200 N", &self.time_s[from..], &[trace]);
        let spectrum = Samples::new(&self.voltage_v, RATE_HZ)?.spectrum(Window::Rectangular);
        let count = spectrum
            .frequency_hz
            .iter()
            .take_while(|f| **f <= HIGHEST_HZ)
            .count();
        let line = SpectrumLine {
            label: "voltage".to_owned(),
            frequency_hz: spectrum.frequency_hz[..count].to_vec(),
            amplitude_peak: spectrum.amplitude_peak[..count].to_vec(),
        };
        let drive_hz = Some(ABOVE_RESONANCE.frequency_hz);
        let lines = spectra(
            "Spectrum of the voltage at 13 Hz and 200 N",
            "Voltage",
            "V",
            Scale::Log,
            &[line],
            drive_hz,
        );
        let caption = "Figure 7. Voltage over the last second of 20 s at 13 Hz, 200 N and 1 MΩ.";
        let below = "Spectrum of the same voltage over the last 10 s (amplitudes zero to peak, no window: ten seconds hold 130 whole periods).";
        Ok(vec![
            NamedFigure::new("figure-7", caption, history),
            NamedFigure::new("figure-7-spectrum", below, lines),
        ])
    }

    /// Returns the tables of the last second and of the lines.
    pub fn tables(&self) -> Result<Vec<NamedTable>, ReproduceError> {
        let from = self.time_s.len() - RATE_HZ as usize;
        let history = Table::new(vec![
            Column::new("time_s", "s", "Time", self.time_s[from..].to_vec()),
            Column::new("voltage_v", "V", "Voltage", self.voltage_v[from..].to_vec()),
        ])?;
        let column = |of: fn(&OrderLine) -> f64| self.lines.iter().map(of).collect::<Vec<f64>>();
        let lines = Table::new(vec![
            Column::new("order", "", "Order", column(|line| line.order)),
            Column::new(
                "frequency_hz",
                "Hz",
                "Frequency",
                column(|line| line.frequency_hz),
            ),
            Column::new(
                "voltage_peak_v",
                "V",
                "Voltage, peak",
                column(|line| line.amplitude_peak),
            ),
        ])?;
        Ok(vec![
            NamedTable::new(
                "figure-7",
                "Figure 7: voltage over the last second.",
                6,
                history,
            ),
            NamedTable::new(
                "figure-7-orders",
                "Lines of the voltage at 13 Hz and 200 N at multiples of the drive frequency.",
                4,
                lines,
            ),
        ])
    }
}

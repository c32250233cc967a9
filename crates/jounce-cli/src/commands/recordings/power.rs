//! `jounce power FILE... --resistance R...`

use crate::failure::Failure;
use crate::measured_file::{manifest, or_issues, print_issues};
use crate::output::{self, line, with_uncertainty};
use crate::spec_arguments::OutputArguments;
use clap::Args;
use jounce::parts::PowerRecord;
use jounce::{PowerOptions, PowerResult, ReadOptions, Recording};
use std::path::{Path, PathBuf};

/// Arguments of `power`.
#[derive(Debug, Args)]
#[command(mut_arg("resistance_ohm", |resistance| resistance.required(true)))]
pub struct Power {
    /// The recordings, one for each load: CSV or text, Parquet, NPY, NPZ, MAT, HDF5, TDMS, WAV, UFF
    /// or LVM. Channel notes can stand in FILE.channels.toml next to each.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    #[command(flatten)]
    read: ReadOptions,
    #[command(flatten)]
    options: PowerOptions,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Power {
    /// Computes and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let options = PowerOptions {
            spectra: self.output.out.is_some(),
            ..self.options.clone()
        };
        let read = |file| Recording::read_for(file, &self.read, &options);
        let recordings: Vec<Recording> = self.files.iter().map(read).collect::<Result<_, _>>()?;
        let result = or_issues(Recording::power(&recordings, &options), &recordings)?;
        for record in &result.records {
            print_issues(&record.issues);
        }
        if let Some(folder) = &self.output.out {
            self.write(folder, &result)?;
        }
        match self.output.json {
            true => line(output::to_json(&result)?),
            false => result.records.iter().for_each(|one| self.print_record(one)),
        }
        Ok(())
    }

    fn write(&self, folder: &Path, result: &PowerResult) -> Result<(), Failure> {
        let manifest = manifest("power", &self.files, &self.read, &self.options)?;
        output::table(folder, "power", &result.table()?, &manifest)?;
        output::figure(folder, "power-load", &result.figure())?;
        output::figure(folder, "power-spectrum", &result.spectra_figure())
    }

    /// Prints the result of a recording as lines of text.
    fn print_record(&self, record: &PowerRecord) {
        let power = record.power;
        if self.files.len() > 1 {
            line(format!("{}, {} ohm", record.name, record.resistance_ohm));
        }
        let mean = with_uncertainty(power.mean_power_w, power.half_width_w, "W");
        let batches = power.batches;
        line(format!("mean power {mean} (95 %, {batches} batches)"));
        let mean = match self.options.remove_mean {
            true => "subtracted",
            false => "retained",
        };
        line(format!(
            "mean voltage {:.4e} V, {mean}",
            power.mean_voltage_v
        ));
        if let Some(ratio) = record.mean_power_per_mean_square_w_s4_m2 {
            line(format!(
                "per mean square of the base's acceleration: {ratio:.6e} W/(m/s^2)^2"
            ));
        }
        for order in &record.orders {
            line(format!(
                "order {:>4}, {:>10.4} Hz: {:.5e} V peak",
                order.order, order.frequency_hz, order.amplitude_peak_v
            ));
        }
        if power.correlated {
            line(
                "the power is correlated too long for this record, or changes within it (see jounce segments): the interval is approximate",
            );
        }
    }
}

//! `jounce fit SPEC --to FEATURES`

use crate::failure::Failure;
use crate::output::{self, line};
use crate::progress;
use crate::spec_arguments::{OutputArguments, SpecArguments};
use clap::Args;
use jounce::parts::{FitEstimate, Manifest};
use jounce::{Control, Error, Features, FitResult};
use std::path::{Path, PathBuf};

/// Format of a file of features; no line is wider than a terminal.
const FEATURES: &str = r#"FEATURES, a small one:

  hold = ["table"]              # fixed in the test; empty by default
  frequency_deviation = 0.002   # relative, or "residuals" of the fit

  [free]                        # keys, each with its relative deviation
  "beam.beam.youngs_modulus" = 0.03
  "damping.ratios.1" = 0.5      # "damping.ratios": each of the list

  [[mode]]
  number = 1                    # in the model, from 1
  frequency = "9.01 Hz"
  damping_ratio = 0.002
  damping_deviation = 0.1

Deviations are relative standard deviations, those of keys before the test.
Further tables are [[response]], [[power]], [[jump]] and [[history]]. All their
keys, with an example of each, are in the book, "Recordings of a test rig",
section "Model and measurement" (book/src/howto/measured.md)."#;

/// Arguments of `fit`.
#[derive(Debug, Args)]
#[command(after_help = FEATURES)]
pub struct Fit {
    #[command(flatten)]
    spec: SpecArguments,
    /// Measured features, and the keys to fit (TOML, described below); no default.
    #[arg(long, value_name = "FEATURES")]
    to: PathBuf,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Fit {
    /// Returns the failure of a fit; faults of the features get the name of their file.
    fn failure(&self, error: Error) -> Failure {
        match error {
            Error::Fit(error) if error.is_of_features() => {
                Failure::Input(format!("{}: {error}", self.to.display()))
            }
            error => self.spec.failure(error),
        }
    }

    /// Fits and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let features = Features::read(&self.to).map_err(Error::from)?;
        let control = Control::default();
        let harvester = self.spec.harvester()?.with_control(&control);
        let models = || control.progress().0;
        let result = progress::with_count("models computed", &models, || harvester.fit(&features));
        let result = result.map_err(|error| self.failure(error))?;
        if let Some(folder) = &self.output.out {
            let manifest = self.spec.manifest(&harvester, "fit", &())?;
            write(folder, &result, &manifest.with("to", self.to.display()))?;
        }
        match self.output.json {
            true => line(output::to_json(&result)?),
            false => print_fit(&result.estimate),
        }
        Ok(())
    }
}

fn write(folder: &Path, result: &FitResult, manifest: &Manifest) -> Result<(), Failure> {
    output::table(folder, "fit-keys", &result.table()?, manifest)?;
    output::table(folder, "fit-features", &result.features_table()?, manifest)?;
    for (index, (curve, table)) in result.curve_tables()?.iter().enumerate() {
        let name = format!("fit-curve-{}", index + 1);
        let manifest = manifest.clone().with("curve", curve);
        output::table(folder, &name, table, &manifest)?;
    }
    output::figure(folder, "fit", &result.figure())?;
    Ok(result.fitted.write(folder.join("fitted.toml"))?)
}

fn print_fit(result: &FitEstimate) {
    for key in &result.keys {
        let (path, unit) = (&key.key, &key.unit);
        line(format!(
            "{path}: {:.6e} {unit} -> {:.6e} {unit}, 95 % from {:.6e} to {:.6e}",
            key.before, key.after, key.low, key.high
        ));
    }
    if !result.features.is_empty() {
        line(
            "feature                    measured        before   error %         after   error %   +- 95 %",
        );
    }
    for feature in &result.features {
        let (before, after) = feature.errors();
        line(format!(
            "{:<22} {:>12.6e} {:>13.6e} {:>9.3} {:>13.6e} {:>9.3} {:>9.3}",
            feature.name,
            feature.measured,
            feature.before,
            100.0 * before,
            feature.after,
            100.0 * after,
            50.0 * (feature.high - feature.low) / feature.measured
        ));
    }
    for curve in &result.curves {
        let (before, after) = curve.errors();
        line(format!(
            "{}, {} points: rms error {:.3} % before and {:.3} % after",
            curve.name,
            curve.at.len(),
            100.0 * before,
            100.0 * after
        ));
    }
    for deviation in &result.deviations {
        if let Some(freedom) = deviation.degrees_of_freedom {
            line(format!(
                "deviation of {} from residuals: {:.3e}, {freedom:.1} degrees of freedom",
                deviation.name, deviation.deviation
            ));
        }
    }
    result
        .warnings
        .iter()
        .for_each(|warning| line(format!("warning: {warning}")));
}
